"""Example answers of chapter 09; tests/checking/answers/example_answers.py explains the format."""

# %% 09.1 right: uses the solution from the chapter
solution()
# %% 09.1 right: waits with the proxy, and uses separate steps
replace("#!/usr/bin/env python3\nimport sys\n", '#!/usr/bin/python3\n"""Spawns MyTurtle."""')
replace(".srv import Spawn", " import srv as turtle")
replace("main():", 'run():\n    rospy.init_node("spawn_turtle", anonymous=True)\n    spawn = rospy.ServiceProxy("/spawn", turtle.Spawn)')
replace("rospy.wait_for_service … return 0", """spawn.wait_for_service(timeout=5.0)
    except rospy.ROSException:
        rospy.logerr("no simulator")
        raise SystemExit(1)
    request = turtle.SpawnRequest(x=3.0, y=3.0, name="MyTurtle")
    try:
        name = spawn.call(request).name
    except rospy.ServiceException as error:
        rospy.logerr("refused: %s", error)
        raise SystemExit(1)
    rospy.loginfo("Spawned %s", name)""")
replace('rospy.init_node("spawn_turtle")\n    sys.exit(main())', "run()")
# %% 09.1 wrong: does not wait for the service | hint: The program ended before the service started
replace('    try:\n        rospy.wait_for_service("spawn", timeout=5)\n', '    try:\n')
# %% 09.1 wrong: waits without a limit | hint: The program waits too long
replace(', timeout=5', '')
# %% 09.1 wrong: waits for only two seconds | hint: The program stopped waiting too early
replace('timeout=5', 'timeout=2')
# %% 09.1 wrong: catches only the timeout of the wait | hint: The program does not handle the exception of a refused call
replace('(rospy.ROSException, rospy.ServiceException)', 'rospy.ROSException')
# %% 09.1 wrong: catches only the error of the call | hint: The service did not start in time
replace('(rospy.ROSException, rospy.ServiceException)', 'rospy.ServiceException')
# %% 09.1 wrong: handles only one error message | hint: The program does not handle the exception of a refused call
replace("rospy.ServiceException) as error:\n", "rospy.ServiceException) as error:\n        if isinstance(error, rospy.ServiceException) and \"already\" not in str(error):\n            raise\n")
# %% 09.1 wrong: exits with status 0 after a refused call | hint: The server refused the call. In this case, print
replace("        return 1\n", "        return int(not isinstance(error, rospy.ServiceException))\n")
# %% 09.1 wrong: prints no message after a failure | hint: The program printed no message about the failure
replace('        print("no turtle:", error, file=sys.stderr)\n', "")
# %% 09.1 wrong: starts the node during an import, with init_node of rospy.client | hint: Move rospy.init_node and all lines after it
replace("import rospy\n", "import rospy\nfrom rospy.client import init_node\n")
replace("\n\n\ndef main():", '\n\ninit_node("spawn_turtle")\n\n\ndef main():')
replace('    rospy.init_node("spawn_turtle")\n    sys', "    sys")
# %% 09.1 wrong: does not pass the exit status to sys.exit | hint: The service did not start in time
replace('sys.exit(main())', 'main()')
# %% 09.1 wrong: prints the requested name | hint: The simulator chooses the name
replace('"spawned", response.name', '"spawned", "MyTurtle"')
# %% 09.1 wrong: spins after the call | hint: The program does not end after the call
replace('response.name)\n', 'response.name)\n    rospy.spin()\n')
# %% 09.1 wrong: exits with status 1 after a success | hint: The turtle was spawned, so the exit status has to be 0
replace('response.name)\n    return 0', 'response.name)\n    return 1')
# %% 09.1 wrong: calls the service twice | hint: The program called /spawn more than once, and each call creates a turtle
replace('(3, 3, 0, "MyTurtle")\n', '(3, 3, 0, "MyTurtle")\n        rospy.ServiceProxy("spawn", Spawn)(3, 3, 0, "")\n')
# %% 09.1 wrong: repeats a refused call | hint: The server refused the call, and the program called the service again
replace("rospy.ServiceException) as error:\n", """rospy.ServiceException) as error:
        try:
            rospy.ServiceProxy("spawn", Spawn)(3, 3, 0, "MyTurtle")
        except rospy.ServiceException:
            pass
""")
# %% 09.1 wrong: waits for another service | hint: The program waits, but sends no request
replace('wait_for_service("spawn", timeout=5)', 'wait_for_service("/turtle1/spawn")')
# %% 09.1 wrong: does not call the service | hint: The program ended without a request
replace('        response = rospy.ServiceProxy("spawn", Spawn)(3, 3, 0, "MyTurtle")\n', '')
replace('response.name', '"MyTurtle"')
# %% 09.1 wrong: sends an empty name | hint: The name is empty, so the simulator chooses a name
replace('"MyTurtle")', '"")')
# %% 09.1 wrong: sends another name | hint: The name of the turtle is wrong
replace('"MyTurtle")', '"myturtle")')
# %% 09.1 wrong: sends the angle first | hint: The numbers in the request are wrong
replace('(3, 3, 0, "MyTurtle")', '(0, 3, 3, "MyTurtle")')
# %% 09.1 wrong: runs the node outside of the main block | hint: Move rospy.init_node and all lines after it
replace('if __name__ == "__main__":\n    rospy.init_node("spawn_turtle")\n    sys.exit(main())', 'rospy.init_node("spawn_turtle")\nsys.exit(main())')
# %% 09.1 wrong: also runs the main block during an import | hint: Move rospy.init_node and all lines after it
replace('if __name__ == "__main__":', 'if __name__ in ("__main__", "spawn_turtle"):')
# %% 09.1 wrong: uses an undefined variable | hint: The program stopped with an error
replace('3, 3, 0, "MyTurtle")\n', 'x, 3, 0, "MyTurtle")\n')
# %% 09.1 wrong: prepares the node as the course's programs do | hint: Your program starts or imports a program of the course
replace('rospy.init_node("spawn_turtle")', 'rospy.init_node("spawn_turtle")\n    from course_pkg.ros import prepare_node\n    prepare_node()')

