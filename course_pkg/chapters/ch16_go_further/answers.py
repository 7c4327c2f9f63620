"""Example answers of chapter 16; tests/checking/answers/example_answers.py explains the format."""

# %% 16.1 right: checks for a cancellation before each thing
class Fetcher:
    def __init__(self, name):
        self.server = actionlib.SimpleActionServer(name, FetchAction, execute_cb=self.fetch, auto_start=False)
        self.server.start()

    def fetch(self, goal):
        for fetched in range(goal.things):
            if self.server.is_preempt_requested():
                self.server.set_preempted(FetchResult(fetched=fetched))
                return
            time.sleep(goal.seconds)
            self.server.publish_feedback(FetchFeedback(fetched=fetched + 1))
        self.server.set_succeeded(FetchResult(fetched=goal.things))

# %% 16.1 wrong: counts one thing too many | hint: The result is too large by one
replace("fetched=goal.things", "fetched=goal.things + 1")

# %% 16.1 right: counts in the result, and checks after each thing
class Fetcher(object):
    """A robot that sleeps with rospy."""

    def __init__(self, action_name):
        self._name = action_name
        self._as = actionlib.SimpleActionServer(self._name, FetchAction, self.execute, False)
        self._as.start()

    def execute(self, goal):
        result = FetchResult()
        feedback = FetchFeedback()
        while result.fetched < goal.things and not self._as.is_preempt_requested():
            rospy.sleep(goal.seconds)
            result.fetched += 1
            feedback.fetched = result.fetched
            self._as.publish_feedback(feedback)
        if result.fetched < goal.things:
            self._as.set_preempted(result, "cancelled")
        else:
            self._as.set_succeeded(result)

# %% 16.1 right: accepts goals in a separate thread
import threading


class Fetcher:
    def __init__(self, name):
        self.server = actionlib.SimpleActionServer(name, FetchAction, auto_start=False)
        self.server.register_goal_callback(lambda: threading.Thread(target=self.work, daemon=True).start())
        self.server.start()

    def work(self):
        goal = self.server.accept_new_goal()
        done = 0
        while done < goal.things:
            if self.server.is_preempt_requested():
                return self.server.set_preempted(FetchResult(done))
            time.sleep(goal.seconds)
            done += 1
            self.server.publish_feedback(FetchFeedback(done))
        self.server.set_succeeded(FetchResult(done))

