"""What students answer in chapter 02; see answers.py for the form of this file."""

# %% before
import threading
import time

import rospy
from course_pkg import join
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, String, UInt32

node = join("chapter_02")


def wait_for_listener(publisher, seconds=5.0):
    deadline = time.monotonic() + seconds
    while publisher.get_num_connections() == 0 and time.monotonic() < deadline:
        time.sleep(0.01)

# %% 02.1 right: a rate
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_for_listener(publisher, 2.0)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 right: a pause of its own
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=100)
    start = time.time()
    while publisher.get_num_connections() < 1 and time.time() - start < 2:
        rospy.sleep(0.05)
    for number in range(count):
        publisher.publish(UInt32(data=number))
        time.sleep(1 / rate)

# %% 02.1 right: node.advertise
def count_aloud(topic, rate, count):
    said = node.advertise(topic, UInt32)
    try:
        said.wait(1, timeout=2)
    except Exception:
        pass
    r = rospy.Rate(rate)
    number = 0
    while number < count:
        said.publish(data=number)
        number += 1
        r.sleep()

# %% 02.1 wrong: waits for nobody | hint: before anybody was connected
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 wrong: waits for ever | hint: Nobody has to listen
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    while publisher.get_num_connections() == 0:
        time.sleep(0.01)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 wrong: says nothing to nobody | hint: With nobody listening it still has to speak
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_for_listener(publisher, 2.0)
    if publisher.get_num_connections() == 0:
        raise RuntimeError("nobody listens")
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 wrong: from 1 | hint: The first number is 0
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_for_listener(publisher, 2.0)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number + 1)
        pace.sleep()

# %% 02.1 wrong: one too many | hint: That is one too many
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_for_listener(publisher, 2.0)
    pace = rospy.Rate(rate)
    for number in range(count + 1):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 wrong: without a pause | hint: Too fast: pause after each
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=1000)
    wait_for_listener(publisher, 2.0)
    for number in range(count):
        publisher.publish(number)

# %% 02.1 wrong: the rate for the pause | hint: It is not done in time
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_for_listener(publisher, 2.0)
    for number in range(count):
        publisher.publish(number)
        time.sleep(rate)

# %% 02.1 wrong: a pause instead of a look | hint: Look every few milliseconds
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    time.sleep(2)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 wrong: stops too early | hint: The last one is missing
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_for_listener(publisher, 2.0)
    pace = rospy.Rate(rate)
    for number in range(count - 1):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 wrong: on a thread | hint: The end is missing
def count_aloud(topic, rate, count):
    def speak():
        publisher = rospy.Publisher(topic, UInt32, queue_size=10)
        wait_for_listener(publisher, 2.0)
        pace = rospy.Rate(rate)
        for number in range(count):
            publisher.publish(number)
            pace.sleep()

    threading.Thread(target=speak, daemon=True).start()

# %% 02.1 wrong: half as fast | hint: Too slow
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_for_listener(publisher, 2.0)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()
        pace.sleep()

# %% 02.1 wrong: in bursts | hint: They come in bursts
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=1000)
    wait_for_listener(publisher, 2.0)
    for number in range(count):
        publisher.publish(number)
        if number % 5 == 4:
            time.sleep(5 / rate)

# %% 02.1 wrong: another type | hint: Publish it with the type that the exercise names
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, Float64, queue_size=10)
    wait_for_listener(publisher, 2.0)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 wrong: a topic of its own | hint: for the topic that is given
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher("/count", UInt32, queue_size=10)
    wait_for_listener(publisher, 2.0)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 wrong: waits half a second | hint: Somebody may come within 2 s
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_for_listener(publisher, 0.5)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()

# %% 02.2 right: a callback that publishes
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 right: a copy whose lists are new
import copy

def start_mirror(source, target):
    out = rospy.Publisher(target, JointState, queue_size=100, tcp_nodelay=True)

    def callback(msg):
        new = copy.deepcopy(msg)
        new.position = tuple(-p for p in msg.position)
        new.velocity = tuple(v * -1 for v in msg.velocity)
        out.publish(new)

    sub = rospy.Subscriber(source, JointState, callback, queue_size=50)
    return sub