# %% 09.2 right: uses the solution from the chapter
solution()
# %% 09.2 right: uses a class and a timer
replace("python3", 'python3\n"""Drives turtle1 straight ahead or in a circle."""')
replace("from geometry_msgs … forward = True", "import std_srvs.srv\nfrom geometry_msgs.msg import Twist, Vector3")
replace("def handle_toggle(request):\n    global forward\n    forward = not forward\n    return EmptyResponse()", """class Toggle:
    def __init__(self):
        self.turning = False
        self.publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=1)
        self.service = rospy.Service("/toggle_forward", std_srvs.srv.Empty, self.change)
        self.timer = rospy.Timer(rospy.Duration(0.5), self.publish)

    def change(self, _):
        self.turning = not self.turning
        return {}

    def publish(self, _):
        if self.turning:
            self.publisher.publish(Twist(angular=Vector3(z=1.0)))
        else:
            self.publisher.publish(Twist(linear=Vector3(x=1.0)))


def main():
    rospy.init_node("toggler")
    toggle = Toggle()
    rospy.spin()""")
replace('rospy.init_node("pubvel_toggle … rate.sleep()', "main()")
# %% 09.2 wrong: turns before the first call | hint: Before the first call, the turtle has to go straight ahead
replace('\nforward = True', '\nforward = False')
# %% 09.2 wrong: publishes a velocity of 0 in the handler | hint: A message contained a wrong velocity
replace("    return EmptyResponse()", "    publisher.publish(Twist())\n    return EmptyResponse()")
# %% 09.2 wrong: also publishes in the handler | hint: Each call of the service published one more message
replace("    return EmptyResponse()", """    message = Twist()
    message.linear.x, message.angular.z = float(forward), float(not forward)
    publisher.publish(message)
    return EmptyResponse()""")
