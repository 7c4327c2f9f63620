"""Example answers of chapter 03; tests/checking/answers/example_answers.py explains the format."""

# %% 03.1 right: polls until the time is over
def poll(service, seconds, rate):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        answer = rospy.ServiceProxy(service, DetectCustomer)(after=0, patience=0)
        if answer.detected:
            return answer.number
        time.sleep(1 / rate)
    return None

# %% 03.1 right: uses a rospy.Rate and one proxy
def poll(service, seconds, rate):
    ask = rospy.ServiceProxy(service, DetectCustomer)
    pace = rospy.Rate(rate)
    end = rospy.Time.now() + rospy.Duration(seconds)
    while rospy.Time.now() < end:
        answer = ask(0, 0.0)
        if answer.number:
            return answer.number
        pace.sleep()

# %% 03.1 right: shortens the last pause
def poll(service, seconds, rate):
    started = time.time()
    while True:
        answer = rospy.ServiceProxy(service, DetectCustomer)()
        if answer.detected:
            return answer.number
        rest = started + seconds - time.time()
        if rest <= 0:
            return None
        time.sleep(min(rest, 1 / rate))

# %% 03.1 wrong: polls without a pause | hint: poll() made too many calls
replace("\n        time.sleep(1 / rate)", "")
# %% 03.1 wrong: polls without a limit | hint: poll() continues after its time
replace("end = time.monotonic() + seconds\n    while time.monotonic() < end:", "while True:")
replace("\n    return None", "")
# %% 03.1 wrong: uses the rate as the pause | hint: Pause for 1 / rate
replace("1 / rate", "rate")
# %% 03.1 wrong: counts polls instead of seconds | hint: Each call also takes time
replace("    end = time.monotonic() + seconds\n    while time.monotonic() < end:", "    for _ in range(int(seconds * rate)):")
# %% 03.1 wrong: passes the waiting time to the server | hint: The field `patience` of the request is not 0
replace("end = time … return None", """answer = rospy.ServiceProxy(service, DetectCustomer)(after=0, patience=seconds)
    return answer.number if answer.detected else None""")
# %% 03.1 wrong: calls the service only once | hint: poll() stopped after the first response,
based_on("passes the waiting time to the server")
replace("patience=seconds", "patience=0")
# %% 03.1 wrong: pauses before the first call | hint: A customer was there, but poll()
replace("end:", "end:\n        time.sleep(1 / rate)")
replace("return answer.number\n        time.sleep(1 / rate)", "return answer.number")
# %% 03.1 wrong: pauses before it returns the number | hint: poll() paused before it returned
replace("return answer.number\n        time.sleep(1 / rate)", "found = answer.number\n        time.sleep(1 / rate)")
replace("if answer.detected:\n", "found = None\n        if answer.detected:\n")
replace("\n    return None", "\n        if found:\n            return found\n    return None")
# %% 03.1 wrong: returns True | hint: poll() returned the value of
replace("return answer.number", "return True")
# %% 03.1 wrong: returns the whole response | hint: poll() returned the whole response.
replace("answer.number", "answer")
# %% 03.1 wrong: returns 0 if there is no customer | hint: If no customer is there
replace("return None", "return answer.number")
# %% 03.1 wrong: calls the service again to get the number | hint: poll() called the service a second time
replace("return answer.number", "return rospy.ServiceProxy(service, DetectCustomer)(after=0, patience=0).number")
# %% 03.1 wrong: forgets to return | hint: poll() returned None, although a customer was there
replace("return answer.number", "break")
replace("\n    return None", "")
# %% 03.1 wrong: uses a fixed pause | hint: so customers have to wait longer
replace("1 / rate", "0.5")
# %% 03.1 wrong: raises an error when the time is over | hint: No customer came, but poll() raised
replace("return None", 'raise TimeoutError("nobody came")')
# %% 03.1 wrong: pauses for two seconds | hint: poll() called the service too rarely
replace("1 / rate", "2")
# %% 03.1 wrong: makes three calls in quick succession | hint: poll() made several calls without a pause
replace("end = time", "calls = 0\n    end = time")
replace("time.sleep(1 / rate)", "calls += 1\n        if calls % 3 == 0:\n            time.sleep(3 / rate)")
# %% 03.1 wrong: makes only one call if the time is short | hint: poll() made too few calls while no customer came
replace("1 / rate", "1 / rate if seconds > 1.5 else seconds")
# %% 03.1 wrong: returns False if there is no customer | hint: No customer came. Return None
replace("return None", "return False")
# %% 03.1 wrong: always polls for one second | hint: poll() returned before the time
replace("+ seconds", "+ 1")
# %% 03.1 wrong: sets a field of the response in the request | hint: Your function uses a field that the request does not have
replace("after=0", "number=0")
# %% 03.1 wrong: calls a fixed service name | hint: poll() did not call the given
replace("ServiceProxy(service", 'ServiceProxy("/detect_customer"')
# %% 03.1 wrong: ignores the first customer | hint: The field `after` of the request is not 0
replace("after=0", "after=1")
# %% 03.1 wrong: returns 1 for each customer | hint: The number that poll() returned
replace("return answer.number", "return 1")
# %% 03.1 wrong: always pauses for 0.2 s | hint: At a low rate, poll() made more calls
replace("1 / rate", "0.2")
# %% 03.1 wrong: lets the server wait from the second call on | hint: The field `patience` of the request is not 0
replace("end = time", "patience = 0\n    end = time")
replace("patience=0)", "patience=patience)")
replace("time.sleep", "patience = 1\n        time.sleep")

