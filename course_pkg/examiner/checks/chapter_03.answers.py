"""What students answer in chapter 03; see answers.py for the form of this file."""

# %% before
import threading
import time

import rospy
from course_pkg import join
from course_pkg.shop import Watch
from course_pkg.srv import DetectCustomer, DetectCustomerResponse
from std_msgs.msg import UInt32, UInt32MultiArray

node = join("chapter_03")


def say_good_day(number):
    time.sleep(0.2)


# %% 03.1 right: until the clock says stop
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            return answer.number
        time.sleep(1 / rate)
    return None

# %% 03.1 right: a rate of rospy's, and a proxy
def poll(service, seconds, rate):
    ask = rospy.ServiceProxy(service, DetectCustomer)
    pace = rospy.Rate(rate)
    end = rospy.Time.now() + rospy.Duration(seconds)
    while rospy.Time.now() < end:
        answer = ask(0, 0.0)
        if answer.number:
            return answer.number
        pace.sleep()

# %% 03.1 right: no longer a pause than there is time
def poll(service, seconds, rate):
    started = time.time()
    while True:
        answer = node.call(service, DetectCustomer)
        if answer.detected:
            return answer.number
        rest = started + seconds - time.time()
        if rest <= 0:
            return None
        time.sleep(min(rest, 1 / rate))

# %% 03.1 wrong: hammers | hint: keep two programs busy
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            return answer.number
    return None

# %% 03.1 wrong: never gives up | hint: It goes on asking when the time is over
def poll(service, seconds, rate):
    while True:
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            return answer.number
        time.sleep(1 / rate)

# %% 03.1 wrong: takes the rate for a pause | hint: 1 / rate is the pause in seconds
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            return answer.number
        time.sleep(rate)
    return None

# %% 03.1 wrong: counts questions | hint: Don't count questions
def poll(service, seconds, rate):
    for _ in range(int(seconds * rate)):
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            return answer.number
        time.sleep(1 / rate)
    return None

# %% 03.1 wrong: lets the server wait | hint: lets the detector wait
def poll(service, seconds, rate):
    answer = node.call(service, DetectCustomer, after=0, patience=seconds, timeout=seconds + 2)
    return answer.number if answer.detected else None

# %% 03.1 wrong: asks once | hint: Ask again
def poll(service, seconds, rate):
    answer = node.call(service, DetectCustomer, after=0, patience=0)
    return answer.number if answer.detected else None

# %% 03.1 wrong: pauses first | hint: Ask first, and pause when the answer is no
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        time.sleep(1 / rate)
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            return answer.number
    return None

# %% 03.1 wrong: returns True | hint: That is whether somebody is there
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if node.call(service, DetectCustomer, after=0, patience=0).detected:
            return True
        time.sleep(1 / rate)
    return None

# %% 03.1 wrong: returns the answer | hint: That is the whole answer
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            return answer
        time.sleep(1 / rate)
    return None

# %% 03.1 wrong: 0 for nobody | hint: 0 is what the field holds
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    answer = node.call(service, DetectCustomer, after=0, patience=0)
    while time.monotonic() < end and not answer.detected:
        time.sleep(1 / rate)
        answer = node.call(service, DetectCustomer, after=0, patience=0)
    return answer.number

# %% 03.1 wrong: asks twice for one answer | hint: Keep the answer, look at it
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if node.call(service, DetectCustomer, after=0, patience=0).detected:
            return node.call(service, DetectCustomer, after=0, patience=0).number
        time.sleep(1 / rate)
    return None

# %% 03.1 wrong: forgets to return | hint: Return the number of the customer
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            break
        time.sleep(1 / rate)

# %% 03.1 wrong: gives up at once when the first answer is no, and says so late | hint: Ask again
def poll(service, seconds, rate):
    answer = node.call(service, DetectCustomer, after=0, patience=0)
    if answer.detected:
        return answer.number
    time.sleep(seconds)
    return None

# %% 03.1 wrong: a pause of its own | hint: So seldom a question
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            return answer.number
        time.sleep(0.5)
    return None

# %% 03.1 wrong: an error at the end | hint: that is no error: return None
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = node.call(service, DetectCustomer, after=0, patience=0)
        if answer.detected:
            return answer.number
        time.sleep(1 / rate)
    raise TimeoutError("nobody came")