# %% 02.2 right: with the course's own
def start_mirror(source, target):
    image = node.advertise(target, JointState)

    def hear(m):
        turned = [-value for value in m.position], [-value for value in m.velocity]
        image.publish(header=m.header, name=m.name, position=turned[0], velocity=turned[1])

    return node.subscribe(source, JointState, hear)

# %% 02.2 wrong: nothing turns | hint: The position came out as it went in
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)
    return rospy.Subscriber(source, JointState, publisher.publish)

# %% 02.2 wrong: the velocity does not turn | hint: The velocity came out as it went in
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        publisher.publish(
            JointState(
                header=message.header,
                name=message.name,
                position=[-angle for angle in message.position],
                velocity=message.velocity,
            )
        )

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: the velocity is left out | hint: velocity was left out
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: the lists are turned around | hint: It is the signs that turn
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = message.position[::-1]
        image.velocity = message.velocity[::-1]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: no sign at all | hint: makes plus of minus
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = [abs(angle) for angle in message.position]
        image.velocity = [abs(speed) for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: a new header | hint: The time is 0
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: the time of the image | hint: That is another time
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(name=message.name)
        image.header.stamp = rospy.Time.now()
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: no names | hint: The names are missing
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: a publisher in the callback | hint: Make the publisher there, and not in the callback
def start_mirror(source, target):
    def show(message):
        publisher = rospy.Publisher(target, JointState, queue_size=10)
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: waits for one message | hint: It has to return at once
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)
    while not rospy.is_shutdown():
        message = rospy.wait_for_message(source, JointState)
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

# %% 02.2 wrong: only the first | hint: Only one was mirrored
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)
        subscriber.unregister()

    subscriber = rospy.Subscriber(source, JointState, show)
    return subscriber

# %% 02.2 wrong: drops what is not the newest | hint: Some were left out
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        time.sleep(0.1)
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show, queue_size=1)

# %% 02.2 wrong: a pause in the callback | hint: Some were left out
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        time.sleep(0.1)
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: looks every tenth of a second | hint: Some came more than once
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)
    heard = []

    def repeat():
        while True:
            time.sleep(0.1)
            if heard:
                image = JointState(header=heard[-1].header, name=heard[-1].name)
                image.position = [-angle for angle in heard[-1].position]
                image.velocity = [-speed for speed in heard[-1].velocity]
                publisher.publish(image)

    threading.Thread(target=repeat, daemon=True).start()
    return rospy.Subscriber(source, JointState, heard.append)

# %% 02.2 wrong: late | hint: They come late
def start_mirror(source, target):
    import queue

    publisher = rospy.Publisher(target, JointState, queue_size=10)
    images = queue.SimpleQueue()

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        images.put((time.monotonic() + 0.4, image))

    def speak():
        while True:
            due, image = images.get()
            time.sleep(max(due - time.monotonic(), 0))
            publisher.publish(image)

    threading.Thread(target=speak, daemon=True).start()
    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: says each twice | hint: Publish in the callback, once for each message
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: changes what it was given | hint: Another callback of this program got it
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        message.position = [-angle for angle in message.position]
        message.velocity = [-speed for speed in message.velocity]
        publisher.publish(message)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: returns nothing | hint: Return the rospy.Subscriber
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: publishes nothing | hint: Nothing came out
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        return image

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: the wrong way round | hint: Nobody publishes it when start_mirror() has returned
def start_mirror(source, target):
    publisher = rospy.Publisher(source, JointState, queue_size=10)
    return rospy.Subscriber(target, JointState, lambda message: publisher.publish(message))

# %% 02.2 right: arguments for the callback
def show(message, publisher):
    image = JointState()
    image.header = message.header
    image.name = list(message.name)
    image.position = tuple(map(lambda each: -each, message.position))
    image.velocity = [0.0 - each for each in message.velocity]
    image.effort = message.effort
    publisher.publish(image)

def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=None)
    return rospy.Subscriber(source, JointState, show, callback_args=publisher)

# %% 02.2 wrong: the time alone of the header | hint: it has a frame_id, too
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(name=message.name)
        image.header.stamp = message.header.stamp
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: the names in order | hint: Hand the names on as they are
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=sorted(message.name))
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 wrong: changes it when it has been shown | hint: Another callback of this program got it
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=100)
    import queue
    box = queue.Queue()

    def work():
        while True:
            message = box.get()
            time.sleep(0.01)
            message.position = [-angle for angle in message.position]
            message.velocity = [-angle for angle in message.velocity]
            publisher.publish(message)

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(source, JointState, box.put)