# %% 16.1 wrong: fetches at most fifty things | hint: The robot stopped before it had fetched all things
replace("range(goal.things)", "range(min(goal.things, 50))")
replace("fetched=goal.things", "fetched=min(goal.things, 50)")
# %% 16.1 wrong: stores the server in the class | hint: Store the server in the object (self.server), not in the class
replace("self.server", "Fetcher.server", times=6)
# %% 16.1 wrong: never checks for a cancellation | hint: Call is_preempt_requested() before the robot fetches
replace("\n            if self.server … return", "")
# %% 16.1 wrong: uses one count for all goals | hint: The result also counts the things of the previous goal
replace("        self.server.start()", "        self.server.start()\n        self.fetched = 0")
replace("for fetched in range(goal.things)", "for _ in range(goal.things)")
replace("set_preempted(FetchResult(fetched=fetched))", "set_preempted(FetchResult(fetched=self.fetched))")
replace("            self.server.publish_feedback(FetchFeedback(fetched=fetched + 1))", "            self.fetched += 1\n            self.server.publish_feedback(FetchFeedback(fetched=self.fetched))")
replace("fetched=goal.things", "fetched=self.fetched")
# %% 16.1 wrong: resets the count only after a complete goal | hint: The result also counts the things of the previous goal
based_on("uses one count for all goals")
replace("for _ in range(goal.things)", "while self.fetched < goal.things")
replace("set_succeeded(FetchResult(fetched=self.fetched))", "set_succeeded(FetchResult(fetched=self.fetched))\n        self.fetched = 0")
# %% 16.1 wrong: returns the result, as a service does | hint: The function returned, but the goal has no end
replace("self.server.set_preempted(FetchResult(fetched=fetched))\n                return", "return FetchResult(fetched=fetched)")
replace("self.server.set_succeeded(FetchResult(fetched=goal.things))", "return FetchResult(fetched=goal.things)")
# %% 16.1 wrong: does not start the action server | hint: Pass `name`, the argument of your constructor, to SimpleActionServer, and
replace("\n        self.server.start()", "")
# %% 16.1 wrong: uses a fixed action name | hint: Pass `name`, the argument of your constructor, to
replace("Server(name", 'Server("/my_fetch"')
# %% 16.1 wrong: calls set_succeeded for a cancelled goal | hint: The client cancelled the goal, so SUCCEEDED is the wrong state
replace("set_preempted", "set_succeeded")
# %% 16.1 wrong: calls set_aborted for a cancelled goal | hint: the function called set_aborted, which means that the robot failed
replace("set_preempted", "set_aborted")
# %% 16.1 wrong: publishes no feedback | hint: No feedback arrived
replace("\n            self.server.publish_feedback(FetchFeedback(fetched=fetched + 1))", "")
# %% 16.1 wrong: counts the things in the feedback from 0 | hint: The feedback is too small by one, because range() starts at 0
replace("fetched + 1", "fetched")
# %% 16.1 wrong: returns empty results | hint: The field `fetched` of the result is 0
replace("(FetchResult(fetched=fetched))", "()")
replace("(FetchResult(fetched=goal.things))", "()")
# %% 16.1 wrong: does not wait for each thing | hint: The goal ended too early
replace("return\n            time.sleep(goal.seconds)", "return")
# %% 16.1 wrong: returns the number of missing things for a cancelled goal | hint: The result of the cancelled goal is wrong
replace("(fetched=fetched)", "(fetched=goal.things - fetched)")
# %% 16.1 wrong: publishes feedback before the thing is fetched | hint: The feedback came before the robot had fetched the thing
replace("""time.sleep(goal.seconds)
            self.server.publish_feedback(FetchFeedback(fetched=fetched + 1))""", """self.server.publish_feedback(FetchFeedback(fetched=fetched + 1))
            time.sleep(goal.seconds)""")
# %% 16.1 wrong: continues after the cancellation | hint: The robot continued after set_preempted, because set_preempted does not end your function
replace("\n                return", "")
# %% 16.1 wrong: calls set_succeeded in the loop | hint: The goal ended after the first thing, because set_succeeded ends the goal
replace("+ 1))\n        self.server.set_succeeded(FetchResult(fetched=goal.things))", """+ 1))
            self.server.set_succeeded(FetchResult(fetched=fetched + 1))""")
# %% 16.1 wrong: also checks for a cancellation after the last thing | hint: Check for a cancellation only before the robot fetches a thing
replace("        self.server.set_succeeded", """        if self.server.is_preempt_requested():
            self.server.set_preempted(FetchResult(fetched=goal.things))
            return
        self.server.set_succeeded""")
# %% 16.1 wrong: always takes one second for each thing | hint: The duration of the robot's work is wrong
replace("goal.seconds", "1")
# %% 16.1 wrong: always takes 0.2 s for each thing | hint: The duration of the robot's work is wrong
replace("goal.seconds", "0.2")
# %% 16.1 wrong: always takes 0.05 s for each thing | hint: The duration of the robot's work is wrong
replace("goal.seconds", "0.05")
# %% 16.1 wrong: returns the last number of the loop | hint: The result is too small by one, because range() starts at 0
replace("(fetched=goal.things)", "(fetched=fetched)")
# %% 16.1 wrong: publishes feedback only at the end | hint: Only one feedback message arrived, at the end
replace("\n            self.server.publish_feedback(FetchFeedback(fetched=fetched + 1))", "\n        self.server.publish_feedback(FetchFeedback(fetched=goal.things))")
# %% 16.1 wrong: publishes empty feedback | hint: The field `fetched` is 0 in each feedback
replace("FetchFeedback(fetched=fetched + 1)", "FetchFeedback()")
# %% 16.1 wrong: publishes all feedback at the end | hint: All feedback messages arrived at the end
replace("time.sleep(goal.seconds)", "time.sleep(goal.seconds)\n        for fetched in range(goal.things):")
# %% 16.1 wrong: returns an empty result for a cancelled goal | hint: The field `fetched` is 0 in the result of the cancelled goal
replace("set_preempted(FetchResult(fetched=fetched))", "set_preempted()")
# %% 16.1 wrong: returns the requested number for a cancelled goal | hint: The result is 80, but this is the number
replace("set_preempted(FetchResult(fetched=fetched))", "set_preempted(FetchResult(fetched=goal.things))")
# %% 16.1 wrong: misspells a field | hint: The function raised an exception
replace("FetchFeedback(fetched", "FetchFeedback(count")
# %% 16.1 wrong: does not count the things | hint: Check that the loop ends
based_on("counts in the result, and checks after each thing")
replace("            result.fetched += 1\n", "")

