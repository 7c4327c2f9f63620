"""What students answer in chapter 08; see answers.py for the form of this file."""

# %% before
import math
import rospy
from course_pkg import join
from course_pkg.srv import ChangeRate, ChangeRateResponse, ChangeSpeed, ChangeSpeedResponse
from course_pkg.turtlesim import Toggling, drive
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty, EmptyResponse, SetBool, SetBoolResponse
from turtlesim.srv import Spawn

node = join("chapter_08")

# %% 08.1 right: waits, then asks
def spawn_turtle(x, y, theta, name, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        return rospy.ServiceProxy("/spawn", Spawn)(x, y, theta, name).name
    except (rospy.ROSException, rospy.ServiceException):
        return None

# %% 08.1 right: in two steps, by fields
def spawn_turtle(x, y, theta, name, patience):
    try:
        rospy.wait_for_service("/spawn", patience)
    except rospy.ROSException:
        return None
    try:
        response = node.call("/spawn", Spawn, x=x, y=y, theta=theta, name=name)
    except rospy.ServiceException:
        return None
    return response.name

# %% 08.1 wrong: does not wait | hint: Wait for the service first
def spawn_turtle(x, y, theta, name, patience):
    try:
        return node.call("/spawn", Spawn, x, y, theta, name).name
    except rospy.ServiceException as error:
        if "unavailable" in str(error):
            raise
        return None

# %% 08.1 wrong: gives up at once | hint: It came after 1.3 s
def spawn_turtle(x, y, theta, name, patience):
    try:
        return node.call("/spawn", Spawn, x, y, theta, name).name
    except rospy.ServiceException:
        return None

# %% 08.1 wrong: waits without a limit | hint: It waited longer than
def spawn_turtle(x, y, theta, name, patience):
    rospy.wait_for_service("/spawn")
    try:
        return node.call("/spawn", Spawn, x, y, theta, name).name
    except rospy.ServiceException:
        return None

# %% 08.1 wrong: catches the wrong one | hint: Catch that one, too
def spawn_turtle(x, y, theta, name, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        return node.call("/spawn", Spawn, x, y, theta, name).name
    except rospy.ServiceException:
        return None

# %% 08.1 wrong: lets a refusal out | hint: A refusal raises
def spawn_turtle(x, y, theta, name, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
    except rospy.ROSException:
        return None
    return node.call("/spawn", Spawn, x, y, theta, name).name

# %% 08.1 wrong: returns the wish | hint: The simulator says which one it gave
def spawn_turtle(x, y, theta, name, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        node.call("/spawn", Spawn, x, y, theta, name)
        return name
    except (rospy.ROSException, rospy.ServiceException):
        return None

# %% 08.1 wrong: forgets theta | hint: look to the right
def spawn_turtle(x, y, theta, name, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        return node.call("/spawn", Spawn, x=x, y=y, name=name).name
    except (rospy.ROSException, rospy.ServiceException):
        return None

# %% 08.1 wrong: two seconds always | hint: It waited longer than
def spawn_turtle(x, y, theta, name, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=2)
        return node.call("/spawn", Spawn, x, y, theta, name).name
    except (rospy.ROSException, rospy.ServiceException):
        return None

# %% 08.1 wrong: a name of its own | hint: The name is another than
def spawn_turtle(x, y, theta, name, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        return node.call("/spawn", Spawn, x, y, theta, "turtle2").name
    except (rospy.ROSException, rospy.ServiceException):
        return None

# %% 08.2 after
toggle = Toggle()
drive(node, toggle)
node.serve("/toggle_forward", Empty, toggle.handle_toggle)

# %% 08.2 right: a boolean
class Toggle:
    def __init__(self):
        self.rate = 10.0
        self.forward = True

    def velocity(self):
        return (1.0, 0.0) if self.forward else (0.0, 1.0)

    def handle_toggle(self, request):
        self.forward = not self.forward
        return EmptyResponse()

# %% 08.2 right: two pairs that change places
class Toggle:
    def __init__(self):
        self.rate = 20
        self.pairs = [[1, 0], [0, 1]]

    def velocity(self):
        return self.pairs[0]

    def handle_toggle(self, request):
        self.pairs.reverse()
        return {}

# %% 08.2 wrong: changes over by itself | hint: Nobody had called
class Toggle:
    def __init__(self):
        self.rate = 10.0
        self.forward = True

    def velocity(self):
        self.forward = not self.forward
        return (1.0, 0.0) if self.forward else (0.0, 1.0)

    def handle_toggle(self, request):
        self.forward = not self.forward
        return EmptyResponse()

# %% 08.2 wrong: never back | hint: never back
class Toggle:
    def __init__(self):
        self.rate = 10.0
        self.forward = True

    def velocity(self):
        return (1.0, 0.0) if self.forward else (0.0, 1.0)

    def handle_toggle(self, request):
        self.forward = False
        return EmptyResponse()

# %% 08.2 wrong: a variable of the handler's own | hint: velocity() has to look at
class Toggle:
    def __init__(self):
        self.rate = 10.0
        self.forward = True

    def velocity(self):
        return (1.0, 0.0) if self.forward else (0.0, 1.0)

    def handle_toggle(self, request):
        forward = not self.forward
        return EmptyResponse()

# %% 08.2 wrong: an arc | hint: is an arc
class Toggle:
    def __init__(self):
        self.rate = 10.0
        self.forward = True

    def velocity(self):
        return (1.0, 0.0) if self.forward else (1.0, 1.0)

    def handle_toggle(self, request):
        self.forward = not self.forward
        return EmptyResponse()

# %% 08.2 wrong: no response | hint: EmptyResponse()
class Toggle:
    def __init__(self):
        self.rate = 10.0
        self.forward = True

    def velocity(self):
        return (1.0, 0.0) if self.forward else (0.0, 1.0)

    def handle_toggle(self, request):
        self.forward = not self.forward

# %% 08.2 wrong: no rate | hint: Look at the drive
class Toggle:
    def __init__(self):
        self.forward = True

    def velocity(self):
        return (1.0, 0.0) if self.forward else (0.0, 1.0)

    def handle_toggle(self, request):
        self.forward = not self.forward
        return EmptyResponse()

# %% 08.2 wrong: begins with a turn | hint: A new one begins straight on
class Toggle:
    def __init__(self):
        self.rate = 10.0
        self.forward = False
    def velocity(self):
        return (1.0, 0.0) if self.forward else (0.0, 1.0)
    def handle_toggle(self, request):
        self.forward = not self.forward
        return EmptyResponse()

# %% 08.3 after
plus = Plus()
drive(node, plus)
node.serve("/change_rate", ChangeRate, plus.handle_rate)

# %% 08.3 right: looks, keeps, sets
class Plus(Toggling):
    def handle_rate(self, request):
        if not 0 < request.rate <= 100:
            raise rospy.ServiceException(f"rate is {request.rate}")
        before = self.rate
        self.rate = request.rate
        return ChangeRateResponse(before=before)

# %% 08.3 right: in one line
class Plus(Toggling):
    def handle_rate(self, request):
        if math.isnan(request.rate) or request.rate <= 0 or request.rate > 100:
            raise rospy.ServiceException("above 0, and at most 100")
        before, self.rate = self.rate, request.rate
        return before

# %% 08.3 wrong: keeps a period | hint: That is a period
class Plus(Toggling):
    def handle_rate(self, request):
        if not 0 < request.rate <= 100:
            raise rospy.ServiceException("no rate")
        before = self.rate
        self.rate = 1 / request.rate
        return before

# %% 08.3 wrong: returns the new one | hint: That is the new rate
class Plus(Toggling):
    def handle_rate(self, request):
        if not 0 < request.rate <= 100:
            raise rospy.ServiceException("no rate")
        self.rate = request.rate
        return self.rate

# %% 08.3 wrong: sets another variable | hint: The drive reads
class Plus(Toggling):
    frequency = 2.0

    def handle_rate(self, request):
        if not 0 < request.rate <= 100:
            raise rospy.ServiceException("no rate")
        before, self.frequency = self.frequency, request.rate
        return before

# %% 08.3 wrong: takes anything | hint: It was accepted
class Plus(Toggling):
    def handle_rate(self, request):
        before = self.rate
        if request.rate:
            self.rate = request.rate
        return before

# %% 08.3 wrong: stumbles instead of refusing | hint: Refuse on purpose
class Plus(Toggling):
    def handle_rate(self, request):
        if not 0 < request.rate <= 100:
            raise ValueError("no rate")
        before, self.rate = self.rate, request.rate
        return before

# %% 08.3 wrong: sets it, then looks | hint: Look at it first, then set it
class Plus(Toggling):
    def handle_rate(self, request):
        before, self.asked = getattr(self, "asked", self.rate), request.rate
        if not 0 < request.rate <= 100:
            raise rospy.ServiceException("no rate")
        self.rate = request.rate
        return before

# %% 08.3 wrong: an empty response | hint: Keep the old rate in a variable
class Plus(Toggling):
    def handle_rate(self, request):
        if not 0 < request.rate <= 100:
            raise rospy.ServiceException("no rate")
        self.rate = request.rate
        return ChangeRateResponse()

# %% 08.3 wrong: whole numbers | hint: The fraction is lost
class Plus(Toggling):
    def handle_rate(self, request):
        if not 0 < request.rate <= 100:
            raise rospy.ServiceException("no rate")
        before, self.rate = self.rate, max(1, int(request.rate))
        return before

# %% 08.3 wrong: below 100 | hint: 100 itself included
class Plus(Toggling):
    def handle_rate(self, request):
        if not 0 < request.rate < 100:
            raise rospy.ServiceException("no rate")
        before, self.rate = self.rate, request.rate
        return before

# %% 08.3 wrong: up to 1000 | hint: 100.5 is not allowed
class Plus(Toggling):
    def handle_rate(self, request):
        if not 0 < request.rate <= 1000:
            raise rospy.ServiceException("no rate")
        before, self.rate = self.rate, request.rate
        return before

# %% 08.3 wrong: one at least | hint: It was refused, and is allowed
class Plus(Toggling):
    def handle_rate(self, request):
        if not 1 <= request.rate <= 100:
            raise rospy.ServiceException("no rate")
        before, self.rate = self.rate, request.rate
        return before

# %% 08.4 after
faster = Faster(rate=20.0)
drive(node, faster)
node.serve("/toggle_forward", Empty, faster.handle_toggle)
node.serve("/change_speed", ChangeSpeed, faster.handle_speed)

# %% 08.4 right: a speed of its own
class Faster(Toggling):
    speed = 1.0

    def velocity(self):
        return (self.speed, 0.0) if self.forward else (0.0, 1.0)

    def handle_speed(self, request):
        if not math.isfinite(request.speed):
            raise rospy.ServiceException(f"speed is {request.speed}")
        before, self.speed = self.speed, request.speed
        return ChangeSpeedResponse(before)

# %% 08.4 right: by way of the driver that it extends
class Faster(Toggling):
    def __init__(self, rate):
        super().__init__(rate)
        self.factor = 1.0

    def velocity(self):
        forward, turn = super().velocity()
        return forward * self.factor, turn

    def handle_speed(self, request):
        if request.speed != request.speed or abs(request.speed) == float("inf"):
            raise rospy.ServiceException("a number, please")
        before = self.factor
        self.factor = request.speed
        return {"before": before}

# %% 08.4 wrong: no velocity of its own | hint: It goes at 1.0 still
class Faster(Toggling):
    speed = 1.0

    def handle_speed(self, request):
        if not math.isfinite(request.speed):
            raise rospy.ServiceException("no speed")
        before, self.speed = self.speed, request.speed
        return before

# %% 08.4 wrong: turns as fast | hint: The turn has changed with the speed
class Faster(Toggling):
    speed = 1.0

    def velocity(self):
        return (self.speed, 0.0) if self.forward else (0.0, self.speed)

    def handle_speed(self, request):
        if not math.isfinite(request.speed):
            raise rospy.ServiceException("no speed")
        before, self.speed = self.speed, request.speed
        return before

# %% 08.4 wrong: never turns | hint: Ask self.forward
class Faster(Toggling):
    speed = 1.0

    def velocity(self):
        return self.speed, 0.0

    def handle_speed(self, request):
        if not math.isfinite(request.speed):
            raise rospy.ServiceException("no speed")
        before, self.speed = self.speed, request.speed
        return before

# %% 08.4 wrong: whole numbers only | hint: The fraction is lost
class Faster(Toggling):
    speed = 1.0
    last = 1.0

    def velocity(self):
        return (int(self.speed), 0.0) if self.forward else (0.0, 1.0)

    def handle_speed(self, request):
        if not math.isfinite(request.speed):
            raise rospy.ServiceException("no speed")
        before, self.speed = self.speed, request.speed
        return before

# %% 08.4 wrong: returns the new one | hint: That is the new speed
class Faster(Toggling):
    speed = 1.0

    def velocity(self):
        return (self.speed, 0.0) if self.forward else (0.0, 1.0)

    def handle_speed(self, request):
        if not math.isfinite(request.speed):
            raise rospy.ServiceException("no speed")
        self.speed = request.speed
        return self.speed

# %% 08.4 wrong: forwards only | hint: backwards
class Faster(Toggling):
    speed = 1.0

    def velocity(self):
        return (self.speed, 0.0) if self.forward else (0.0, 1.0)

    def handle_speed(self, request):
        if not math.isfinite(request.speed):
            raise rospy.ServiceException("no speed")
        before, self.speed = self.speed, abs(request.speed)
        return before

# %% 08.4 wrong: takes nan | hint: nan is neither above nor below
class Faster(Toggling):
    speed = 1.0

    def velocity(self):
        return (self.speed, 0.0) if self.forward else (0.0, 1.0)

    def handle_speed(self, request):
        before, self.speed = self.speed, request.speed
        return before

# %% 08.4 wrong: sets it, then looks | hint: The refused speed was set
class Faster(Toggling):
    speed = 1.0
    def velocity(self):
        return (self.speed if math.isfinite(self.speed) else 1.0, 0.0) if self.forward else (0.0, 1.0)
    def handle_speed(self, request):
        before, self.speed = self.speed, request.speed
        if not math.isfinite(request.speed):
            raise rospy.ServiceException("no speed")
        return before

# %% 08.4 wrong: begins at 2 | hint: A new one goes at 1.0
class Faster(Toggling):
    speed = 2.0
    def velocity(self):
        return (self.speed, 0.0) if self.forward else (0.0, 1.0)
    def handle_speed(self, request):
        if not math.isfinite(request.speed):
            raise rospy.ServiceException("no speed")
        before, self.speed = self.speed, request.speed
        return before

# %% 08.4 wrong: takes minus infinity | hint: -inf is not allowed
class Faster(Toggling):
    speed = 1.0
    def velocity(self):
        return (self.speed, 0.0) if self.forward else (0.0, 1.0)
    def handle_speed(self, request):
        if math.isnan(request.speed) or request.speed == math.inf:
            raise rospy.ServiceException("no speed")
        before, self.speed = self.speed, request.speed
        return before

# %% 08.4 wrong: a limit of its own | hint: every finite number is a speed
class Faster(Toggling):
    speed = 1.0
    def velocity(self):
        return (self.speed, 0.0) if self.forward else (0.0, 1.0)
    def handle_speed(self, request):
        if not math.isfinite(request.speed) or request.speed < 0:
            raise rospy.ServiceException("no speed")
        before, self.speed = self.speed, request.speed
        return before

# %% 08.4 wrong: adds it up | hint: nothing added to it
class Faster(Toggling):
    speed = 1.0
    def velocity(self):
        return (self.speed, 0.0) if self.forward else (0.0, 1.0)
    def handle_speed(self, request):
        if not math.isfinite(request.speed):
            raise rospy.ServiceException("no speed")
        before = self.speed
        self.speed += request.speed
        return before

# %% 08.5 after
stoppable = Stoppable(rate=20.0)
drive(node, stoppable)
node.serve("/toggle_forward", Empty, stoppable.handle_toggle)
node.serve("/start_stop", SetBool, stoppable.handle_start_stop)

# %% 08.5 right: compares, then sets
class Stoppable(Toggling):
    moving = True

    def velocity(self):
        return super().velocity() if self.moving else (0.0, 0.0)

    def handle_start_stop(self, request):
        word = "already " if request.data == self.moving else ""
        self.moving = request.data
        return SetBoolResponse(True, word + ("moving" if self.moving else "standing"))

# %% 08.5 right: a factor
class Stoppable(Toggling):
    def __init__(self, rate):
        super().__init__(rate)
        self.factor = 1

    def velocity(self):
        return [self.factor * each for each in super().velocity()]

    def handle_start_stop(self, request):
        if self.factor == int(request.data):
            return True, "it was already so"
        self.factor = int(request.data)
        return True, "done"

# %% 08.5 wrong: toggles | hint: It had just been changed
class Stoppable(Toggling):
    moving = True

    def velocity(self):
        return super().velocity() if self.moving else (0.0, 0.0)

    def handle_start_stop(self, request):
        self.moving = request.data
        return SetBoolResponse(True, "already so" if request.data == self.moving else "done")

# %% 08.5 wrong: success is what was asked | hint: success=True
class Stoppable(Toggling):
    moving = True

    def velocity(self):
        return super().velocity() if self.moving else (0.0, 0.0)

    def handle_start_stop(self, request):
        already = request.data == self.moving
        self.moving = request.data
        return SetBoolResponse(request.data, "already" if already else "done")

# %% 08.5 wrong: says nothing | hint: The message is empty
class Stoppable(Toggling):
    moving = True

    def velocity(self):
        return super().velocity() if self.moving else (0.0, 0.0)

    def handle_start_stop(self, request):
        self.moving = request.data
        return SetBoolResponse(success=True)

# %% 08.5 wrong: never says already | hint: It was so already: say so
class Stoppable(Toggling):
    moving = True

    def velocity(self):
        return super().velocity() if self.moving else (0.0, 0.0)

    def handle_start_stop(self, request):
        self.moving = request.data
        return SetBoolResponse(True, "moving" if self.moving else "standing")

# %% 08.5 wrong: goes on | hint: has to return (0.0, 0.0)
class Stoppable(Toggling):
    moving = True

    def handle_start_stop(self, request):
        already = request.data == self.moving
        self.moving = request.data
        return SetBoolResponse(True, "already" if already else "done")

# %% 08.5 wrong: forgets which way | hint: Stopping leaves self.forward alone
class Stoppable(Toggling):
    moving = True

    def velocity(self):
        return super().velocity() if self.moving else (0.0, 0.0)

    def handle_start_stop(self, request):
        already = request.data == self.moving
        self.moving = request.data
        if not self.moving:
            self.forward = True
        return SetBoolResponse(True, "already" if already else "done")

# %% 08.5 right: with a capital
class Stoppable(Toggling):
    def __init__(self, rate):
        super().__init__(rate)
        self.moving = True
    def velocity(self):
        if not self.moving:
            return 0.0, 0.0
        return Toggling.velocity(self)
    def handle_start_stop(self, request):
        if self.moving == request.data:
            return SetBoolResponse(True, "Already " + ("moving." if self.moving else "standing."))
        self.moving = request.data
        return SetBoolResponse(True, "Moving." if self.moving else "Standing.")

# %% 08.5 wrong: says nothing when it does something | hint: The message is empty
class Stoppable(Toggling):
    moving = True
    def velocity(self):
        return super().velocity() if self.moving else (0.0, 0.0)
    def handle_start_stop(self, request):
        word = "already" if request.data == self.moving else ""
        self.moving = request.data
        return SetBoolResponse(True, word)

# %% 08.5 wrong: refuses | hint: it does not refuse
class Stoppable(Toggling):
    moving = True
    def velocity(self):
        return super().velocity() if self.moving else (0.0, 0.0)
    def handle_start_stop(self, request):
        if request.data == self.moving:
            raise rospy.ServiceException("already")
        self.moving = request.data
        return SetBoolResponse(True, "done")

# %% 08.6 right: subscribe and advertise
def follow(leader, follower):
    publisher = node.advertise(f"/{follower}/cmd_vel", Twist)
    node.subscribe(f"/{leader}/cmd_vel", Twist, publisher.publish)

# %% 08.6 right: rospy's own
def follow(leader, follower):
    publisher = rospy.Publisher(f"/{follower}/cmd_vel", Twist, queue_size=10)

    def pass_on(message):
        order = Twist(linear=message.linear, angular=message.angular)
        publisher.publish(order)

    rospy.Subscriber(f"/{leader}/cmd_vel", Twist, pass_on)

# %% 08.6 wrong: without the turn | hint: The turn is missing
def follow(leader, follower):
    publisher = node.advertise(f"/{follower}/cmd_vel", Twist)

    def pass_on(message):
        order = Twist()
        order.linear = message.linear
        publisher.publish(order)

    node.subscribe(f"/{leader}/cmd_vel", Twist, pass_on)

# %% 08.6 wrong: x and z only | hint: A part of the message is missing
def follow(leader, follower):
    publisher = node.advertise(f"/{follower}/cmd_vel", Twist)

    def pass_on(message):
        order = Twist()
        order.linear.x, order.angular.z = message.linear.x, message.angular.z
        publisher.publish(order)

    node.subscribe(f"/{leader}/cmd_vel", Twist, pass_on)

# %% 08.6 wrong: the names of one pair only | hint: Nobody speaks to the follower
def follow(leader, follower):
    publisher = node.advertise("/MyTurtle/cmd_vel", Twist)
    node.subscribe("/turtle1/cmd_vel", Twist, publisher.publish)

# %% 08.6 wrong: the leader of one pair only | hint: Subscribe to what the leader is told
def follow(leader, follower):
    publisher = node.advertise(f"/{follower}/cmd_vel", Twist)
    node.subscribe("/turtle1/cmd_vel", Twist, publisher.publish)

# %% 08.6 wrong: only what is new | hint: Some are missing
def follow(leader, follower):
    publisher = node.advertise(f"/{follower}/cmd_vel", Twist)
    last = []

    def pass_on(message):
        if message not in last:
            last[:] = [message]
            publisher.publish(message)

    node.subscribe(f"/{leader}/cmd_vel", Twist, pass_on)

# %% 08.6 wrong: waits itself | hint: Let a callback do it
def follow(leader, follower):
    publisher = node.advertise(f"/{follower}/cmd_vel", Twist)
    while True:
        publisher.publish(rospy.wait_for_message(f"/{leader}/cmd_vel", Twist))

# %% 08.7 right: one try
def bring_turtle(name, x, y, speed, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        given = node.call("/spawn", Spawn, x, y, 0, name).name
        rospy.wait_for_service("/toggle_forward", timeout=patience)
        node.call("/toggle_forward", Empty)
        rospy.wait_for_service("/change_speed", timeout=patience)
        node.call("/change_speed", ChangeSpeed, speed)
    except (rospy.ROSException, rospy.ServiceException):
        return None
    return given

# %% 08.7 right: a loop
def bring_turtle(name, x, y, speed, patience):
    calls = [
        ("/spawn", Spawn, (x, y, 0.0, name)),
        ("/toggle_forward", Empty, ()),
        ("/change_speed", ChangeSpeed, (speed,)),
    ]
    responses = []
    for service, kind, values in calls:
        try:
            rospy.wait_for_service(service, patience)
            responses.append(rospy.ServiceProxy(service, kind)(*values))
        except (rospy.ROSException, rospy.ServiceException):
            return None
    return responses[0].name

# %% 08.7 wrong: the speed first | hint: a turtle first
def bring_turtle(name, x, y, speed, patience):
    try:
        for service in ("/spawn", "/toggle_forward", "/change_speed"):
            rospy.wait_for_service(service, timeout=patience)
        node.call("/change_speed", ChangeSpeed, speed)
        node.call("/toggle_forward", Empty)
        return node.call("/spawn", Spawn, x, y, 0, name).name
    except (rospy.ROSException, rospy.ServiceException):
        return None

# %% 08.7 wrong: no toggle | hint: Not all three were asked
def bring_turtle(name, x, y, speed, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        given = node.call("/spawn", Spawn, x, y, 0, name).name
        node.call("/change_speed", ChangeSpeed, speed)
    except (rospy.ROSException, rospy.ServiceException):
        return None
    return given

# %% 08.7 wrong: says that it worked | hint: That says that it worked
def bring_turtle(name, x, y, speed, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        node.call("/spawn", Spawn, x, y, 0, name)
        rospy.wait_for_service("/toggle_forward", timeout=patience)
        node.call("/toggle_forward", Empty)
        node.call("/change_speed", ChangeSpeed, speed)
    except (rospy.ROSException, rospy.ServiceException):
        return None
    return True

# %% 08.7 wrong: waits for ever | hint: It waited for ever
def bring_turtle(name, x, y, speed, patience):
    try:
        rospy.wait_for_service("/spawn")
        given = node.call("/spawn", Spawn, x, y, 0, name).name
        rospy.wait_for_service("/toggle_forward")
        node.call("/toggle_forward", Empty)
        rospy.wait_for_service("/change_speed")
        node.call("/change_speed", ChangeSpeed, speed)
    except (rospy.ROSException, rospy.ServiceException):
        return None
    return given

# %% 08.7 wrong: goes on after a failure | hint: and the next was asked all the same
def bring_turtle(name, x, y, speed, patience):
    given, failed = None, False
    for service, kind, values in [
        ("/spawn", Spawn, (x, y, 0.0, name)),
        ("/toggle_forward", Empty, ()),
        ("/change_speed", ChangeSpeed, (speed,)),
    ]:
        try:
            rospy.wait_for_service(service, patience)
            response = node.call(service, kind, *values)
            given = response.name if kind is Spawn else given
        except (rospy.ROSException, rospy.ServiceException):
            failed = True
    return None if failed else given

# %% 08.7 wrong: ten always | hint: Send `speed` as it came
def bring_turtle(name, x, y, speed, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        given = node.call("/spawn", Spawn, x, y, 0, name).name
        rospy.wait_for_service("/toggle_forward", timeout=patience)
        node.call("/toggle_forward", Empty)
        node.call("/change_speed", ChangeSpeed, 10.0)
    except (rospy.ROSException, rospy.ServiceException):
        return None
    return given

# %% 08.7 right: waits for all first
def bring_turtle(name, x, y, speed, patience):
    try:
        for service in ("/spawn", "/toggle_forward", "/change_speed"):
            rospy.wait_for_service(service, timeout=patience)
        given = rospy.ServiceProxy("/spawn", Spawn)(x, y, 0.0, name).name
        rospy.ServiceProxy("/toggle_forward", Empty)()
        rospy.ServiceProxy("/change_speed", ChangeSpeed)(speed)
        return given
    except (rospy.ROSException, rospy.ServiceException):
        return None

# %% 08.7 wrong: never waits | hint: Wait for each of the three before you ask it
def bring_turtle(name, x, y, speed, patience):
    try:
        given = node.call("/spawn", Spawn, x, y, 0, name).name
        node.call("/toggle_forward", Empty)
        node.call("/change_speed", ChangeSpeed, speed)
    except (rospy.ROSException, rospy.ServiceException):
        return None
    return given

# %% 08.7 wrong: waits for the simulator only | hint: Wait for each of the three before you ask it
def bring_turtle(name, x, y, speed, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        given = node.call("/spawn", Spawn, x, y, 0, name).name
        node.call("/toggle_forward", Empty)
        node.call("/change_speed", ChangeSpeed, speed)
    except (rospy.ROSException, rospy.ServiceException):
        return None
    return given

# %% 08.7 wrong: four seconds each | hint: Give each wait_for_service the limit
def bring_turtle(name, x, y, speed, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=4)
        given = node.call("/spawn", Spawn, x, y, 0, name).name
        rospy.wait_for_service("/toggle_forward", timeout=4)
        node.call("/toggle_forward", Empty)
        rospy.wait_for_service("/change_speed", timeout=4)
        node.call("/change_speed", ChangeSpeed, speed)
    except (rospy.ROSException, rospy.ServiceException):
        return None
    return given

# %% 08.7 wrong: only the simulator may refuse | hint: Each of the three may refuse
def bring_turtle(name, x, y, speed, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        given = node.call("/spawn", Spawn, x, y, 0, name).name
    except (rospy.ROSException, rospy.ServiceException):
        return None
    for service, kind, values in (("/toggle_forward", Empty, ()), ("/change_speed", ChangeSpeed, (speed,))):
        try:
            rospy.wait_for_service(service, timeout=patience)
        except rospy.ROSException:
            return None
        node.call(service, kind, *values)
    return given

# %% 08.7 wrong: looks elsewhere | hint: a theta of 0
def bring_turtle(name, x, y, speed, patience):
    try:
        rospy.wait_for_service("/spawn", timeout=patience)
        given = node.call("/spawn", Spawn, x, y, 1.57, name).name
        rospy.wait_for_service("/toggle_forward", timeout=patience)
        node.call("/toggle_forward", Empty)
        rospy.wait_for_service("/change_speed", timeout=patience)
        node.call("/change_speed", ChangeSpeed, speed)
    except (rospy.ROSException, rospy.ServiceException):
        return None
    return given

# %% 08.8 right: an argument and a condition
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" default="false" />
  <node pkg="turtlesim" type="turtlesim_node" name="turtlesim" />
  <node pkg="course_pkg" type="improved_pubvel_toggle" name="improved_pubvel_toggle" />
  <node if="$(arg addturtle)" pkg="course_pkg" type="spawn_turtle_plus" name="spawn_turtle_plus" />
</launch>

# %% 08.8 right: a group
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" default="0"/>
  <node name="turtlesim" pkg="turtlesim" type="turtlesim_node" output="screen"/>
  <node name="improved_pubvel_toggle" pkg="course_pkg" type="improved_pubvel_toggle" respawn="true"/>
  <group if="$(arg addturtle)">
    <node name="spawn_turtle_plus" pkg="course_pkg" type="spawn_turtle_plus"/>
  </group>
</launch>

# %% 08.8 wrong: always two | hint: It is there although nobody asked for it
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" default="false" />
  <node pkg="turtlesim" type="turtlesim_node" name="turtlesim" />
  <node pkg="course_pkg" type="improved_pubvel_toggle" name="improved_pubvel_toggle" />
  <node pkg="course_pkg" type="spawn_turtle_plus" name="spawn_turtle_plus" />
</launch>

# %% 08.8 wrong: two unless told otherwise | hint: Without an argument there is one turtle
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" default="true" />
  <node pkg="turtlesim" type="turtlesim_node" name="turtlesim" />
  <node pkg="course_pkg" type="improved_pubvel_toggle" name="improved_pubvel_toggle" />
  <node if="$(arg addturtle)" pkg="course_pkg" type="spawn_turtle_plus" name="spawn_turtle_plus" />
</launch>

# %% 08.8 wrong: no default | hint: Without an argument it has to start
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" />
  <node pkg="turtlesim" type="turtlesim_node" name="turtlesim" />
  <node pkg="course_pkg" type="improved_pubvel_toggle" name="improved_pubvel_toggle" />
  <node if="$(arg addturtle)" pkg="course_pkg" type="spawn_turtle_plus" name="spawn_turtle_plus" />
</launch>

# %% 08.8 wrong: the node's name for the program's | hint: A program's name is wrong
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" default="false" />
  <node pkg="turtlesim" type="turtlesim" name="turtlesim" />
  <node pkg="course_pkg" type="improved_pubvel_toggle" name="improved_pubvel_toggle" />
  <node if="$(arg addturtle)" pkg="course_pkg" type="spawn_turtle_plus" name="spawn_turtle_plus" />
</launch>

# %% 08.8 wrong: a tag that is not closed | hint: each <tag> is closed
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" default="false">
  <node pkg="turtlesim" type="turtlesim_node" name="turtlesim" />
</launch>

# %% 08.8 wrong: no driver | hint: A node is missing
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" default="false" />
  <node pkg="turtlesim" type="turtlesim_node" name="turtlesim" />
  <node if="$(arg addturtle)" pkg="course_pkg" type="spawn_turtle_plus" name="spawn_turtle_plus" />
</launch>

# %% 08.8 right: eval, unless and comments
%%writefile my_exercise3.launch
<?xml version="1.0"?>
<launch>
  <!-- true makes MyTurtle -->
  <arg name="addturtle" default="False" doc="whether there are two"/>
  <node name="turtlesim" pkg="turtlesim" type="turtlesim_node" required="true"></node>
  <node name="improved_pubvel_toggle" pkg="course_pkg" type="improved_pubvel_toggle"></node>
  <node name="spawn_turtle_plus" pkg="course_pkg" type="spawn_turtle_plus" unless="$(eval not addturtle)"/>
</launch>

# %% 08.8 wrong: the older driver under the new name | hint: as improved_pubvel_toggle does
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" default="false" />
  <node pkg="turtlesim" type="turtlesim_node" name="turtlesim" />
  <node pkg="course_pkg" type="pubvel_toggle" name="improved_pubvel_toggle" />
  <node if="$(arg addturtle)" pkg="course_pkg" type="spawn_turtle_plus" name="spawn_turtle_plus" />
</launch>

# %% 08.8 wrong: the other program under the name | hint: and nobody drives it
%%writefile my_exercise3.launch
<launch>
  <arg name="addturtle" default="false" />
  <node pkg="turtlesim" type="turtlesim_node" name="turtlesim" />
  <node pkg="course_pkg" type="improved_pubvel_toggle" name="improved_pubvel_toggle" />
  <node if="$(arg addturtle)" pkg="course_pkg" type="spawn_turtle" name="spawn_turtle_plus" />
</launch>