# %% 03.2 right: stores the greeted customers in a set
def start_greeting(customers, greetings):
    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)
    greeted = set()

    def greet(message):
        if message.data not in greeted:
            greeted.add(message.data)
            say_good_day(message.data)
            publisher.publish(message.data)

    rospy.Subscriber(customers, UInt32, greet)

# %% 03.2 wrong: greets only numbers above the last one | hint: A customer was not greeted
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

# %% 03.2 right: uses a queue, and a thread that greets
def start_greeting(customers, greetings):
    import queue

    waiting = queue.Queue()
    publisher = rospy.Publisher(greetings, UInt32, queue_size=0)

    def work():
        greeted = []
        while True:
            number = waiting.get()
            if number not in greeted:
                greeted.append(number)
                say_good_day(number)
                publisher.publish(number)

    threading.Thread(target=work, daemon=True).start()
    rospy.Subscriber(customers, UInt32, lambda message: waiting.put(message.data))

# %% 03.2 wrong: uses a queue of length 1 | hint: Some messages arrived during a
replace("rospy.Subscriber(customers, UInt32, greet", "rospy.Subscriber(customers, UInt32, greet, queue_size=1")
# %% 03.2 wrong: uses a queue of length 10 | hint: Some messages arrived during a
replace("rospy.Subscriber(customers, UInt32, greet", "rospy.Subscriber(customers, UInt32, greet, queue_size=10")
# %% 03.2 wrong: greets a customer twice | hint: Store the greeted numbers in a set
replace("\n            greeted.add(message.data)", "")
# %% 03.2 wrong: compares each customer only with the previous one | hint: Store the greeted numbers in a set
replace("greeted = set()", "before = [0]")
replace("not in greeted", "!= before[0]")
replace("greeted.add(message.data)", "before[0] = message.data")
# %% 03.2 wrong: creates a publisher for each greeting | hint: The first greeting is lost
replace("\n    publisher = rospy.Publisher(greetings, UInt32, queue_size=10)", "")
replace("publisher", "rospy.Publisher(greetings, UInt32, queue_size=10)")
# %% 03.2 wrong: does not return | hint: start_greeting() does not return
replace("greeted = set … UInt32, greet)", """while True:
        message = rospy.wait_for_message(customers, UInt32)
        say_good_day(message.data)
        publisher.publish(message.data)""")