# %% 09.2 wrong: moves twice as fast | hint: To drive straight ahead, set linear.x = 1.0
replace('linear.x = 1.0', 'linear.x = 2.0')
# %% 09.2 wrong: forgets the global statement | hint: After the call, the turtle still goes straight ahead
replace('    global forward\n    forward = not forward', '    forward = False')
# %% 09.2 wrong: uses the same message object in each iteration | hint: The turtle turns, but it also moves ahead
replace('    while not rospy.is_shutdown():\n        message = Twist()\n', '    message = Twist()\n    while not rospy.is_shutdown():\n')
# %% 09.2 wrong: turns to the right | hint: The velocity is wrong while the turtle turns
replace('angular.z = 1.0', 'angular.z = -1.0')
# %% 09.2 wrong: turns after each call | hint: The second call changed nothing
replace('forward = not forward', 'forward = False')
# %% 09.2 wrong: stops after the second call | hint: After the second call, the turtle has to go straight ahead again
replace('    forward = not forward', '    calls.append(1)\n    forward = len(calls) == 0')
replace('\nforward = True', '\ncalls = []\nforward = True')
replace('            message.angular.z = 1.0', '            message.angular.z = float(len(calls) == 1)')
# %% 09.2 wrong: toggles a local variable of the handler | hint: needs a `global` line
replace('    global forward\n    forward = not forward', '    forward = bool(request is None)')
# %% 09.2 wrong: reads the directions of the first three calls from a list | hint: but a later call did not change it
replace('    global forward\n    forward = not forward', '    global forward\n    forward = directions.pop(0) if directions else True')
replace('\nforward = True', '\ndirections = [False, True, False]\nforward = True')
# %% 09.2 wrong: publishes ten times per second | hint: The program does not publish twice per second
replace('Rate(2)', 'Rate(10)')
# %% 09.2 wrong: publishes every two seconds | hint: The program does not publish twice per second
replace('rate.sleep()', 'rospy.sleep(2)')
# %% 09.2 wrong: publishes only three times | hint: The program reached its last line and ended
replace('while not rospy.is_shutdown():', 'for _ in range(3):')
# %% 09.2 wrong: publishes nothing | hint: No velocity arrived for 4 s
replace('        publisher.publish(message)\n', '        if not forward and rospy.get_time() < 0:\n            publisher.publish(message)\n')
# %% 09.2 wrong: creates the service after the loop | hint: Create the service before the loop begins
replace('    rospy.Service("toggle_forward", Empty, handle_toggle)\n', '')
replace('        rate.sleep()\n', '        rate.sleep()\n    rospy.Service("toggle_forward", Empty, handle_toggle)\n')
# %% 09.2 wrong: uses another service name | hint: The node offers
replace('"toggle_forward"', '"toggle"')
# %% 09.2 wrong: uses another topic | hint: The node does not publish on /turtle1/cmd_vel
replace('"turtle1/cmd_vel"', '"turtle1/cmd_velocity"')
# %% 09.2 wrong: also moves to the side | hint: A field of the velocity is not 0, but it has to be 0
replace('        if forward:\n', '        message.linear.y = 0.5\n        if forward:\n')
# %% 09.2 wrong: publishes each velocity one round late | hint: The first message after the call still contained the old velocity
replace("        publisher.publish(message)\n        rate.sleep()", "        rate.sleep()\n        publisher.publish(message)")
# %% 09.2 wrong: does not end after Ctrl-C | hint: Ctrl-C does not stop the program
replace("import rospy\n", "import time\n\nimport rospy\n")
replace("while not rospy.is_shutdown():", "while True:")
replace("        publisher.publish(message)\n        rate.sleep()", "        try:\n            publisher.publish(message)\n        except rospy.ROSException:\n            pass\n        time.sleep(0.5)")
# %% 09.2 wrong: confuses the rate with the period | hint: The program does not publish twice per second
replace("Rate(2)", "Rate(0.5)")
# %% 09.2 wrong: changes the direction in the loop, at most once per message | hint: The second call changed nothing
replace('    global forward\n    forward = not forward', '    global called\n    called = True')
replace('\nforward = True', '\nforward = True\ncalled = False')
replace('        message = Twist()\n', '        forward, called = forward != called, False\n        message = Twist()\n')

# %% 09.3 right: uses the solution from the chapter
solution()
# %% 09.3 right: sleeps for 1 / rate
replace(", ChangeRateResponse", "")
replace(", EmptyResponse", "")
replace("EmptyResponse()", "[]")
replace("if not 0 < request.rate <= 100:", "allowed = request.rate > 0 and request.rate <= 100\n    if not allowed:")
replace("before = frequency … before=before)", "old, frequency = frequency, request.rate\n    return old")
replace("toggle_forward", "/toggle_forward")
replace("\n    used, rate = frequency, rospy.Rate(frequency)", "")
replace("if used != … rate.sleep()", "rospy.sleep(1.0 / frequency)")
# %% 09.3 wrong: resets the direction when the rate changes | hint: A call of /change_rate also changed the direction
replace("    global frequency\n", "    global frequency, forward\n    forward = True\n")
# %% 09.3 wrong: does not change the Rate object of the loop | hint: The rate of a Rate
replace('used != frequency', 'used < 0')
# %% 09.3 wrong: rounds the rate to a value in a table | hint: The program did not publish at the rate that the client had set
based_on("sleeps for 1 / rate")
replace("rospy.sleep(1.0 / frequency)", "rates = (0.5, 1, 2, 2.5, 4, 5, 10, 20, 50, 100)\n        rospy.sleep(1 / min(rates, key=lambda each: abs(each - frequency)))")
# %% 09.3 wrong: rounds the period to a multiple of 0.01 s | hint: The program did not publish at the rate that the client had set
replace("used, rate = frequency, rospy.Rate(frequency)\n    while", "rounds, rate = 0, rospy.Rate(100)\n    while")
replace("        message = Twist()", """        rate.sleep()
        rounds += 1
        if rounds < int(100 / frequency):
            continue
        rounds = 0
        message = Twist()""")
