"""Example answers of chapter 02; tests/checking/answers/example_answers.py explains the format."""

# %% 02.1 right: uses a rospy.Rate
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_until(publisher.get_num_connections, 2.0)
    pace = rospy.Rate(rate)
    for number in range(count):
        publisher.publish(number)
        pace.sleep()

# %% 02.1 right: uses time.sleep instead of a rate
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=100)
    start = time.time()
    while publisher.get_num_connections() < 1 and time.time() - start < 2:
        rospy.sleep(0.05)
    for number in range(count):
        publisher.publish(UInt32(data=number))
        time.sleep(1 / rate)

# %% 02.1 right: uses a timer
def count_aloud(topic, rate, count):
    publisher = rospy.Publisher(topic, UInt32, queue_size=10)
    wait_until(lambda: publisher.get_num_connections() > 0, seconds=2)
    numbers, done = iter(range(count)), threading.Event()

    def tick(event):
        number = next(numbers, None)
        done.set() if number is None else publisher.publish(number)

    timer = rospy.Timer(rospy.Duration(1 / rate), tick)
    done.wait()
    timer.shutdown()

# %% 02.1 wrong: does not wait for a subscriber | hint: The first number was published
replace("\n    wait_until(publisher.get_num_connections, 2.0)", "")
# %% 02.1 wrong: waits for a subscriber without a limit | hint: Wait at most 2 s for a subscriber
replace("wait_until(publisher.get_num_connections, 2.0)", "while publisher.get_num_connections() == 0:\n        time.sleep(0.01)")
# %% 02.1 wrong: raises an error if there is no subscriber | hint: The function raised an exception when
replace("connections, 2.0)", """connections, 2.0)
    if publisher.get_num_connections() == 0:
        raise RuntimeError("nobody listens")""")
# %% 02.1 wrong: counts from 1 | hint: The first number is 1.
replace("(number)", "(number + 1)")
# %% 02.1 wrong: publishes one additional number | hint: The function published one additional number
replace("(count)", "(count + 1)")
# %% 02.1 wrong: publishes without pauses | hint: The rate is too high
replace("10", "1000")
replace("\n    pace = rospy.Rate(rate)", "")
replace("\n        pace.sleep()", "")
# %% 02.1 wrong: uses the rate as the pause | hint: The function takes too long.
replace("\n    pace = rospy.Rate(rate)", "")
replace("pace.sleep()", "time.sleep(rate)")
# %% 02.1 wrong: sleeps instead of waiting for a subscriber | hint: Check every few milliseconds whether a
replace("wait_until(publisher.get_num_connections, 2.0)", "time.sleep(2)")
# %% 02.1 wrong: publishes one number too few | hint: The last number, `count -
replace("(count)", "(count - 1)")

# %% 02.1 wrong: publishes in a thread | hint: The last numbers are missing
def count_aloud(topic, rate, count):
    def speak():
        publisher = rospy.Publisher(topic, UInt32, queue_size=10)
        wait_until(publisher.get_num_connections, 2.0)
        pace = rospy.Rate(rate)
        for number in range(count):
            publisher.publish(number)
            pace.sleep()

    threading.Thread(target=speak, daemon=True).start()