# %% 03.2 wrong: publishes before the greeting | hint: The number was published before
replace("add(message.data)", "add(message.data)\n            publisher.publish(message.data)")
replace("            publisher.publish(message.data)\n\n", "")
# %% 03.2 wrong: replaces say_good_day() | hint: Your cell replaces say_good_day() by
replace("def start_greeting", "def say_good_day(number):\n    pass\n\n\ndef start_greeting")
# %% 03.2 wrong: does not greet | hint: The number was published before
replace("\n            say_good_day(message.data)", "")
# %% 03.2 wrong: uses a fixed topic | hint: No node subscribes to the topic
replace("greeted = set … UInt32, greet)", 'rospy.Subscriber("/customers", UInt32, publisher.publish)')
# %% 03.2 wrong: exchanges the two topics | hint: Your function publishes on `customers`
based_on("uses a fixed topic")
replace("greetings, UInt32", "customers, UInt32")
replace('"/customers"', "greetings")
# %% 03.2 wrong: publishes the number of greetings | hint: Your function published a number that is
replace("publish(message.data)", "publish(len(greeted))")
# %% 03.2 wrong: publishes another message type | hint: Publish the topic with the type
replace("def start_greeting", "from std_msgs.msg import Int32\n\n\ndef start_greeting")
replace("greetings, UInt32", "greetings, Int32")
# %% 03.2 wrong: raises an error in the callback | hint: No greeting was published. Look
replace("message.data", "message.number", times=4)
# %% 03.2 wrong: greets the last customer first | hint: The order of the greetings
based_on("uses a queue, and a thread that greets")
replace("queue.Queue()", "queue.LifoQueue()")
# %% 03.2 wrong: starts a thread for each greeting | hint: Two greetings ran at the same time
replace("(message):", "(number):\n        say_good_day(number)\n        publisher.publish(number)\n\n    def hear(message):")
replace("say_good_day(message … UInt32, greet)", """threading.Thread(target=greet, args=(message.data,)).start()

    rospy.Subscriber(customers, UInt32, hear)""")
# %% 03.2 wrong: greets a customer twice, but publishes the number once | hint: Store the greeted numbers in a set
replace("def greet(message):", "def greet(message):\n        say_good_day(message.data)")
replace("\n            say_good_day(message.data)", "")
# %% 03.2 wrong: greets a customer twice, and changes the stored greetings | hint: Store the greeted numbers in a set
based_on("greets a customer twice, but publishes the number once")
replace("say_good_day(message.data)", "say_good_day(message.data)\n        say_good_day.said = list(greeted)")
# %% 03.2 wrong: uses one set for all calls of start_greeting() | hint: After a second call of start_greeting(),
replace("def start_greeting", "greeted = set()\n\n\ndef start_greeting")
replace("    greeted = set()\n\n    def", "\n    def")
# %% 03.2 wrong: passes the whole message to say_good_day() | hint: say_good_day() needs the number, not the
replace("say_good_day(message.data)", "say_good_day(message)")
# %% 03.2 wrong: sleeps instead of greeting | hint: The number was published, but the customer
replace("say_good_day(message.data)", "time.sleep(0.2)")

# %% 03.3 right: writes the cases in the order of the table
solution()

# %% 03.3 right: writes the cases in another order
mistakes = dict(F="stream for one value", E="waits in the control loop", D="no regular messages")
mistakes.update(zip("ABC", ["polls too rarely", "polls too often", "topic without latch"]))

# %% 03.3 wrong: exchanges A and B | hint: A client that polls too often … as long as the pause between two calls
replace('"A": "polls too rarely"', '"A": "polls too often"')
replace('"B": "polls too often"', '"B": "polls too rarely"')
# %% 03.3 wrong: gives "polls too rarely" for B | hint: A client that polls too rarely … Nearly all calls return no
replace('"polls too often"', '"polls too rarely"')
# %% 03.3 wrong: exchanges C and D | hint: With regular messages, a subscriber … before the tablet subscribed
replace('"C": "topic without latch"', '"C": "no regular messages"')
replace('"D": "no regular messages"', '"D": "topic without latch"')
# %% 03.3 wrong: gives "topic without latch" for D | hint: Without a latch, a subscriber … The subscriber sees no difference
replace('"no regular messages"', '"topic without latch"')
# %% 03.3 wrong: gives "stream for one value" for E | hint: If a node needs only one … While the robot's control thread
replace('"waits in the control loop"', '"stream for one value"')
# %% 03.3 wrong: gives "waits in the control loop" for F | hint: A program that waits in … The node receives many messages
replace('"stream for one value"', '"waits in the control loop"')
# %% 03.3 wrong: omits a case | hint: A case from the table is missing
replace('\n    "F": "stream for one value",', "")
# %% 03.3 wrong: uses a small letter as a key | hint: Some keys are wrong. Use
replace('"A"', '"a"')
# %% 03.3 wrong: uses another text for a mistake | hint: The name of a mistake
replace('"polls too rarely"', '"too slow"')