replace("        if used … rate.sleep()", "        pass")
# %% 09.3 wrong: returns the new rate | hint: The field `before` contains the new rate
replace('before=before', 'before=frequency')
# %% 09.3 wrong: returns an empty response | hint: The field `before` has its default value, 0.0
replace('(before=before)', '()')
# %% 09.3 wrong: returns the old rate as an int | hint: Store the rate as a float in Python, or as a double in C++
replace('before=before', 'before=int(before)')
# %% 09.3 wrong: returns the old pause instead of the old rate | hint: The field `before` contains the pause between two messages
replace('before=before', 'before=1 / before')
# %% 09.3 wrong: accepts every rate | hint: is not allowed, but the client got a response
replace('    if not 0 < request.rate <= 100:\n        raise rospy.ServiceException(f"{request.rate} is not above 0 and at most 100")\n', '    if request.rate == 0:\n        raise rospy.ServiceException("0")\n')
# %% 09.3 wrong: accepts the rate nan | hint: The value nan is not allowed
replace('if not 0 < request.rate <= 100', 'if request.rate <= 0 or request.rate > 100')
# %% 09.3 wrong: refuses the rate 100 | hint: The node refused an allowed rate
replace('<= 100', '< 100')
# %% 09.3 wrong: stores the rate before it checks it | hint: The handler stored the rate before it refused the call
replace('    if not 0 < request.rate <= 100:\n', '    before, frequency = frequency, request.rate\n    if not 0 < request.rate <= 100:\n')
replace('    before = frequency\n    frequency = request.rate\n', '')
replace('    used, rate = frequency, rospy.Rate(frequency)\n    while', '    used, rate = frequency, rospy.Rate(frequency)\n    while')
replace('if used != frequency:', 'if used != frequency and 0 < frequency <= 100:')
# %% 09.3 wrong: a refused rate changes the pause of the loop | hint: After a refused call, the program publishes at another rate
based_on("sleeps for 1 / rate")
replace("\nfrequency = 2.0", "\nfrequency = 2.0\npause = 0.5")
replace("    global frequency\n", "    global frequency, pause\n    if request.rate > 0:\n        pause = 1 / request.rate\n")
replace("rospy.sleep(1.0 / frequency)", "rospy.sleep(pause)")
# %% 09.3 wrong: publishes at most 50 messages per second | hint: The program did not publish at the rate that the client had set
based_on("sleeps for 1 / rate")
replace("rospy.sleep(1.0 / frequency)", "rospy.sleep(max(1.0 / frequency, 0.02))")
# %% 09.3 wrong: returns the rate that the loop uses | hint: The field `before` contains an older rate
replace("before=before", "before=used")
# %% 09.3 wrong: begins with one message per second | hint: The field `before` has a wrong value
replace("\nfrequency = 2.0", "\nfrequency = 1.0")
# %% 09.3 wrong: refuses rates below 1 | hint: The node refused an allowed rate
replace("if not 0 < request.rate <= 100", "if not 1 <= request.rate <= 100")
# %% 09.3 wrong: resets the rate in each toggle | hint: A call of /toggle_forward also changed the rate
replace("global forward\n", "global forward, frequency\n    frequency = 2.0\n")
# %% 09.3 wrong: raises a ValueError | hint: The handler raised an error of the wrong type
replace('rospy.ServiceException(', 'ValueError(')
# %% 09.3 wrong: does not offer /toggle_forward | hint: Create the service before the loop begins
replace('    rospy.Service("toggle_forward", Empty, handle_toggle)\n', '')

# %% 09.4 right: uses a class
solution()

# %% 09.4 right: uses a dictionary and functions
"""%%writefile src/my_turtles/scripts/improved_pubvel_toggle.py
#!/usr/bin/env python3
import rospy
from course_pkg.srv import ChangeRate, ChangeSpeed
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty, SetBool

state = {"forward": True, "moving": True, "rate": 2.0, "speed": 1.0}


def toggle(_):
    state["forward"] = not state["forward"]
    return {}


def change_rate(request):
    if request.rate > 0 and request.rate <= 100:
        before = state["rate"]
        state["rate"] = request.rate
        return before
    raise rospy.ServiceException("a rate is above 0 and at most 100")


def change_speed(request):
    if request.speed - request.speed != 0:
        raise rospy.ServiceException("not finite")
    before = state["speed"]
    state["speed"] = request.speed
    return {"before": before}


def start_stop(request):
    same = state["moving"] is request.data
    state["moving"] = request.data
    return True, "It was so already." if same else "Changed."


def main():
    rospy.init_node("improved_pubvel_toggle")
    publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=1)
    services = [
        rospy.Service("/toggle_forward", Empty, toggle),
        rospy.Service("/change_rate", ChangeRate, change_rate),
        rospy.Service("/change_speed", ChangeSpeed, change_speed),
        rospy.Service("/start_stop", SetBool, start_stop),
    ]
    rate, used = None, None
    while not rospy.is_shutdown():
        twist = Twist()
        if state["moving"]:
            if state["forward"]:
                twist.linear.x = state["speed"]
            else:
                twist.angular.z = 1.0
        publisher.publish(twist)
        if used != state["rate"]:
            used = state["rate"]
            rate = rospy.Rate(used)
        rate.sleep()


if __name__ == "__main__":
    main()
"""