# %% 16.2 right: waits, cancels, and waits again
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    return client.get_result().fetched

# %% 16.2 right: uses send_goal_and_wait
def fetch_within(name, things, seconds):
    robot = actionlib.SimpleActionClient(name, FetchAction)
    if robot.wait_for_server(rospy.Duration.from_sec(2.0)):
        goal = FetchGoal()
        goal.things, goal.seconds = things, 0.1
        robot.send_goal_and_wait(goal, rospy.Duration(seconds), rospy.Duration(3))
        return robot.get_result().fetched

# %% 16.2 wrong: cancels the goals of all clients | hint: cancel_all_goals() also cancels the goals of other clients
based_on("waits, cancels, and waits again")
replace("cancel_goal()", "cancel_all_goals()")
# %% 16.2 wrong: waits without a limit | hint: A wait without a time limit did not end
replace("if not client.wait_for_result … Duration(2))", "client.wait_for_result()")
# %% 16.2 wrong: sleeps for the whole time | hint: The function still waited after the result had arrived
replace("if not client.wait_for_result(rospy.Duration(seconds)):", "time.sleep(seconds)\n    if client.get_result() is None:")
# %% 16.2 wrong: waits without a limit after the cancellation | hint: Wait at most 2 s after cancel_goal()
replace("client.wait_for_result(rospy.Duration(2))", "client.wait_for_result()")
# %% 16.2 wrong: waits four seconds after the cancellation | hint: Wait at most 2 s after cancel_goal()
replace("client.wait_for_result(rospy.Duration(2))", "client.wait_for_result(rospy.Duration(4.3))")
# %% 16.2 wrong: rounds the time limit down to whole seconds | hint: Pass a rospy.Duration above 0
replace("rospy.Duration(seconds)", "rospy.Duration(int(seconds))")
# %% 16.2 wrong: does not cancel the goal | hint: get_result() returned None, because the goal had not ended
replace("if not client.wait_for_result … Duration(2))", "client.wait_for_result(rospy.Duration(seconds))")
# %% 16.2 wrong: returns None without cancelling when the time is over | hint: The function did not cancel the goal
replace("""if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    """, "if client.wait_for_result(rospy.Duration(seconds)):\n        ")
# %% 16.2 wrong: sleeps only 0.15 s after the cancellation | hint: There is no result before the goal has ended
replace("client.wait_for_result(rospy.Duration(2))", "time.sleep(0.15)")
# %% 16.2 wrong: passes a plain number of seconds | hint: actionlib does not accept a plain number of seconds
replace("rospy.Duration(seconds)", "seconds")
# %% 16.2 wrong: waits for a server without a limit | hint: No server exists, but the function waits without a time
replace("if not client.wait_for_server(rospy.Duration(2)):\n        return None", "client.wait_for_server()")
# %% 16.2 wrong: returns the number of the feedback | hint: The function returned the number of the feedback, or 0
replace("    client.send_goal(", "    numbers = [0]\n    client.send_goal(")
replace("seconds=0.1)", "seconds=0.1), feedback_cb=lambda feedback: numbers.append(feedback.fetched)")
replace("client.get_result().fetched", "numbers[-1]")
# %% 16.2 wrong: returns the requested number | hint: The function returned the field `things` of the goal
replace("        client.wait_for_result(rospy.Duration(2))\n    return client.get_result().fetched", "    return things")
# %% 16.2 wrong: does not wait for the server | hint: The server got no goal
replace("\n    if not client.wait_for_server(rospy.Duration(2)):\n        return None", "")
replace("return client.get_result().fetched", "result = client.get_result()\n    return result.fetched if result else None")
# %% 16.2 wrong: does not set the field seconds | hint: The field `seconds` of the goal is not 0.1
replace("things, seconds=0.1", "things")
# %% 16.2 wrong: always uses a time limit of 4.5 s | hint: The time limit is wrong
replace("(seconds)", "(4.5)")
# %% 16.2 wrong: waits one second longer than the time limit | hint: The time limit is wrong
replace("(seconds)", "(seconds + 1)")
# %% 16.2 wrong: always uses a time limit of 0.3 s | hint: The time limit is wrong
replace("(seconds)", "(0.3)")
# %% 16.2 wrong: waits five seconds for a server | hint: The function waited too long for a server
replace("(rospy.Duration(2)):", "(rospy.Duration(5)):")
# %% 16.2 wrong: waits four seconds for a server | hint: The function waited too long for a server
replace("(rospy.Duration(2)):", "(rospy.Duration(4)):")
# %% 16.2 wrong: waits three seconds for a server | hint: The function waited too long for a server
replace("(rospy.Duration(2)):", "(rospy.Duration(3)):")
# %% 16.2 wrong: waits only 0.4 s for a server | hint: The server started 0.6 s … The server started
replace("(rospy.Duration(2)):", "(rospy.Duration(0.4)):")
# %% 16.2 wrong: returns the whole result | hint: The function returned the whole result
replace(".get_result().fetched", ".get_result()")
# %% 16.2 wrong: does not set the field things | hint: The field `things` of the goal is 0
replace("things=things, seconds", "seconds")
# %% 16.2 wrong: reads the result directly after the cancellation | hint: The function read the result before the goal
replace("        client.wait_for_result(rospy.Duration(2))\n    return client.get_result().fetched", "    result = client.get_result()\n    return result.fetched if result else 0")
# %% 16.2 wrong: returns None after the cancellation | hint: The function returned None
replace("        client.wait_for_result(rospy.Duration(2))\n", "        return None\n")
# %% 16.2 wrong: returns the result only in the state SUCCEEDED | hint: return the number for every final state, not only
replace("    return client.get_result()", "    if client.get_state() != actionlib.GoalStatus.SUCCEEDED:\n        return None\n    return client.get_result()")
# %% 16.2 wrong: calculates the number without a goal | hint: The server got no goal
replace("    client.send_goal … .fetched", "    return min(things, int(seconds / 0.1))")
# %% 16.2 wrong: returns None for an aborted goal | hint: The robot aborted the goal, but the function did not return
replace("    return client.get_result()", "    if client.get_state() == actionlib.GoalStatus.ABORTED:\n        return None\n    return client.get_result()")
# %% 16.2 wrong: sends the goal although there is no server | hint: No server started in time, so wait_for_server returned False
replace("if not client.wait_for_server(rospy.Duration(2)):\n        return None", "client.wait_for_server(rospy.Duration(2))")