# %% 02.1 wrong: publishes at half of the rate | hint: The rate is too low
replace("pace.sleep()", "pace.sleep()\n        pace.sleep()")
# %% 02.1 wrong: publishes at two thirds of the rate | hint: The rate is too low
replace("\n    pace = rospy.Rate(rate)", "")
replace("pace.sleep()", "time.sleep(1.5 / rate)")
# %% 02.1 wrong: notices only a subscriber that connects in the first half second | hint: Check every few milliseconds whether a
replace("connections, 2.0)", "connections, 0.5)\n    if not publisher.get_num_connections():\n        time.sleep(1.5)")
# %% 02.1 wrong: publishes in groups of five | hint: The numbers arrive in groups
replace("10", "1000")
replace("\n    pace = rospy.Rate(rate)", "")
replace("pace.sleep()", "if number % 5 == 4:\n            time.sleep(5 / rate)")
# %% 02.1 wrong: publishes another message type | hint: Publish the topic with the type in the exercise
replace("UInt32", "Float64")
# %% 02.1 wrong: uses a fixed topic | hint: Create a rospy.Publisher for the given topic.
replace("topic, UInt32", '"/count", UInt32')
# %% 02.1 wrong: waits only half a second for a subscriber | hint: The wait for a subscriber
replace("2.0", "0.5")
# %% 02.1 wrong: publishes strings | hint: Publish each number as an int,
replace("publish(number)", "publish(str(number))")
# %% 02.1 wrong: publishes nothing | hint: No number arrived. Wait until
replace("publisher.publish(number)", "message = UInt32(number)")
# %% 02.1 wrong: publishes each number twice | hint: One number was published twice.
replace("publisher.publish(number)", "publisher.publish(number)\n        publisher.publish(number)")
# %% 02.1 wrong: publishes in groups of five, with a short queue | hint: Some numbers in the middle
replace("10", "1")
replace("\n    pace = rospy.Rate(rate)", "")
replace("pace.sleep()", "if number % 5 == 4:\n            time.sleep(5 / rate)")