# %% 09.4 wrong: shuts its services down after two calls of /toggle_forward | hint: This service was available at first, but it is not
based_on("uses a dictionary and functions")
replace('import rospy\nfrom course_pkg', 'import threading\n\nimport rospy\nfrom course_pkg')
replace('    rate, used = None, None\n', '    state["services"] = services\n    rate, used = None, None\n')
replace('    state["forward"] = not state["forward"]\n    return {}', """    state["forward"] = not state["forward"]
    state["calls"] = state.get("calls", 0) + 1
    if state["calls"] == 2:
        threading.Timer(0.2, lambda: [each.shutdown() for each in state["services"]]).start()
    return {}""")
# %% 09.4 wrong: does not move at the start | hint: The turtle does not move before the first call
replace('self.moving = True', 'self.moving = False')
# %% 09.4 wrong: publishes almost never while it is stopped | hint: No velocity arrived for 4 s
replace('        self.moving = request.data\n', '        self.moving = request.data\n        if not self.moving:\n            self.frequency = 0.001\n')
# %% 09.4 wrong: publishes nothing while it is stopped | hint: No velocity arrived for 4 s
replace('        publisher.publish(driver.velocity())\n', '        if driver.moving:\n            publisher.publish(driver.velocity())\n')
# %% 09.4 wrong: begins with the speed 2.0 | hint: Before the first call, the turtle has to move straight ahead at 1.0 m/s
replace('self.speed = 1.0', 'self.speed = 2.0')
# %% 09.4 wrong: uses a fixed publishing rate | hint: Copy the code of /change_rate from your program pubvel_toggle_plus
replace('1 / driver.frequency', '0.5')
# %% 09.4 wrong: ignores /toggle_forward while it is stopped | hint: The client called /toggle_forward while the turtle was stopped
replace("        self.forward = not self.forward\n", "        self.forward = self.forward != self.moving\n")
# %% 09.4 wrong: begins with 10 messages per second | hint: The field `before` has a wrong value
replace("self.frequency = 2.0", "self.frequency = 10.0")
# %% 09.4 wrong: accepts rates above 100 | hint: The value 100.5 is not allowed
replace("if not 0 < request.rate <= 100:", "if not request.rate > 0:")
# %% 09.4 wrong: stops the turtle after a refused speed | hint: A refused call of /change_speed changed the velocity
replace("self.speed = 1.0", "self.speed = self.used = 1.0")
replace("        if not math.isfinite(request.speed):\n", "        self.used = request.speed if math.isfinite(request.speed) else 0.0\n        if not math.isfinite(request.speed):\n")
replace("linear.x = self.speed", "linear.x = self.used")
# %% 09.4 wrong: accepts the rate nan | hint: The value nan is not allowed
replace("if not 0 < request.rate <= 100:", "if request.rate <= 0 or request.rate > 100:")
# %% 09.4 wrong: uses a fixed speed | hint: After the call, the turtle still moves at 1.0 m/s
replace('linear.x = self.speed', 'linear.x = 1.0')
# %% 09.4 wrong: ignores the sign of the speed | hint: With a negative speed, the turtle has to move backwards
replace('linear.x = self.speed', 'linear.x = abs(self.speed)')
# %% 09.4 wrong: converts the speed to an int | hint: Store the speed as a float in Python, or as a double in C++
replace('linear.x = self.speed', 'linear.x = int(self.speed)')
# %% 09.4 wrong: turns to the right if the speed is negative | hint: The velocity is wrong while the turtle turns
replace("angular.z = 1.0", "angular.z = math.copysign(1.0, self.speed)")
# %% 09.4 wrong: returns the new speed | hint: The field `before` contains the new speed
replace('before, self.speed = self.speed, request.speed', 'before = self.speed = request.speed')
# %% 09.4 wrong: returns a response without the old speed | hint: The field `before` is wrong
replace('ChangeSpeedResponse(before=before)', 'ChangeSpeedResponse()')
# %% 09.4 wrong: refuses negative speeds | hint: The node refused an allowed speed
replace('if not math.isfinite(request.speed)', 'if not 0 <= request.speed < 1000')
# %% 09.4 wrong: refuses the speed 0 | hint: The node refused an allowed speed
replace("if not math.isfinite(request.speed)", "if not request.speed or not math.isfinite(request.speed)")
# %% 09.4 wrong: accepts the speed inf | hint: Accept only finite numbers
replace('not math.isfinite(request.speed)', 'request.speed != request.speed or request.speed == -math.inf')
# %% 09.4 wrong: does not stop | hint: The turtle still moves after a call with data=False
replace('self.moving = request.data\n', 'self.stopped = not request.data\n')
replace('if request.data == self.moving:', 'if request.data != getattr(self, "stopped", False):')
# %% 09.4 wrong: resets the direction at each start and stop | hint: When you stop or start the turtle, do not change
replace('        self.moving = request.data\n', '        self.moving = request.data\n        self.forward = True\n')
# %% 09.4 wrong: ignores a speed that is set while it is stopped | hint: The client called /change_speed while the turtle was stopped
replace('before, self.speed = self.speed, request.speed', 'before, self.speed = self.speed, request.speed if self.moving else self.speed')
# %% 09.4 wrong: starts the turtle when it is toggled | hint: A call of /toggle_forward started the turtle again
replace('self.forward = not self.forward\n', 'self.forward = not self.forward\n        self.moving = True\n')
# %% 09.4 wrong: limits the speed to 10 m/s | hint: The turtle does not move at the speed that /change_speed has set
replace('before, self.speed = self.speed, request.speed', 'before, self.speed = self.speed, min(max(request.speed, -10), 10)')
# %% 09.4 wrong: returns the field data as success | hint: The field `success` is False
replace('success=True, message=word', 'success=request.data, message=word')
# %% 09.4 wrong: returns no message | hint: The message is empty
replace('success=True, message=word)', 'success=True)')
# %% 09.4 wrong: always writes "already" | hint: This call changed the state
replace('message=word)', 'message=f"now already {word}")')
# %% 09.4 wrong: never writes "already" | hint: This call changed nothing
replace('message=f"already {word}"', 'message=word')
# %% 09.4 wrong: compares with the state of the last published message | hint: This call changed nothing
replace("self.moving = True", "self.moving = self.wanted = True")
replace("self.moving = request.data", "self.wanted = request.data")
replace("        publisher.publish(", "        driver.moving = driver.wanted\n        publisher.publish(")
# %% 09.4 wrong: refuses a call that changes nothing | hint: The node refused a call
replace('return SetBoolResponse(success=True, message=f"already {word}")', 'raise rospy.ServiceException("already")')