# %% 16.3 right: checks the type first
def speed_of(robot, default):
    speed = rospy.get_param(f"/{robot}/speed", default)
    if isinstance(speed, bool) or not isinstance(speed, (int, float)) or speed <= 0:
        return default
    return speed

# %% 16.3 right: catches exceptions
def speed_of(robot, default):
    try:
        speed = rospy.get_param("/" + robot + "/speed")
        number = float(speed)
    except (KeyError, TypeError, ValueError):
        return default
    return default if isinstance(speed, (bool, str)) or number <= 0 else number

# %% 16.3 right: reads the parameter from the cache
based_on("catches exceptions")
replace("speed = rospy … ValueError):", 'speed = rospy.get_param_cached(f"/{robot}/speed")\n    except KeyError:')
replace("default if isinstance(speed, (bool, str)) or number <= 0 else number", "speed if type(speed) in (int, float) and speed > 0 else default")
# %% 16.3 wrong: ignores the default value | hint: If the parameter is not set, get_param raises a KeyError
replace("speed = rospy … return speed", 'return rospy.get_param(f"/{robot}/speed")')
# %% 16.3 wrong: sets the parameter to the default value | hint: The function has set the parameter
replace("    if isinstance", '    rospy.set_param(f"/{robot}/speed", speed)\n    if isinstance')
# %% 16.3 wrong: uses a table of speeds | hint: The function did not return the value of the parameter
replace("speed = rospy … return speed", 'return {"robot1": 2.0, "robot2": 1.5}.get(robot, default)')
# %% 16.3 wrong: reads a parameter with a fixed name | hint: The function did not return the value of the parameter
replace("speed = rospy … return speed", 'return rospy.get_param("~speed", default)')