# %% 02.3 right: latched
def announce(topic, value):
    publisher = rospy.Publisher(topic, Float64, queue_size=1, latch=True)
    publisher.publish(value)

# %% 02.3 right: one publisher for each topic
notices = {}

def announce(topic, value):
    if topic not in notices:
        notices[topic] = rospy.Publisher(topic, Float64, latch=True, queue_size=10)
    notices[topic].publish(Float64(value))

# %% 02.3 wrong: not latched | hint: A publisher with latch=True hands its last message
def announce(topic, value):
    publisher = rospy.Publisher(topic, Float64, queue_size=1)
    publisher.publish(value)

# %% 02.3 wrong: waits for a listener instead | hint: A publisher with latch=True hands its last message
def announce(topic, value):
    publisher = rospy.Publisher(topic, Float64, queue_size=1)
    wait_for_listener(publisher, 0.8)
    publisher.publish(value)

# %% 02.3 wrong: a pause instead | hint: A latched message needs no pause
def announce(topic, value):
    publisher = rospy.Publisher(topic, Float64, queue_size=1)
    time.sleep(1.5)
    publisher.publish(value)

# %% 02.3 wrong: a loop without end | hint: It does not return
def announce(topic, value):
    publisher = rospy.Publisher(topic, Float64, queue_size=1)
    pace = rospy.Rate(10)
    while not rospy.is_shutdown():
        publisher.publish(value)
        pace.sleep()

# %% 02.3 wrong: says it again and again from a thread | hint: It is said again and again
def announce(topic, value):
    publisher = rospy.Publisher(topic, Float64, queue_size=1)

    def repeat():
        while True:
            publisher.publish(value)
            time.sleep(0.05)

    threading.Thread(target=repeat, daemon=True).start()

# %% 02.3 wrong: takes the notice down | hint: one that is unregistered takes its notice along
def announce(topic, value):
    publisher = rospy.Publisher(topic, Float64, queue_size=1, latch=True)
    publisher.publish(value)
    publisher.unregister()

# %% 02.3 wrong: another type | hint: Publish it with the type that the exercise names
def announce(topic, value):
    publisher = rospy.Publisher(topic, String, queue_size=1, latch=True)
    publisher.publish(str(value))

# %% 02.3 wrong: waits first and says it twice | hint: It was said twice
def announce(topic, value):
    publisher = rospy.Publisher(topic, Float64, queue_size=10, latch=True)
    wait_for_listener(publisher, 0.5)
    publisher.publish(value)
    time.sleep(0.1)
    publisher.publish(value)

# %% 02.3 wrong: never a second value | hint: One of the values was not heard
notices = {}

def announce(topic, value):
    if topic not in notices:
        notices[topic] = rospy.Publisher(topic, Float64, latch=True, queue_size=10)
        notices[topic].publish(value)

# %% 02.3 wrong: says all that was announced | hint: An older value was said again
said = {}
class All(rospy.SubscribeListener):
    def __init__(self, topic):
        self.values = []
        self.publisher = rospy.Publisher(topic, Float64, subscriber_listener=self, queue_size=10)
    def peer_subscribe(self, topic_name, topic_publish, peer_publish):
        for value in self.values:
            peer_publish(Float64(value))
def announce(topic, value):
    if topic not in said:
        said[topic] = All(topic)
    said[topic].values.append(value)
    said[topic].publisher.publish(value)

# %% 02.4 right: a queue of one
def follow(topic, work):
    return rospy.Subscriber(topic, Float64, lambda message: work(message.data), queue_size=1)

# %% 02.4 right: a worker that takes the newest
def follow(topic, work):
    box, ready = [], threading.Event()

    def hear(message):
        box[:] = [message.data]
        ready.set()

    def labour():
        while True:
            ready.wait()
            ready.clear()
            work(box[0])

    threading.Thread(target=labour, daemon=True).start()
    return rospy.Subscriber(topic, Float64, hear)

# %% 02.4 right: with a function of its own
def follow(topic, work):
    def callback(message):
        work(message.data)

    subscriber = rospy.Subscriber(topic, Float64, callback, queue_size=1, buff_size=2**24)
    return subscriber