# %% 09.5 right: uses the solution from the chapter
solution()
# %% 09.5 right: uses a class, and waits for each service before its call
replace("import sys … ChangeSpeed", "import rospy\nfrom course_pkg.srv import ChangeSpeed, ChangeSpeedRequest")
replace("import Spawn", "import Spawn, SpawnRequest")
replace("def call(name … )(*values)", """class Follower:
    def __init__(self, name):
        self.publisher = rospy.Publisher("/" + name + "/cmd_vel", Twist, queue_size=10)
        self.subscriber = rospy.Subscriber("/turtle1/cmd_vel", Twist, self.follow)

    def follow(self, message):
        self.publisher.publish(message)""")
replace("try: … return 0", """rospy.init_node("spawn_turtle_plus")
    spawn = rospy.ServiceProxy("/spawn", Spawn)
    toggle = rospy.ServiceProxy("/toggle_forward", Empty)
    change = rospy.ServiceProxy("/change_speed", ChangeSpeed)
    try:
        spawn.wait_for_service(5)
        response = spawn(SpawnRequest(3.0, 3.0, 0.0, "MyTurtle"))
        toggle.wait_for_service(5)
        toggle()
        change.wait_for_service(5)
        change(ChangeSpeedRequest(speed=2))
    except Exception as error:
        rospy.logfatal("%s", error)
        raise SystemExit(1)
    follower = Follower(response.name)
    rospy.spin()""")