# %% 03.2 right: a set of those who were greeted
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    greeted = set()

    def greet(message):
        if message.data not in greeted:
            greeted.add(message.data)
            say_good_day(message.data)
            publisher.publish(message.data)

    node.subscribe(customers, UInt32, greet)

# %% 03.2 right: the last number, with rospy's own subscriber
class Greeter:
    def __init__(self, greetings):
        self.last = 0
        self.publisher = rospy.Publisher(greetings, UInt32, queue_size=100)

    def greet(self, message):
        if message.data > self.last:
            self.last = message.data
            say_good_day(message.data)
            self.publisher.publish(message)


def start_greeting(customers, greetings):
    rospy.Subscriber(customers, UInt32, Greeter(greetings).greet)

# %% 03.2 right: a queue, and a thread that greets
def start_greeting(customers, greetings):
    import queue

    waiting = queue.Queue()
    publisher = node.advertise(greetings, UInt32, queue_size=0)

    def work():
        greeted = []
        while True:
            number = waiting.get()
            if number not in greeted:
                greeted.append(number)
                say_good_day(number)
                publisher.publish(number)

    threading.Thread(target=work, daemon=True).start()
    node.subscribe(customers, UInt32, lambda message: waiting.put(message.data))

# %% 03.2 wrong: a queue of one | hint: A subscriber's queue_size says
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    greeted = set()

    def greet(message):
        if message.data not in greeted:
            greeted.add(message.data)
            say_good_day(message.data)
            publisher.publish(message.data)

    rospy.Subscriber(customers, UInt32, greet, queue_size=1)

# %% 03.2 wrong: greets twice | hint: Remember who has been greeted
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)

    def greet(message):
        say_good_day(message.data)
        publisher.publish(message.data)

    node.subscribe(customers, UInt32, greet)

# %% 03.2 wrong: only looks at the one before | hint: Remember who has been greeted
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    before = [0]

    def greet(message):
        if message.data != before[0]:
            before[0] = message.data
            say_good_day(message.data)
            publisher.publish(message.data)

    node.subscribe(customers, UInt32, greet)

# %% 03.2 wrong: a publisher for each greeting | hint: before anybody comes
def start_greeting(customers, greetings):
    greeted = set()

    def greet(message):
        if message.data not in greeted:
            greeted.add(message.data)
            say_good_day(message.data)
            rospy.Publisher(greetings, UInt32, queue_size=10).publish(message.data)

    node.subscribe(customers, UInt32, greet)

# %% 03.2 wrong: does not come back | hint: has to return, so that the cell goes on
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    while True:
        message = rospy.wait_for_message(customers, UInt32)
        say_good_day(message.data)
        publisher.publish(message.data)

# %% 03.2 wrong: says so first | hint: Call say_good_day(number) first
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    greeted = set()

    def greet(message):
        if message.data not in greeted:
            greeted.add(message.data)
            publisher.publish(message.data)
            say_good_day(message.data)

    node.subscribe(customers, UInt32, greet)

# %% 03.2 wrong: greets nobody | hint: Call say_good_day(number) first
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    greeted = set()

    def greet(message):
        if message.data not in greeted:
            greeted.add(message.data)
            publisher.publish(message.data)

    node.subscribe(customers, UInt32, greet)

# %% 03.2 wrong: listens to the one topic it knows | hint: Subscribe to the name in `customers`
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    node.subscribe("/customers", UInt32, publisher.publish)

# %% 03.2 wrong: the two topics mixed up | hint: It publishes on `customers`
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(customers, UInt32, queue_size=10)
    node.subscribe(greetings, UInt32, publisher.publish)

# %% 03.2 wrong: counts | hint: Publish the number that the message brought
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    greeted = set()

    def greet(message):
        if message.data not in greeted:
            greeted.add(message.data)
            say_good_day(message.data)
            publisher.publish(len(greeted))

    node.subscribe(customers, UInt32, greet)

# %% 03.2 wrong: another type | hint: Publish it with the type
def start_greeting(customers, greetings):
    from std_msgs.msg import Int32

    publisher = rospy.Publisher(greetings, Int32, queue_size=10)
    node.subscribe(customers, UInt32, lambda message: publisher.publish(message.data))