# %% 02.4 wrong: everything in order | hint: Too many may wait
def follow(topic, work):
    return rospy.Subscriber(topic, Float64, lambda message: work(message.data))

# %% 02.4 wrong: ten may wait | hint: With queue_size=1, only the newest does
def follow(topic, work):
    return rospy.Subscriber(topic, Float64, lambda message: work(message.data), queue_size=10)

# %% 02.4 wrong: a thread for each | hint: The work ran several times at once
def follow(topic, work):
    def hear(message):
        threading.Thread(target=work, args=[message.data], daemon=True).start()

    return rospy.Subscriber(topic, Float64, hear, queue_size=1)

# %% 02.4 wrong: the whole message | hint: That is the whole message
def follow(topic, work):
    return rospy.Subscriber(topic, Float64, work, queue_size=1)

# %% 02.4 wrong: node.subscribe has no such limit | hint: Too many may wait
def follow(topic, work):
    return node.subscribe(topic, Float64, lambda message: work(message.data))

# %% 02.4 wrong: every sixteenth | hint: The last value was never worked on
def follow(topic, work):
    count = [0]

    def hear(message):
        count[0] += 1
        if count[0] % 16 == 1:
            work(message.data)

    return rospy.Subscriber(topic, Float64, hear)

# %% 02.4 wrong: once | hint: It was given one value and no more
def follow(topic, work):
    def hear(message):
        subscriber.unregister()
        work(message.data)

    subscriber = rospy.Subscriber(topic, Float64, hear, queue_size=1)
    return subscriber

# %% 02.4 wrong: does not return | hint: It has to return at once
def follow(topic, work):
    rospy.Subscriber(topic, Float64, lambda message: work(message.data), queue_size=1)
    rospy.spin()

# %% 02.4 wrong: returns nothing | hint: Return the rospy.Subscriber
def follow(topic, work):
    rospy.Subscriber(topic, Float64, lambda message: work(message.data), queue_size=1)

# %% 02.4 wrong: the same again and again | hint: A value was worked on twice
def follow(topic, work):
    box = []

    def labour():
        while True:
            if box:
                work(box[0])
                work(box[0])
            time.sleep(0.01)

    def hear(message):
        box[:] = [message.data]

    threading.Thread(target=labour, daemon=True).start()
    return rospy.Subscriber(topic, Float64, hear)

# %% 02.4 right: a timer that looks
def follow(topic, work):
    newest = []
    subscriber = rospy.Subscriber(topic, Float64, lambda message: newest.append(message.data))

    def look(event):
        if newest:
            value = newest[-1]
            newest.clear()
            work(value)

    rospy.Timer(rospy.Duration(0.02), look)
    return subscriber

# %% 02.5 right: the time of the last
class Watch:
    def __init__(self, topic):
        self.last = None
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.last = time.monotonic()

    def state(self):
        if self.last is None:
            return "waiting"
        return "running" if time.monotonic() - self.last <= 1.0 else "ended"

# %% 02.5 right: with ROS's clock
class Watch:
    def __init__(self, topic):
        self.last = rospy.Time(0)
        rospy.Subscriber(topic, UInt32, self.callback, queue_size=1)

    def callback(self, message):
        self.last = rospy.Time.now()

    def state(self):
        if self.last.is_zero():
            return "waiting"
        if rospy.Time.now() - self.last > rospy.Duration(1):
            return "ended"
        return "running"

# %% 02.5 wrong: asks whether anything new has come | hint: The last message is less than a second old
class Watch:
    def __init__(self, topic):
        self.count = 0
        self.before = 0
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.count += 1

    def state(self):
        if self.count == 0:
            return "waiting"
        state = "running" if self.count > self.before else "ended"
        self.before = self.count
        return state

# %% 02.5 wrong: counts the publishers | hint: look at the time of the last message
class Watch:
    def __init__(self, topic):
        self.heard = False
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.heard = True

    def state(self):
        if not self.heard:
            return "waiting"
        return "running" if self.subscriber.get_num_connections() else "ended"