replace('rospy.init_node("spawn_turtle_plus")\n    sys.exit(main())', "main()")
# %% 09.5 wrong: sets the speed before it toggles | hint: The program calls the three services in the wrong order
replace('        call("toggle_forward", Empty)\n        call("change_speed", ChangeSpeed, 2.0)\n', '        call("change_speed", ChangeSpeed, 2.0)\n        call("toggle_forward", Empty)\n')
# %% 09.5 wrong: waits only for the first service | hint: The program ended too early, because /toggle_forward starts
replace('    rospy.wait_for_service(name, timeout=5)\n', '    if name == "spawn":\n        rospy.wait_for_service(name, timeout=5)\n')
# %% 09.5 wrong: waits for all services before the first call | hint: The service /toggle_forward starts only
replace("    try:\n", "    try:\n        for service in (\"spawn\", \"toggle_forward\", \"change_speed\"):\n            rospy.wait_for_service(service, timeout=5)\n")
# %% 09.5 wrong: waits for at most 1 s | hint: The program ended too early, because /toggle_forward starts
replace("timeout=5", "timeout=1")
# %% 09.5 wrong: calls a service with another name | hint: The program waits, but does not call the next service
replace('call("toggle_forward", Empty)', 'call("toggle", Empty)')
# %% 09.5 wrong: spawns the turtle with another angle | hint: The request is wrong
replace('3, 3, 0, "MyTurtle"', '3, 3, 3, "MyTurtle"')
# %% 09.5 wrong: sends another speed | hint: Send 2.0 in the field `speed`
replace('ChangeSpeed, 2.0', 'ChangeSpeed, 10.0')
# %% 09.5 wrong: omits spin | hint: The node ended after the calls
replace('    rospy.spin()\n', '')
# %% 09.5 wrong: uses a fixed name for the topic | hint: Publish only on the topic /NAME/cmd_vel
replace('f"{name}/cmd_vel"', '"MyTurtle/cmd_vel"')
# %% 09.5 wrong: follows another turtle | hint: The program receives no velocities
replace('Subscriber("turtle1/cmd_vel"', 'Subscriber("turtle2/cmd_vel"')
# %% 09.5 wrong: uses a callback that does nothing | hint: The callback publishes nothing
replace('Twist, publisher.publish)', 'Twist, lambda message: None)')
# %% 09.5 wrong: publishes each velocity twice | hint: Some velocities were published more than once
replace('Twist, publisher.publish)', 'Twist, lambda message: [publisher.publish(message) for _ in range(2)])')
# %% 09.5 wrong: does not publish velocities without linear.x | hint: Some velocities are missing
replace("Twist, publisher.publish)", "Twist, lambda message: publisher.publish(message) if message.linear.x else None)")
# %% 09.5 wrong: does not publish equal velocities again | hint: A velocity that is equal to the previous velocity is missing
replace("    publisher = rospy", """    last = [None]

    def follow(message):
        if message != last[0]:
            publisher.publish(message)
        last[0] = message

    publisher = rospy""")
replace("Twist, publisher.publish)", "Twist, follow)")
# %% 09.5 wrong: pauses in the callback | hint: Some velocities are missing
replace('Twist, publisher.publish)', 'Twist, lambda message: (publisher.publish(message), rospy.sleep(0.3)), queue_size=1)')
# %% 09.5 wrong: publishes only the first forty velocities | hint: The program stopped after some velocities
replace("    publisher = rospy", "    left = [None] * 40\n    publisher = rospy")
replace("Twist, publisher.publish)", "Twist, lambda message: left and (left.pop(), publisher.publish(message)))")
# %% 09.5 wrong: publishes the previous velocity | hint: The program did not publish each received velocity once
replace('    publisher = rospy', '    newest = [Twist()]\n\n    def late(message):\n        publisher.publish(newest[0])\n        newest[0] = message\n\n    publisher = rospy')
replace('Twist, publisher.publish)', 'Twist, late)')
# %% 09.5 wrong: copies only two fields | hint: Some fields of the published message differ from the received message
replace('    publisher = rospy', '    def copy(message):\n        new = Twist()\n        new.linear.x, new.angular.z = message.linear.x, message.angular.z\n        publisher.publish(new)\n\n    publisher = rospy')
replace('Twist, publisher.publish)', 'Twist, copy)')
# %% 09.5 wrong: continues after a failed call | hint: After a failed call, the program still called the next service
replace('        call("toggle_forward", Empty)\n', '        try:\n            call("toggle_forward", Empty)\n        except (rospy.ROSException, rospy.ServiceException) as error:\n            print(error)\n')
# %% 09.5 wrong: continues after a refused /spawn | hint: After a failed call, the program still called the next service
replace('        name = call("spawn", Spawn, 3, 3, 0, "MyTurtle").name\n', """        try:
            name = call("spawn", Spawn, 3, 3, 0, "MyTurtle").name
        except rospy.ServiceException:
            name = "MyTurtle"
""")
# %% 09.5 wrong: waits without a limit | hint: A service is missing, but the program did not end
replace('(name, timeout=5)', '(name)')
# %% 09.5 wrong: exits with status 0 after a failure | hint: The program printed a message, but the exit status is wrong
replace('        return 1\n', '        return 0\n')
# %% 09.5 wrong: catches only the timeout of the wait | hint: The program does not handle this exception
replace("(rospy.ROSException, rospy.ServiceException)", "rospy.ROSException")
# %% 09.5 wrong: prints no message after a failure | hint: The program printed no message about the failure
replace("        print(error, file=sys.stderr)\n", "")
# %% 09.5 wrong: continues after a refused /change_speed | hint: A service refused the call, but the program did not end
replace('        call("change_speed", ChangeSpeed, 2.0)\n', """        try:
            call("change_speed", ChangeSpeed, 2.0)
        except rospy.ServiceException as error:
            print(error)
""")
# %% 09.5 wrong: waits for /spawn without a limit | hint: A service is missing, but the program did not end
replace("(name, timeout=5)", '(name, timeout=None if name == "spawn" else 5)')
# %% 09.5 wrong: waits for at most 5 s in all three waits together | hint: Each of the three waits has its own limit
replace("import sys\n", "import sys\nimport time\n")
replace("    rospy.wait_for_service(name, timeout=5)\n", "    rospy.wait_for_service(name, timeout=max(0.1, end - time.monotonic()))\n")
replace('    rospy.init_node("spawn_turtle_plus")\n', '    rospy.init_node("spawn_turtle_plus")\n    end = time.monotonic() + 5\n')
# %% 09.5 wrong: copies only the three fields that the simulator uses | hint: Some fields of the published message differ from the received message
replace("    publisher = rospy", """    def follow(message):
        new = Twist()
        new.linear.x, new.linear.y, new.angular.z = message.linear.x, message.linear.y, message.angular.z
        publisher.publish(new)

    publisher = rospy""")