# %% 03.2 wrong: an error in the callback | hint: No greeting came at all
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)

    def greet(message):
        say_good_day(message.number)
        publisher.publish(message.number)

    node.subscribe(customers, UInt32, greet)

# %% 03.2 wrong: only the newest, at a pace of its own | hint: were dropped
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    heard = node.subscribe(customers, UInt32)

    def work():
        greeted = set()
        while True:
            if heard.messages and heard.messages[-1].data not in greeted:
                number = heard.messages[-1].data
                greeted.add(number)
                say_good_day(number)
                publisher.publish(number)
            time.sleep(0.01)

    threading.Thread(target=work, daemon=True).start()

# %% 03.2 wrong: the last one first | hint: one after the other
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    waiting, greeted = [], set()
    node.subscribe(customers, UInt32, lambda message: waiting.append(message.data))

    def work():
        while True:
            if waiting:
                number = waiting.pop()
                if number not in greeted:
                    greeted.add(number)
                    say_good_day(number)
                    publisher.publish(number)
            time.sleep(0.01)

    threading.Thread(target=work, daemon=True).start()

# %% 03.2 wrong: a thread for each | hint: greets them all at once
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    greeted = set()

    def greet(number):
        say_good_day(number)
        publisher.publish(number)

    def hear(message):
        if message.data not in greeted:
            greeted.add(message.data)
            threading.Thread(target=greet, args=(message.data,)).start()

    rospy.Subscriber(customers, UInt32, hear)

# %% 03.2 wrong: greets whoever comes a second time, tells once | hint: Remember who has been greeted
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    greeted = set()

    def greet(message):
        say_good_day(message.data)
        if message.data not in greeted:
            greeted.add(message.data)
            publisher.publish(message.data)

    node.subscribe(customers, UInt32, greet)

# %% 03.3 right: wait_for, and look again
def handle_detect(watch, request):
    with watch.changed:
        watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
        customer = watch.next(request.after)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 right: what wait_for returns
def handle_detect(watch, request):
    def who():
        return watch.next(request.after)

    with watch.changed:
        customer = watch.changed.wait_for(who, request.patience)
    if customer:
        return DetectCustomerResponse(detected=True, number=customer.number, arrived=customer.arrived)
    return DetectCustomerResponse(detected=False)

# %% 03.3 right: a loop of its own
def handle_detect(watch, request):
    end = time.monotonic() + request.patience
    with watch.changed:
        customer = watch.next(request.after)
        while customer is None and time.monotonic() < end:
            watch.changed.wait(end - time.monotonic())
            customer = watch.next(request.after)
    if customer is None:
        return {"detected": False}
    return {"detected": True, "number": customer.number, "arrived": customer.arrived}

# %% 03.3 right: looks ten times a second
def handle_detect(watch, request):
    end = time.monotonic() + request.patience
    while True:
        customer = watch.next(request.after)
        if customer:
            return True, customer.number, customer.arrived
        if time.monotonic() >= end:
            return False, 0, rospy.Time()
        time.sleep(0.1)

# %% 03.3 wrong: waits for ever | hint: It waits for longer than it was told to
def handle_detect(watch, request):
    with watch.changed:
        watch.changed.wait_for(lambda: watch.next(request.after))
        customer = watch.next(request.after)
    return True, customer.number, customer.arrived

# %% 03.3 wrong: only looks | hint: before the time was over
def handle_detect(watch, request):
    customer = watch.next(request.after)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: sleeps, and looks then | hint: Look first, and wait only if nobody is
def handle_detect(watch, request):
    time.sleep(request.patience)
    customer = watch.next(request.after)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: waits for a change without looking | hint: Look first, and wait only if nobody is
def handle_detect(watch, request):
    with watch.changed:
        watch.changed.wait(request.patience)
        customer = watch.next(request.after)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: takes any change for a customer | hint: A change at the counter may be that somebody went
def handle_detect(watch, request):
    with watch.changed:
        if watch.next(request.after) is None:
            watch.changed.wait(request.patience)
        customer = watch.next(request.after)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: keeps the processor busy | hint: A loop without a pause
def handle_detect(watch, request):
    end = time.monotonic() + request.patience
    while time.monotonic() < end and watch.next(request.after) is None:
        pass
    customer = watch.next(request.after)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: sleeps with the condition in its hands | hint: it holds `changed` while it sleeps