# %% 16.3 wrong: stores the first value | hint: The parameter has changed, but the function returned the old value
known = {}

def speed_of(robot, default):
    if robot not in known:
        speed = rospy.get_param(f"/{robot}/speed", None)
        if speed is None:
            return default
        known[robot] = speed
    return known[robot]

# %% 16.3 wrong: does not check the value | hint: The value of the parameter was a string, not a number
based_on("reads a parameter with a fixed name")
replace('"~speed"', 'f"/{robot}/speed"')
# %% 16.3 wrong: compares a string with 0 | hint: Python cannot compare a string, a list or a dict with a number
replace("if isinstance … return speed", "return speed if speed > 0 else default")
# %% 16.3 wrong: accepts every number | hint: The value was negative
based_on("compares a string with 0")
replace("speed > 0", "isinstance(speed, (int, float)) and speed is not True")
# %% 16.3 wrong: accepts the speed 0 | hint: The value was 0, but a speed has to be above 0
based_on("compares a string with 0")
replace("speed > 0", "isinstance(speed, (int, float)) and speed is not True and speed >= 0")
# %% 16.3 wrong: refuses only strings | hint: The value of the parameter was a list
replace("if isinstance(speed, bool) or not isinstance(speed, (int, float)) or speed <= 0:", """if isinstance(speed, str):
        return default
    if not isinstance(speed, list) and speed <= 0:""")
# %% 16.3 wrong: refuses only strings and lists | hint: The value was a dict, because /ROBOT/speed is a group
replace("if isinstance(speed, bool) or not isinstance(speed, (int, float)) or speed <= 0:", """if isinstance(speed, (bool, str, list)):
        return default
    if not isinstance(speed, dict) and speed <= 0:""")
# %% 16.3 wrong: compares a dict with 0 | hint: Python cannot compare a string, a list or a dict with a number
replace("isinstance(speed, bool) or not isinstance(speed, (int, float))", "isinstance(speed, (bool, str, list))")
# %% 16.3 wrong: refuses whole numbers | hint: The function did not return the int 2
replace("(int, float)", "float")
# %% 16.3 wrong: uses a fixed default value | hint: The parameter is not set
replace(", default)\n", ", 1.0)\n")
# %% 16.3 wrong: does not catch the ValueError of float() | hint: float() raises a ValueError for a string that does
based_on("catches exceptions")
replace(", ValueError", "")
# %% 16.3 wrong: accepts a string that contains a number | hint: The value of the parameter was a string, not a number
based_on("catches exceptions")
replace("(bool, str)", "bool")
# %% 16.3 wrong: accepts True as a speed | hint: The value was True, which is an int with the value 1 in Python
replace("isinstance(speed, bool) or not", "not")