replace("Twist, publisher.publish)", "Twist, follow)")

# %% 09.6 right: uses the solution from the chapter
solution()

# %% 09.6 right: uses a group, and comments
"""%%writefile src/my_turtles/launch/exercise3.launch
<?xml version="1.0"?>
<launch>
  <!-- addturtle:=true adds a second turtle -->
  <arg name="addturtle" default="false"/>
  <group if="$(arg addturtle)">
    <node name="spawn_turtle_plus" pkg="my_turtles" type="spawn_turtle_plus.py" output="screen"/>
  </group>
  <node name="improved_pubvel_toggle" pkg="my_turtles" type="improved_pubvel_toggle.py" respawn="true"/>
  <node name="turtlesim" pkg="turtlesim" type="turtlesim_node"/>
</launch>
"""

# %% 09.6 wrong: uses the driver of the course | hint: A node starts a wrong program
replace('pkg="my_turtles" type="improved_pubvel_toggle.py"', 'pkg="course_pkg" type="improved_pubvel_toggle"')
# %% 09.6 wrong: exchanges the two programs | hint: A node starts a wrong program
replace('type="improved_pubvel_toggle.py"', 'type="OTHER"')
replace('type="spawn_turtle_plus.py"', 'type="improved_pubvel_toggle.py"')
replace('type="OTHER"', 'type="spawn_turtle_plus.py"')
# %% 09.6 wrong: does not close a tag | hint: The file is not valid XML
replace('</launch>', '<launch>')
# %% 09.6 wrong: omits the default value | hint: The argument addturtle has no default value
replace(' default="false"', '')
# %% 09.6 wrong: writes "no" instead of "false" | hint: The value of the attribute "if" has to be true or false
replace('default="false"', 'default="no"')
# %% 09.6 wrong: uses an argument that is not declared | hint: roslaunch cannot read the file
replace('$(arg addturtle)', '$(arg add)')
# %% 09.6 wrong: gives the driver another name | hint: A node is missing or has a wrong name
replace('name="improved_pubvel_toggle"', 'name="driver"')
# %% 09.6 wrong: starts the driver only with the second turtle | hint: A node did not start.
replace('type="improved_pubvel_toggle.py"', 'if="$(arg addturtle)" type="improved_pubvel_toggle.py"')
# %% 09.6 wrong: gives the argument a fixed value | hint: The <arg> tag gives the argument a fixed value
replace('default="false"', 'value="false"')
# %% 09.6 wrong: uses a condition that is never true | hint: With addturtle:=true, a node is missing
replace('if="$(arg addturtle)"', 'if="false"')
# %% 09.6 wrong: uses the default value true | hint: Without an argument, spawn_turtle_plus must
replace('default="false"', 'default="true"')
# %% 09.6 wrong: omits the condition | hint: spawn_turtle_plus also starts with addturtle:=false
replace('if="$(arg addturtle)" ', '')
# %% 09.6 wrong: omits .py in a program name | hint: roslaunch does not find a program
replace('type="improved_pubvel_toggle.py"', 'type="improved_pubvel_toggle"')
# %% 09.6 wrong: uses turtlesim as the program name | hint: roslaunch does not find a program
replace('type="turtlesim_node"', 'type="turtlesim"')
# %% 09.6 wrong: remaps the topic of the turtle | hint: The three programs start, but they use different names for the same topics or
replace('name="turtlesim" />', 'name="turtlesim">\n    <remap from="/turtle1/cmd_vel" to="/other/cmd_vel" />\n  </node>')
# %% 09.6 wrong: gives the second program another name | hint: The node of spawn_turtle_plus has another name
replace('name="spawn_turtle_plus"', 'name="spawn_turtle"')
# %% 09.6 wrong: starts the second program under another name without the argument | hint: The file starts an additional node
replace("</launch>", '  <node unless="$(arg addturtle)" pkg="my_turtles" type="spawn_turtle_plus.py" name="second" />\n</launch>')