# %% 02.2 right: publishes in the callback
def start_mirror(source, target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def show(message):
        image = JointState(header=message.header, name=message.name)
        image.position = [-angle for angle in message.position]
        image.velocity = [-speed for speed in message.velocity]
        publisher.publish(image)

    return rospy.Subscriber(source, JointState, show)

# %% 02.2 right: publishes a deep copy with new lists
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

# %% 02.2 wrong: does not change the sign of the positions | hint: was not changed. Change the sign
replace("\n    def show(message … JointState, show)", "    return rospy.Subscriber(source, JointState, publisher.publish)")
# %% 02.2 wrong: does not change the sign of the velocities | hint: was not changed. Change the sign
replace("[-speed for speed in message.velocity]", "message.velocity")
# %% 02.2 wrong: omits the velocities | hint: The list in the field
replace("\n        image.velocity = [-speed for speed in message.velocity]", "")
# %% 02.2 wrong: iterates over positions and velocities at the same time | hint: that has no velocities. Change the signs
replace("[-angle for angle in message.position]\n        image.velocity = [-speed for speed in message.velocity]", """[]
        image.velocity = []
        for angle, speed in zip(message.position, message.velocity):
            image.position.append(-angle)
            image.velocity.append(-speed)""")
# %% 02.2 wrong: iterates over names, positions and velocities at the same time | hint: your callback publishes a message without names
replace("name=message.name", "name=[]")
replace("[-angle for angle in message.position]\n        image.velocity = [-speed for speed in message.velocity]", """[]
        image.velocity = []
        for name, angle, speed in zip(message.name, message.position, message.velocity):
            image.name.append(name)
            image.position.append(-angle)
            image.velocity.append(-speed)""")
# %% 02.2 wrong: expects a velocity for each name | hint: that has no velocities. Change the signs
replace("[-speed for speed in message.velocity]", "[-message.velocity[number] for number in range(len(message.name))]")
# %% 02.2 wrong: reverses the lists | hint: Your callback reversed the order
replace("[-angle for angle in message.position]\n        image.velocity = [-speed for speed in message.velocity]", """message.position[::-1]
        image.velocity = message.velocity[::-1]""")
# %% 02.2 wrong: uses absolute values | hint: A negative number has to become positive
replace("-angle", "abs(angle)")
replace("-speed", "abs(speed)")
# %% 02.2 wrong: brings each angle into the range from -π to π | hint: Your callback changed a number to a number between
replace("[-angle", "[(math.pi - angle) % (2 * math.pi) - math.pi")
replace("def start_mirror", "import math\n\n\ndef start_mirror")
# %% 02.2 wrong: keeps the publisher in a global variable | hint: The check started two mirrors
replace("    publisher = rospy", "    global publisher\n    publisher = rospy")
# %% 02.2 wrong: uses a new header | hint: The time stamp is 0
replace("header=message.header, name", "name")
# %% 02.2 wrong: uses the current time as the time stamp | hint: The time stamp differs from
replace("JointState(header=message.header, name=message.name)", """JointState(name=message.name)
        image.header.stamp = rospy.Time.now()""")
# %% 02.2 wrong: keeps values of an earlier, longer message | hint: The length of your list differs
replace("    def show", "    image = JointState(position=[0.0] * 4)\n\n    def show")
replace("image = JointState(header=message.header, name=message.name)\n        image.position = [-angle for angle in message.position]", "image.header, image.name = message.header, message.name\n        for number, angle in enumerate(message.position):\n            image.position[number] = -angle")
# %% 02.2 wrong: omits the names | hint: The names of the joints
replace("header, name=message.name", "header")
# %% 02.2 wrong: creates the publisher in the callback | hint: The topic `target` has no … not in the callback
replace("publisher = … (message):", "def show(message):\n        publisher = rospy.Publisher(target, JointState, queue_size=10)")
# %% 02.2 wrong: waits for messages in a loop and does not return | hint: The function does not return. Return
replace("def show(message):", "while not rospy.is_shutdown():\n        message = rospy.wait_for_message(source, JointState)")
replace("\n\n    return rospy.Subscriber(source, JointState, show)", "")
# %% 02.2 wrong: mirrors only the first message | hint: Your callback published only one message
replace("publisher.publish(image)", "publisher.publish(image)\n        subscriber.unregister()")
replace("return rospy", "subscriber = rospy")
replace("(source, JointState, show)", "(source, JointState, show)\n    return subscriber")
# %% 02.2 wrong: drops all messages except the newest one | hint: Some messages are missing. Do
replace("def show(message):", "def show(message):\n        time.sleep(0.1)")
replace("JointState, show", "JointState, show, queue_size=1")
# %% 02.2 wrong: pauses in the callback | hint: Some messages are missing. Do
replace("def show(message):", "def show(message):\n        time.sleep(0.1)")
# %% 02.2 wrong: publishes each message 0.4 s too late | hint: Your messages are late.
replace("(source, target):", "(source, target):\n    import queue\n")
replace("10)", "10)\n    images = queue.SimpleQueue()")
replace("publisher.publish(image)", "images.put((time.monotonic() + 0.4, image))")
replace("    return", """    def speak():
        while True:
            due, image = images.get()
            time.sleep(max(due - time.monotonic(), 0))
            publisher.publish(image)

    threading.Thread(target=speak, daemon=True).start()
    return""")
# %% 02.2 wrong: publishes each message 0.1 s too late | hint: Your messages are late.
based_on("publishes each message 0.4 s too late")
replace("0.4", "0.1")
# %% 02.2 wrong: publishes each message twice | hint: Some messages were published more
replace("publisher.publish(image)", "publisher.publish(image)\n        publisher.publish(image)")
# %% 02.2 wrong: changes the received message | hint: Your callback changed the received
replace("\n        image = JointState(header=message.header, name=message.name)", "")
replace("image.position", "message.position")
replace("image.velocity", "message.velocity")
replace("image", "message")
# %% 02.2 wrong: returns nothing | hint: Return the rospy.Subscriber object. The
replace("return rospy", "rospy")
# %% 02.2 wrong: publishes nothing | hint: Your callback published no message
replace("publisher.publish(image)", "return image")
# %% 02.2 wrong: exchanges source and target | hint: The topic `target` has no
replace("publisher = … JointState, show)", """publisher = rospy.Publisher(source, JointState, queue_size=10)
    return rospy.Subscriber(target, JointState, lambda message: publisher.publish(message))""")

# %% 02.2 right: passes the publisher as an argument of the callback
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

# %% 02.2 wrong: copies only the time stamp of the header | hint: The `frame_id` in the header
replace("(header=message.header, name=message.name)", "(name=message.name)\n        image.header.stamp = message.header.stamp")
# %% 02.2 wrong: sorts the names | hint: The names are wrong, or
replace("message.name", "sorted(message.name)")
# %% 02.2 wrong: subscribes to the target | hint: Your callback published no message
replace("Subscriber(source", "Subscriber(target")
# %% 02.2 wrong: exchanges positions and velocities | hint: contains the numbers of the field
replace("angle in message.position", "angle in message.velocity")
replace("speed in message.velocity", "speed in message.position")
# %% 02.2 wrong: subtracts the angles from pi | hint: Change only the sign of
replace("[-angle", "[3.14159 - angle")

# %% 02.3 right: compares the value with the last value
class Notice:
    def __init__(self, topic):
        self.publisher = rospy.Publisher(topic, Float64, queue_size=10, latch=True)
        self.value = None

    def set(self, value):
        if value != self.value:
            self.value = value
            self.publisher.publish(value)

# %% 02.3 right: returns early, and creates the publisher with keyword arguments
class Notice:
    last = ()

    def __init__(self, topic):
        self.pub = rospy.Publisher(name=topic, data_class=Float64, latch=True, queue_size=1)

    def set(self, value):
        if (value,) == self.last:
            return
        self.last = (value,)
        self.pub.publish(Float64(data=value))

# %% 02.3 wrong: does not latch the message | hint: No value arrived. Create the
replace("10, latch=True", "10")
# %% 02.3 wrong: waits for a subscriber instead of latching | hint: Do not wait in set().
replace("10, latch=True", "10")
replace("self.publisher.publish(value)", "wait_until(self.publisher.get_num_connections, 0.8)\n            self.publisher.publish(value)")
# %% 02.3 wrong: waits for a subscriber and latches | hint: Do not wait in set().
replace("self.publisher.publish(value)", "wait_until(self.publisher.get_num_connections, 0.5)\n            self.publisher.publish(value)")
# %% 02.3 wrong: pauses in set() for every value except 0 | hint: Do not wait in set().
replace("self.value = value", "self.value = value\n            time.sleep(0.5 if value else 0)")
# %% 02.3 wrong: pauses in set() if the value has not changed | hint: The value was the same as in the previous call
replace("if value != self.value:", "if value == self.value:\n            time.sleep(1)\n        else:")
# %% 02.3 wrong: limits the value to 100 | hint: The published value is not
replace("if value !=", "value = min(value, 100.0)\n        if value !=")
# %% 02.3 wrong: ignores very small changes | hint: A changed value was not published
replace("value != self.value", "self.value is None or abs(value - self.value) > 1e-9")
# %% 02.3 wrong: publishes the value in each call | hint: The same value was published again.
replace("if value != self.value:", "if True:")
# %% 02.3 wrong: starts with the value 0 | hint: The first value was 0
replace("None", "0.0")
# %% 02.3 wrong: ignores the value 0 | hint: The first value was 0
replace("if value != self.value:", "if value and value != self.value:")
# %% 02.3 wrong: publishes in an endless loop | hint: set() does not return
replace("""self.publisher = rospy.Publisher(topic, Float64, queue_size=10, latch=True)
        self.value = None""", "self.publisher = rospy.Publisher(topic, Float64, queue_size=1)")
replace("if value != self.value:\n            self.value = value", "pace = rospy.Rate(10)\n        while not rospy.is_shutdown():")
replace("(value)", "(value)\n            pace.sleep()")
# %% 02.3 wrong: publishes the value repeatedly from a thread | hint: The same value is published
replace("10, latch=True", "1")
replace("= None", """= None
        threading.Thread(target=self.repeat, daemon=True).start()

    def repeat(self):
        while True:
            if self.value is not None:
                self.publisher.publish(self.value)
            time.sleep(0.05)""")
replace("if value != self.value:\n            self.value = value\n            self.publisher.publish(value)", "self.value = value")
# %% 02.3 wrong: unregisters the publisher | hint: Create a rospy.Publisher for the given topic, and do not
replace("self.publisher = rospy.Publisher(topic, Float64, queue_size=10, latch=True)\n        self.value = None", "self.topic = topic")
replace("if value ! … publish(value)", """publisher = rospy.Publisher(self.topic, Float64, queue_size=1, latch=True)
        publisher.publish(value)
        publisher.unregister()""")
# %% 02.3 wrong: publishes another message type | hint: Publish the topic with the type in the exercise
replace("Float64", "String")
replace("publish(value)", "publish(str(value))")
# %% 02.3 wrong: publishes each new value twice | hint: A value was published twice
replace("self.publisher.publish(value)", "self.publisher.publish(value)\n            self.publisher.publish(value)")
# %% 02.3 wrong: publishes no new value while a subscriber is connected | hint: A changed value was not published
replace("if value != self.value:", "if self.value is None or value != self.value and not self.publisher.get_num_connections():")
# %% 02.3 wrong: never publishes an earlier value again | hint: A changed value was not published
replace("self.value = None", "self.values = []")
replace("value != self.value", "value not in self.values")
replace("self.value = value", "self.values.append(value)")
# %% 02.3 wrong: sends all earlier values to a late subscriber | hint: A late subscriber received an older
replace("Notice:", "Notice(rospy.SubscribeListener):")
replace("self.publisher = rospy.Publisher(topic, Float64, queue_size=10, latch=True)\n        self.value = None", """self.values = []
        self.publisher = rospy.Publisher(topic, Float64, subscriber_listener=self, queue_size=10)

    def peer_subscribe(self, topic_name, topic_publish, peer_publish):
        for value in self.values:
            peer_publish(Float64(value))""")
replace("\n        if value ! … publish(value)", "\n        self.values.append(value)\n        self.publisher.publish(value)")
# %% 02.3 wrong: rounds the value | hint: The published value is not
replace("publish(value)", "publish(round(value))")

# %% 02.4 right: uses two lambda functions
def start_robot(angles, draw, orders, prepare):
    return [
        rospy.Subscriber(angles, Float64, lambda message: draw(message.data), queue_size=1),
        rospy.Subscriber(orders, UInt32, lambda message: prepare(message.data)),
    ]

# %% 02.4 right: uses two worker threads
import queue

def start_robot(angles, draw, orders, prepare):
    newest, waiting = queue.LifoQueue(), queue.Queue()

    def drawing():
        while True:
            angle = newest.get()
            while not newest.empty():
                newest.get()
            draw(angle)

    def preparing():
        while True:
            prepare(waiting.get())

    for work in (drawing, preparing):
        threading.Thread(target=work, daemon=True).start()
    first = rospy.Subscriber(angles, Float64, lambda message: newest.put(message.data))
    second = rospy.Subscriber(orders, UInt32, lambda message: waiting.put(message.data))
    return [first, second]

# %% 02.4 wrong: does not limit the queue of the angles | hint: Too many angles wait in the queue
replace("draw(message.data), queue_size=1", "draw(message.data)")
# %% 02.4 wrong: lets ten angles wait in the queue | hint: because only the newest angle is useful
replace("queue_size=1", "queue_size=10")
# %% 02.4 wrong: lets only one order wait in the queue | hint: Some orders were lost
replace("prepare(message.data)", "prepare(message.data), queue_size=1")
# %% 02.4 wrong: lets only ten orders wait in the queue | hint: Some orders were lost. Up to twenty
replace("prepare(message.data)", "prepare(message.data), queue_size=10")
replace("lambda message: prepare", "lambda message: time.sleep(0.02) or prepare")
# %% 02.4 wrong: starts a thread for each angle | hint: () ran at the same time. Do
replace("(angles, draw, orders, prepare):", """(angles, draw, orders, prepare):
    def on_angle(message):
        threading.Thread(target=draw, args=[message.data], daemon=True).start()
""")
replace("lambda message: draw(message.data)", "on_angle")
# %% 02.4 wrong: passes the whole message to draw | hint: draw() got the whole message. Pass
replace("lambda message: draw(message.data)", "draw")
# %% 02.4 wrong: passes the whole message to prepare | hint: prepare() got the whole message. Pass
replace("lambda message: prepare(message.data)", "prepare")
# %% 02.4 wrong: draws only every sixteenth angle | hint: The last angle was 0, and
based_on("starts a thread for each angle")
replace("(angles, draw, orders, prepare):", "(angles, draw, orders, prepare):\n    count = [0]\n")
replace("threading.Thread(target=draw, args=[message.data], daemon=True).start()", """count[0] += 1
        if count[0] % 16 == 1:
            draw(message.data)""")
replace(", queue_size=1", "")
# %% 02.4 wrong: draws only the first angle | hint: draw() got only one angle. Do
based_on("starts a thread for each angle")
replace("threading.Thread(target=draw, args=[message.data], daemon=True).start()", "first.unregister()\n        draw(message.data)")
replace("return [ … ]", """first = rospy.Subscriber(angles, Float64, on_angle, queue_size=1)
    return [first, rospy.Subscriber(orders, UInt32, lambda message: prepare(message.data))]""")
# %% 02.4 wrong: pauses after each drawing | hint: draw() was not called often enough
replace("lambda message: draw(message.data)", "lambda message: (draw(message.data), time.sleep(0.4))")
# %% 02.4 wrong: draws at most four angles per second | hint: In a second series of angles
replace("(angles, draw, orders, prepare):", """(angles, draw, orders, prepare):
    last = [0.0]

    def on_angle(message):
        if time.monotonic() - last[0] >= 0.25:
            last[0] = time.monotonic()
            draw(message.data)
""")
replace("lambda message: draw(message.data)", "on_angle")
# %% 02.4 wrong: ignores the angle 0 | hint: always draw the newest angle, even if
replace("draw(message.data)", "message.data and draw(message.data)")
# %% 02.4 wrong: ignores the order 0 | hint: An order has the number 0, and it was not prepared
replace("prepare(message.data)", "message.data and prepare(message.data)")
# %% 02.4 wrong: prepares each number only once | hint: Two orders contained the same number
replace("return [", "numbers = []\n\n    def on_order(message):\n        if message.data not in numbers:\n            numbers.append(message.data)\n            prepare(message.data)\n\n    return [")
replace("lambda message: prepare(message.data)", "on_order")
# %% 02.4 wrong: does not return | hint: The function does not return. Return
replace("return [", "subscribers = [")
replace("    ]", "    ]\n    rospy.spin()\n    return subscribers")
# %% 02.4 wrong: returns nothing | hint: Return a list of two rospy.Subscriber objects
replace("return [", "subscribers = [")
# %% 02.4 wrong: draws each angle twice | hint: An angle was drawn twice
replace("draw(message.data),", "(draw(message.data), draw(message.data)),")
# %% 02.4 wrong: prepares each order twice | hint: An order was prepared twice
replace("prepare(message.data)", "(prepare(message.data), prepare(message.data))")

# %% 02.4 wrong: prepares the newest order first | hint: The orders were prepared in
def start_robot(angles, draw, orders, prepare):
    waiting = []

    def preparing():
        while True:
            if len(waiting) > 1 or waiting and time.monotonic() > quiet[0]:
                prepare(waiting.pop())
            time.sleep(0.001)

    quiet = [0.0]

    def on_order(message):
        quiet[0] = time.monotonic() + 0.1
        waiting.append(message.data)

    threading.Thread(target=preparing, daemon=True).start()
    return [
        rospy.Subscriber(angles, Float64, lambda message: draw(message.data), queue_size=1),
        rospy.Subscriber(orders, UInt32, on_order),
    ]

# %% 02.4 wrong: uses a fixed topic for the angles | hint: for the topic whose name is in `angles`
replace("Subscriber(angles", 'Subscriber("/angle"')
# %% 02.4 wrong: uses another message type for the orders | hint: for the topic whose name is in `orders`
replace("UInt32", "Float64")
# %% 02.4 wrong: replaces the method that draw() calls | hint: draw() was not called. Call
replace("(angles, draw, orders, prepare):", """(angles, draw, orders, prepare):
    type(draw).__call__ = lambda self, value: time.sleep(0.25)""")
# %% 02.4 wrong: does not call draw | hint: draw() was not called. Call
replace("draw(message.data)", "draw")
# %% 02.4 wrong: does not call prepare | hint: prepare() was not called. Call
replace("prepare(message.data)", "prepare")
# %% 02.4 wrong: rounds the angle | hint: draw() got an angle that was
replace("draw(message.data)", "draw(round(message.data))")
# %% 02.4 wrong: counts the orders from 1 | hint: prepare() got an order that was
replace("prepare(message.data)", "prepare(message.data + 10000)")

# %% 02.5 right: stores the time of the last message
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

# %% 02.5 wrong: compares the number of messages with the number at the last call | hint: The last message arrived less than
replace("last = None", "count = 0\n        self.before = 0")
replace("last = time.monotonic()", "count += 1")
replace("last is None", "count == 0")
replace('return "running" if time.monotonic() - self.last <= 1.0 else "ended"', """state = "running" if self.count > self.before else "ended"
        self.before = self.count
        return state""")
# %% 02.5 wrong: counts the publishers | hint: No message has arrived for more
replace("self.last = None", "self.heard = False")
replace("self.last = time.monotonic()", "self.heard = True")
replace("self.last is None", "not self.heard")
replace("time.monotonic() - self.last <= 1.0", "self.subscriber.get_num_connections()")
# %% 02.5 wrong: pauses in state() | hint: Do not wait for a
replace("if self.last is None", "now = time.monotonic()\n        time.sleep(0.3)\n        if self.last is None")
replace("time.monotonic() - self.last", "now - self.last")
# %% 02.5 wrong: waits for a message in state() | hint: Do not wait for a
replace("self.last = None\n        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)", """self.topic = topic
        self.heard = False""")
replace("last = time.monotonic()", "heard = True")
replace('if self.last … else "ended"', '''try:
            rospy.wait_for_message(self.topic, UInt32, timeout=1)
        except rospy.ROSException:
            return "ended" if self.heard else "waiting"
        self.heard = True
        return "running"''')
# %% 02.5 wrong: returns "ended" before the first message | hint: so the stream cannot have ended
replace("self.last = None", "self.last = 0")
replace('\n        if self.last is None:\n            return "waiting"', "")
# %% 02.5 wrong: returns "running" before the first message | hint: Return "waiting", not
replace("self.last = None", "self.last = time.monotonic()")
replace('\n        if self.last is None:\n            return "waiting"', "")
# %% 02.5 wrong: uses a time limit of 0.25 s | hint: Less than a second has passed since
replace("1.0", "0.25")
# %% 02.5 wrong: uses a time limit of 0.8 s | hint: Less than a second has passed since
replace("1.0", "0.8")
# %% 02.5 wrong: ignores messages with the number 0 | hint: Messages with the number 0 have arrived
replace("self.last = time", "if message.data:\n            self.last = time")
# %% 02.5 wrong: stores the time of the first message | hint: The last message arrived less than
replace("self.last = time.monotonic()", "if self.last is None:\n            self.last = time.monotonic()")
# %% 02.5 wrong: never returns "running" again after "ended" | hint: The last message arrived less than
replace("self.last = None", "self.last = None\n        self.ended = False")
replace('\n        return "running" if time.monotonic() - self.last <= 1.0 else "ended"', '''
        if time.monotonic() - self.last > 1:
            self.ended = True
        return "ended" if self.ended else "running"''')
# %% 02.5 wrong: waits in state() for another message | hint: Do not wait for a
replace('return "running" if', 'time.sleep(0.3 if 0.3 < time.monotonic() - self.last < 1.0 else 0.0)\n        return "running" if')
# %% 02.5 wrong: returns "waiting" after the stream has ended | hint: Some messages have arrived, but no message
replace('"ended"', '"waiting"')
# %% 02.5 wrong: calculates with None before the first message | hint: Before the first message, no time
replace('if self.last … else "ended"', 'if time.monotonic() - self.last <= 1.0:\n            return "running"\n        return "ended"')
# %% 02.5 wrong: subscribes in state() | hint: In `__init__`, create a rospy.Subscriber
replace("def __init__(self, topic):", "def __init__(self, topic):\n        self.topic = topic")
replace("\n        self.subscriber = rospy.Subscriber(topic, UInt32, self.hear)", "")
replace("(self):", "(self):\n        rospy.Subscriber(self.topic, UInt32, self.hear)")
# %% 02.5 wrong: uses one global time for all watches | hint: this Watch object received no message
replace("class Watch:", "last = None\nclass Watch:")
replace("\n        self.last = None", "")
replace("self.last = time.monotonic()", "global last\n        last = time.monotonic()")
replace("self.last is None", "last is None")
replace("self.last", "last")
# %% 02.5 wrong: returns strings with capital letters | hint: The spelling of the string
replace('return "waiting"\n        return "running" if time.monotonic() - self.last <= 1.0 else "ended"', '''return "Waiting"
        return "Running" if time.monotonic() - self.last <= 1.0 else "Ended"''')
# %% 02.5 wrong: subscribes with another message type | hint: In `__init__`, create a rospy.Subscriber
replace("UInt32", "Float64")

# %% 02.5 right: uses a timer that changes the state
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

# %% 02.5 wrong: returns a number instead of a string | hint: state() did not return one
replace('return "waiting"', "return 0")
# %% 02.5 wrong: waits in state() for the first message | hint: state() waits for a message.
replace('if self.last is None:\n            return "waiting"', "while self.last is None:\n            time.sleep(0.01)")
# %% 02.5 wrong: stores the time in a local variable | hint: Messages arrived before the first call of state()
replace("self.last = time", "last = time")
# %% 02.5 wrong: returns "ended" 1.2 s too late | hint: No message has arrived for
replace("<= 1.0", "<= 2.2")

# %% 02.1 wrong: publishes nothing without a subscriber | hint: publish all numbers at the given rate
replace("\n    wait_until(publisher.get_num_connections, 2.0)\n    pace = rospy.Rate(rate)", """
    end = time.monotonic() + 2
    while not publisher.get_num_connections():
        if time.monotonic() > end:
            return
        time.sleep(0.005)
    pause = rospy.Rate(rate)""")
replace("pace.", "pause.")
# %% 02.1 wrong: pauses for too short times | hint: The pauses between the numbers
based_on("uses time.sleep instead of a rate")
replace("sleep(1 / rate)", "sleep(0.8 / rate)")
# %% 02.1 wrong: publishes nothing without a subscriber, but takes the same time | hint: If there is no subscriber, wait 2
replace("2.0)", "2.0)\n    if not publisher.get_num_connections():\n        time.sleep(count / rate)\n        return")

# %% 02.3 wrong: treats the last value 0 as missing | hint: The same value was published again
replace("self.value = None", "self.last = None")
replace("\n        if value != self.value:\n            self.value = value\n            self.publisher.publish(value)", """
        if self.last and self.last == value:
            return
        self.last = value
        self.publisher.publish(value)""")
# %% 02.3 wrong: ignores changes of at most 0.001 | hint: A changed value was not published
based_on("treats the last value 0 as missing")
replace("self.last and self.last == value", "self.last is not None and abs(value - self.last) <= 0.001")
# %% 02.3 wrong: stores the last value in a global variable | hint: not in the class or in a global variable
based_on("treats the last value 0 as missing")
replace("        self.last = None\n", "")
replace("class Notice:\n", "last = None\n\n\nclass Notice:\n")
replace("if self.last and self.last == value", "global last\n        if last == value")
replace("self.last = value", "last = value")
# %% 02.3 wrong: shares the last value among all objects | hint: No value arrived. Create the
based_on("treats the last value 0 as missing")
replace("        self.last = None\n", "")
replace("class Notice:\n", "class Notice:\n    last = [None]\n\n")
replace("self.last and self.last == value", "self.last[0] == value")
replace("self.last = value", "self.last[0] = value")

# %% 02.4 wrong: returns the subscribers in the wrong order | hint: The two subscribers are in the
replace("\n    ]", "\n    ][::-1]")

# %% 02.2 wrong: returns the publisher | hint: Return the rospy.Subscriber
replace("return rospy", "rospy")
replace("show)", "show)\n    return publisher")
# %% 02.2 wrong: returns another subscriber | hint: Return the rospy.Subscriber object. The
replace("return rospy.Subscriber(source, JointState, show)", "rospy.Subscriber(source, JointState, show)\n    return rospy.Subscriber(source, JointState, str)")

# %% 02.5 wrong: finds the end of a stream only once | hint: Find the end of every stream
class Watch:
    def __init__(self, topic):
        self._state = "waiting"
        self.last = 0.0
        self.subscriber = rospy.Subscriber(topic, UInt32, self.receive)

    def receive(self, message):
        self.last = time.monotonic()
        if self._state == "waiting":
            threading.Thread(target=self.observe, daemon=True).start()
        self._state = "running"

    def observe(self):
        while time.monotonic() - self.last <= 1.0:
            time.sleep(0.01)
        self._state = "ended"

    def state(self):
        return self._state