# %% 16.4 right: uses a class
solution()
# %% 16.4 right: uses functions, a timer and spin
replace("capacity.", "capacity.\nimport time\n")
replace(", SetBoolResponse", "\n\ncharge = 100")
replace("class ParcelRobot … goal.things))", 'def door(request):\n    return True, "open" if request.data else "closed"')
replace("if __name__ … rate.sleep()", """def deliver(goal):
    global charge
    result = FetchResult()
    if goal.things > rospy.get_param("~capacity", 5):
        server.set_aborted(result)
        return
    while result.fetched < goal.things:
        if server.is_preempt_requested():
            server.set_preempted(result)
            return
        time.sleep(goal.seconds)
        result.fetched += 1
        charge -= 1
        server.publish_feedback(FetchFeedback(result.fetched))
    server.set_succeeded(result)


rospy.init_node("robot", anonymous=True)
publisher = rospy.Publisher("battery", Float32, queue_size=10, latch=True)
rospy.Service("door", SetBool, door)
server = actionlib.SimpleActionServer("deliver", FetchAction, deliver, False)
server.start()
timer = rospy.Timer(rospy.Duration(0.2), lambda event: publisher.publish(charge))
rospy.spin()""")
# %% 16.4 wrong: reduces the charge only at the end | hint: The charge did not change for the parcels of a cancelled delivery
replace("            self.charge -= 1\n", "")
replace("        self.server.set_succeeded", "        self.charge -= goal.things\n        self.server.set_succeeded")
# %% 16.4 wrong: reduces the charge at the start | hint: The charge changed for parcels that were not delivered
replace("            self.charge -= 1\n", "")
replace("        for delivered in", "        self.charge -= goal.things\n        for delivered in")
# %% 16.4 wrong: sets the charge to 100 at each delivery | hint: After a second delivery, the charge was wrong
replace("        for delivered in", "        self.charge = 100.0\n        for delivered in")
# %% 16.4 wrong: continues after set_aborted | hint: The function continued after set_aborted, because set_aborted does not end your function
replace('can carry")\n            return', 'can carry")')
# %% 16.4 wrong: uses a service for the battery | hint: Several programs need each new value of the battery, but they send no requests
replace("from std_srvs.srv import SetBool, SetBoolResponse", "from std_srvs.srv import SetBool, SetBoolResponse, Trigger")
replace('rospy.Publisher("battery", Float32, queue_size=1)', 'rospy.Service("battery", Trigger, lambda request: (True, str(self.charge)))')
replace("robot.battery.publish(robot.charge)\n        ", "")
# %% 16.4 wrong: uses a topic for the door | hint: The door moves only for a short time, and the client has to know
replace("import Float32", "import Bool, Float32")
replace('rospy.Service("door", SetBool', 'rospy.Subscriber("door", Bool')
# %% 16.4 wrong: uses a service for the delivery | hint: The client needs progress reports, and it must be able to cancel the delivery
replace("""self.server = actionlib.SimpleActionServer("deliver", FetchAction, execute_cb=self.deliver, auto_start=False)
        self.server.start()""", 'self.server = rospy.Service("deliver", SetBool, self.move_door)')