def handle_detect(watch, request):
    end = time.monotonic() + request.patience
    with watch.changed:
        while watch.next(request.after) is None and time.monotonic() < end:
            time.sleep(0.05)
        customer = watch.next(request.after)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: forgets whom the caller knows | hint: The caller knows that one
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(), timeout=request.patience)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: a patience of its own | hint: It waits for longer than it was told to
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=5)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: patience in milliseconds | hint: before the time was over
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience / 1000)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: asks itself, and hands over the answer | hint: wait_for takes a function
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(watch.next(request.after), timeout=request.patience)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: nobody has no number | hint: look before you take it
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    return customer is not None, customer.number, customer.arrived

# %% 03.3 wrong: nobody gets no answer | hint: It needs one also when nobody came
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    if customer:
        return True, customer.number, customer.arrived

# %% 03.3 wrong: waits outside | hint: Waiting begins inside
def handle_detect(watch, request):
    customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: no number | hint: number is 0, as a field is
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    return DetectCustomerResponse(detected=customer is not None)

# %% 03.3 wrong: no time | hint: arrived=customer.arrived
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    return customer is not None, customer.number if customer else 0, rospy.Time()

# %% 03.3 wrong: one caller at a time | hint: One caller had to wait for another one
door = threading.Lock()


def handle_detect(watch, request):
    with door, watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 right: looks every few milliseconds
def handle_detect(watch, request):
    end = rospy.Time.now() + rospy.Duration(request.patience)
    while not rospy.is_shutdown():
        customer = watch.next(request.after)
        if customer is not None:
            return [True, customer.number, customer.arrived]
        if rospy.Time.now() >= end:
            break
        rospy.sleep(0.005)
    return [False, 0, rospy.Time()]

# %% 03.3 wrong: the time of the answer | hint: when the customer was first seen
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, rospy.Time.now()

# %% 03.3 wrong: a time for nobody | hint: arrived is rospy.Time(), which is zero
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    if customer is None:
        return False, 0, rospy.Time.now()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: twice the patience | hint: It waits for longer than it was told to
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=2 * request.patience)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: a number also for nobody | hint: detected is False and number is 0
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    if customer is None:
        return False, request.after, rospy.Time()
    return True, customer.number, customer.arrived

# %% 03.3 wrong: an error for nobody | hint: that is an answer, no error
def handle_detect(watch, request):
    with watch.changed:
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    if customer is None:
        raise rospy.ServiceException("nobody came")
    return True, customer.number, customer.arrived

# %% 03.4 right: step by step
def expect_of_polling(rate, stay):
    pause = 1 / rate
    return pause / 2, pause, max(0, 1 - stay / pause)

# %% 03.4 right: with an if
def expect_of_polling(rate, stay):
    longest = 1.0 / rate
    if stay >= longest:
        missed = 0.0
    else:
        missed = (longest - stay) / longest
    return [0.5 / rate, longest, missed]

# %% 03.4 wrong: the mean is the longest | hint: Customers come at any moment of the pause
def expect_of_polling(rate, stay):
    return 1 / rate, 1 / rate, max(0, 1 - stay * rate)

# %% 03.4 wrong: the rate for the pause | hint: That is the rate
def expect_of_polling(rate, stay):
    return rate / 2, rate, max(0, 1 - stay / rate)

# %% 03.4 wrong: fewer than nobody | hint: Less than none
def expect_of_polling(rate, stay):
    return 0.5 / rate, 1 / rate, 1 - stay * rate

# %% 03.4 wrong: those who are found | hint: That is the share of those who are found
def expect_of_polling(rate, stay):
    return 0.5 / rate, 1 / rate, min(1, stay * rate)

# %% 03.4 wrong: percent | hint: That is in percent
def expect_of_polling(rate, stay):
    return 0.5 / rate, 1 / rate, max(0, 100 * (1 - stay * rate))

# %% 03.4 wrong: all or nobody | hint: All of them
def expect_of_polling(rate, stay):
    return 0.5 / rate, 1 / rate, 0 if stay >= 1 / rate else 1

# %% 03.4 wrong: nobody is ever missed | hint: Some are missed
def expect_of_polling(rate, stay):
    return 0.5 / rate, 1 / rate, 0