# %% 02.5 wrong: waits for a message when asked | hint: Do not wait for a message when you are asked
class Watch:
    def __init__(self, topic):
        self.topic = topic
        self.heard = False

    def hear(self, message):
        self.heard = True

    def state(self):
        try:
            rospy.wait_for_message(self.topic, UInt32, timeout=1)
        except rospy.ROSException:
            return "ended" if self.heard else "waiting"
        self.heard = True
        return "running"

# %% 02.5 wrong: ended before it began | hint: Nothing can have ended that has not begun
class Watch:
    def __init__(self, topic):
        self.last = 0
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.last = time.time()

    def state(self):
        return "running" if time.time() - self.last <= 1 else "ended"

# %% 02.5 wrong: running from the start | hint: No message has come yet
class Watch:
    def __init__(self, topic):
        self.last = time.time()
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.last = time.time()

    def state(self):
        return "running" if time.time() - self.last <= 1 else "ended"

# %% 02.5 wrong: a limit of a tenth | hint: A stream has ended after a whole second without one
class Watch:
    def __init__(self, topic):
        self.last = None
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.last = time.time()

    def state(self):
        if self.last is None:
            return "waiting"
        return "running" if time.time() - self.last <= 0.25 else "ended"

# %% 02.5 wrong: the time of the first | hint: Note the time of each one that comes
class Watch:
    def __init__(self, topic):
        self.last = None
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        if self.last is None:
            self.last = time.time()

    def state(self):
        if self.last is None:
            return "waiting"
        return "running" if time.time() - self.last <= 1 else "ended"

# %% 02.5 wrong: ended for good | hint: The last message is less than a second old
class Watch:
    def __init__(self, topic):
        self.last = None
        self.ended = False
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.last = time.time()

    def state(self):
        if self.last is None:
            return "waiting"
        if time.time() - self.last > 1:
            self.ended = True
        return "ended" if self.ended else "running"

# %% 02.5 wrong: waiting again | hint: A stream that ran and does not any more has ended
class Watch:
    def __init__(self, topic):
        self.last = None
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.last = time.time()

    def state(self):
        if self.last is not None and time.time() - self.last <= 1:
            return "running"
        return "waiting"

# %% 02.5 wrong: nothing to compare with | hint: there is no time to compare with
class Watch:
    def __init__(self, topic):
        self.last = None
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.last = time.time()

    def state(self):
        if time.time() - self.last <= 1:
            return "running"
        return "ended"

# %% 02.5 wrong: listens when it is asked | hint: Make a rospy.Subscriber for the topic, of type UInt32, when the watch is made
class Watch:
    def __init__(self, topic):
        self.topic = topic
        self.last = None

    def hear(self, message):
        self.last = time.monotonic()

    def state(self):
        rospy.Subscriber(self.topic, UInt32, self.hear)
        if self.last is None:
            return "waiting"
        return "running" if time.monotonic() - self.last <= 1.0 else "ended"

# %% 02.5 wrong: one time for all | hint: Keep what a watch knows in self
last = None

class Watch:
    def __init__(self, topic):
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        global last
        last = time.monotonic()

    def state(self):
        if last is None:
            return "waiting"
        return "running" if time.monotonic() - last <= 1.0 else "ended"

# %% 02.5 wrong: in capitals | hint: Write the word as it stands in the exercise
class Watch:
    def __init__(self, topic):
        self.last = None
        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)

    def hear(self, message):
        self.last = time.time()

    def state(self):
        if self.last is None:
            return "Waiting"
        return "Running" if time.time() - self.last <= 1 else "Ended"

# %% 02.5 wrong: of another type | hint: Make a rospy.Subscriber for the topic, of type UInt32
class Watch:
    def __init__(self, topic):
        self.last = None
        self.subscriber = rospy.Subscriber(topic, Float64, self.hear)

    def hear(self, message):
        self.last = time.time()

    def state(self):
        if self.last is None:
            return "waiting"
        return "running" if time.time() - self.last <= 1 else "ended"

# %% 02.5 right: a state that a timer turns
class Watch:
    def __init__(self, topic):
        self._state = "waiting"
        self._timer = None
        rospy.Subscriber(topic, UInt32, self._hear)

    def _hear(self, message):
        if self._timer:
            self._timer.cancel()
        self._state = "running"
        self._timer = threading.Timer(1.0, self._end)
        self._timer.daemon = True
        self._timer.start()

    def _end(self):
        self._state = "ended"

    def state(self):
        return self._state