# %% 03.4 right: gives one decision for each job
decisions = {
    "wheel speed": ("topic", "newest"),
    "open the gripper": ("service", "answer"),
    "full map": ("service", "seldom"),
    "obstacle seen": ("topic", "many"),
    "tidy the room": ("action", "long"),
    "free space on disk": ("service", "seldom"),
}

# %% 03.4 right: uses a latched topic for the map, and an action for the gripper
decisions = {
    "wheel speed": ["topic", "many"],
    "open the gripper": ["action", "answer"],
    "full map": ["topic", "latched"],
    "obstacle seen": ["topic", "many"],
    "tidy the room": ["action", "long"],
    "free space on disk": ["service", "answer"],
}

# %% 03.4 wrong: uses a service for the wheel speed | hint: With a service, the client would make
replace('"topic", "newest"', '"service", "newest"')
# %% 03.4 wrong: uses a topic for the gripper | hint: The gripper can be blocked
replace('"service", "answer"', '"topic", "answer"')
# %% 03.4 wrong: uses a service for the obstacle | hint: With a service, the bumper's
replace('"topic", "many"', '"service", "answer"')
# %% 03.4 wrong: uses a service for tidying the room | hint: With a service, the client would wait
replace('"action", "long"', '"service", "answer"')
# %% 03.4 wrong: uses a topic for tidying the room | hint: With a topic, the node that publishes
replace('"action", "long"', '"topic", "newest"')
# %% 03.4 wrong: uses a topic for the free disk space | hint: With a topic, a node would publish the number
replace('disk": ("service", "seldom")', 'disk": ("topic", "newest")')
# %% 03.4 wrong: uses an action for the free disk space | hint: This task takes only a moment.
replace('disk": ("service", "seldom")', 'disk": ("action", "answer")')
# %% 03.4 wrong: gives a wrong reason for the right design | hint: in this task, only one
replace('"service", "answer"', '"service", "many"')
# %% 03.4 wrong: gives the reason "answer" for a topic | hint: in this task, the node
replace('"topic", "many"', '"topic", "answer"')
# %% 03.4 wrong: gives the reason "newest" for the gripper | hint: in this task, new values
replace('"service", "answer"', '"service", "newest"')
# %% 03.4 wrong: gives the reason "seldom" for the gripper | hint: in this task, the data
replace('"service", "answer"', '"service", "seldom"')
# %% 03.4 wrong: gives the reason "long" for the free disk space | hint: in this task, the work
replace('disk": ("service", "seldom")', 'disk": ("service", "long")')
# %% 03.4 wrong: gives the reason "latched" for the wheel speed | hint: in this task, a node
replace('"topic", "newest"', '"topic", "latched"')
# %% 03.4 wrong: gives no reason for one design | hint: The reason is missing
replace('("topic", "newest")', '"topic"')
# %% 03.4 wrong: writes the reason before the design | hint: Write the design first
replace('"topic", "newest"', '"newest", "topic"')
# %% 03.4 wrong: omits one job | hint: The keys have to be
replace('\n    "free space on disk": ("service", "seldom"),', "")
# %% 03.4 wrong: writes a list of tuples instead of a dict | hint: Write a dict in braces
replace("decisions = … }", 'decisions = [\n    ("wheel speed", "topic", "newest"),\n    ("open the gripper", "service", "answer"),\n]')
# %% 03.4 wrong: gives a reason that is not in the list | hint: The designs are
replace('"newest"', '"fast"')