# %% 03.4 wrong: the longest is the mean | hint: just after a question waits for the whole pause
def expect_of_polling(rate, stay):
    return 0.5 / rate, 0.5 / rate, max(0, 1 - stay * rate)

# %% 03.4 wrong: milliseconds | hint: Return seconds
def expect_of_polling(rate, stay):
    return 500 / rate, 1000 / rate, max(0, 1 - stay * rate)

# %% 03.4 wrong: one number | hint: Return the three with commas
def expect_of_polling(rate, stay):
    return 0.5 / rate

# %% 03.4 wrong: prints | hint: without a return line
def expect_of_polling(rate, stay):
    print(0.5 / rate, 1 / rate, max(0, 1 - stay * rate))

# %% 03.4 wrong: mean and longest changed places | hint: in another order
def expect_of_polling(rate, stay):
    return 1 / rate, 0.5 / rate, max(0, 1 - stay * rate)

# %% 03.4 wrong: rounds the share | hint: It is rounded
def expect_of_polling(rate, stay):
    return 0.5 / rate, 1 / rate, round(max(0, 1 - stay * rate), 2)

# %% 03.4 wrong: the absolute value | hint: Less than none is missed
def expect_of_polling(rate, stay):
    return 0.5 / rate, 1 / rate, abs(1 - stay * rate)

# %% 03.4 wrong: a percentage in words | hint: One of them is no number
def expect_of_polling(rate, stay):
    return 0.5 / rate, 1 / rate, f"{max(0, 1 - stay * rate):.0%}"

# %% 03.5 right: six decisions
decisions = {
    "wheel speed": ("topic", "newest"),
    "open the gripper": ("service", "answer"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("action", "long"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.5 right: with the other reasons that hold
decisions = {
    "wheel speed": ["topic", "many"],
    "open the gripper": ["service", "answer"],
    "full map": ["service", "answer"],
    "obstacle seen": ["topic", "newest"],
    "tidy the room": ["action", "long"],
    "free space on disk": ["service", "answer"],
}

# %% 03.5 wrong: asks for the wheel speed | hint: what fifty questions a second cost
decisions = {
    "wheel speed": ("service", "newest"),
    "open the gripper": ("service", "answer"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("action", "long"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.5 wrong: tells the gripper | hint: The gripper may be stuck
decisions = {
    "wheel speed": ("topic", "newest"),
    "open the gripper": ("topic", "answer"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("action", "long"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.5 wrong: streams the map | hint: Ten megabytes
decisions = {
    "wheel speed": ("topic", "newest"),
    "open the gripper": ("service", "answer"),
    "full map": ("topic", "newest"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("action", "long"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.5 wrong: calls everybody | hint: And it would have to know them all
decisions = {
    "wheel speed": ("topic", "newest"),
    "open the gripper": ("service", "answer"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("service", "answer"),
    "tidy the room": ("action", "long"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.5 wrong: waits for half an hour | hint: The caller would stand still
decisions = {
    "wheel speed": ("topic", "newest"),
    "open the gripper": ("service", "answer"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("service", "answer"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.5 wrong: a right decision for a wrong reason | hint: Here one program wants it
decisions = {
    "wheel speed": ("topic", "newest"),
    "open the gripper": ("service", "many"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("action", "long"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.5 wrong: no reasons | hint: The design alone is half of it
decisions = {
    "wheel speed": "topic",
    "open the gripper": "service",
    "full map": "service",
    "obstacle seen": "topic",
    "tidy the room": "action",
    "free space on disk": "service",
}

# %% 03.5 wrong: the reason first | hint: The design stands first
decisions = {
    "wheel speed": ("newest", "topic"),
    "open the gripper": ("service", "answer"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("action", "long"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.5 wrong: one job forgotten | hint: Compare letter by letter
decisions = {
    "wheel speed": ("topic", "newest"),
    "open the gripper": ("service", "answer"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("action", "long"),
}

# %% 03.5 wrong: an action for everything that moves | hint: It is done in a moment
decisions = {
    "wheel speed": ("topic", "newest"),
    "open the gripper": ("action", "long"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("action", "long"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.5 wrong: a list of pairs | hint: A dict is written in braces
decisions = [
    ("wheel speed", "topic", "newest"),
    ("open the gripper", "service", "answer"),
    ("full map", "service", "long"),
]