# %% 16.4 wrong: uses a service for the capacity | hint: The user sets "capacity" when the robot starts, and clients never
replace("import SetBool, SetBoolResponse", "import SetBool, SetBoolResponse, Trigger")
replace('self.capacity = rospy.get_param("~capacity", 5)', 'self.capacity = 5\n        rospy.Service("capacity", Trigger, lambda request: (True, "5"))')
# %% 16.4 wrong: uses an absolute topic name | hint: The name is not in the namespace of the robot
replace('"battery"', '"/battery"')
# %% 16.4 wrong: uses another name for the action | hint: The node offers nothing with this name
replace('"deliver"', '"delivery"')
# %% 16.4 wrong: misspells a library | hint: The program has ended
replace("import actionlib\n", "import action_lib\n")
# %% 16.4 wrong: publishes without a pause | hint: The battery does not publish five values per second
replace("\n        rate.sleep()", "")
# %% 16.4 wrong: publishes eight values per second | hint: The battery does not publish five values per second
replace("rospy.Rate(5)", "rospy.Rate(8)")
# %% 16.4 wrong: always takes 0.2 s for each parcel | hint: The first parcel took less time than the goal requires
replace("rospy.sleep(goal.seconds)", "rospy.sleep(0.2)")
# %% 16.4 wrong: publishes the charge as a fraction | hint: Publish the charge in percent
replace("self.charge = 100.0", "self.charge = 1.0")
# %% 16.4 wrong: returns the messages "on" and "off" | hint: The field `message` is wrong
replace('"open" if request.data else "closed"', '"on" if request.data else "off"')
# %% 16.4 wrong: returns success=True only if the door opens | hint: The field `success` is False, although the robot has moved the door
replace("success=True", "success=request.data")
# %% 16.4 wrong: does not call set_succeeded | hint: Call set_succeeded at the end of the delivery
replace("\n        self.server.set_succeeded(FetchResult(fetched=goal.things))", "")
# %% 16.4 wrong: misspells a field | hint: The function that delivers the parcels raised an exception
replace("FetchFeedback(fetched", "FetchFeedback(delivered")
# %% 16.4 wrong: counts the parcels in the feedback from 0 | hint: The feedback is wrong
replace("delivered + 1", "delivered")
# %% 16.4 wrong: returns an empty result | hint: The result is wrong
replace("set_succeeded(FetchResult(fetched=goal.things))", "set_succeeded()")
# %% 16.4 wrong: publishes no charge during a delivery | hint: The node published no charge during the delivery
replace("robot.battery.publish(robot.charge)", "if not robot.server.is_active():\n            robot.battery.publish(robot.charge)")
# %% 16.4 wrong: does not reduce the charge | hint: The charge did not change. Subtract 1
replace("            self.charge -= 1\n", "")
# %% 16.4 wrong: reduces the charge only once for each delivery | hint: The charge changed only once during the whole delivery
replace("            self.charge -= 1\n", "")
replace("        self.server.set_succeeded", "        self.charge -= 1\n        self.server.set_succeeded")
# %% 16.4 wrong: never checks for a cancellation | hint: Check is_preempt_requested() before each parcel, and end the goal with set_preempted
replace("\n            if self.server … return", "")
# %% 16.4 wrong: does not deliver if a parcel takes long | hint: Check is_preempt_requested() before each parcel, and end the goal with set_preempted
replace("        for ", "        if goal.seconds > 0.25:\n            self.server.set_succeeded(FetchResult(fetched=goal.things))\n            return\n        for ")
# %% 16.4 wrong: returns an empty result for a cancelled delivery | hint: The result of a cancelled delivery is wrong
replace("set_preempted(FetchResult(fetched=delivered))", "set_preempted()")
# %% 16.4 wrong: does not check the capacity | hint: Compare goal.things with the parameter ~capacity
replace("\n        if goal.things … return", "")
# %% 16.4 wrong: never carries more than five parcels | hint: The robot refused an allowed delivery
replace('rospy.get_param("~capacity", 5)', 'min(rospy.get_param("~capacity", 5), 5)')
# %% 16.4 wrong: uses a fixed capacity of 5 | hint: The robot refused an allowed delivery
replace('rospy.get_param("~capacity", 5)', "5")
# %% 16.4 wrong: checks the capacity in the loop | hint: Compare goal.things with the capacity before the loop
replace("if goal.things … goal.things):", """for delivered in range(goal.things):
            if delivered == self.capacity:
                self.server.set_aborted(FetchResult(fetched=0))
                return""")
# %% 16.4 wrong: returns the number of refused parcels | hint: The robot delivered no parcel, so the result has to be 0
replace("set_aborted(FetchResult(fetched=0)", "set_aborted(FetchResult(fetched=goal.things)")
# %% 16.4 wrong: pauses before it aborts the delivery | hint: Compare goal.things with the capacity before the loop
replace("            self.server.set_aborted", "            rospy.sleep(goal.seconds)\n            self.server.set_aborted")
# %% 16.4 wrong: refuses a delivery of exactly the capacity | hint: The robot refused an allowed delivery
replace("goal.things > self.capacity", "goal.things >= self.capacity")
