"""What students write in the exercises of chapter 13."""

# %% before
import time

import actionlib
import rospy

from course_pkg import join
from course_pkg.msg import FetchAction, FetchFeedback, FetchGoal, FetchResult

node = join("chapter_13")

# %% 13.1 right: looks before each thing
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched=fetched))
            return
        time.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.1 right: counts for itself, and looks after each thing
def fetch(goal, server):
    """Fetch, with a rate."""
    result = FetchResult()
    feedback = FetchFeedback()
    while result.fetched < goal.things and not server.is_preempt_requested():
        rospy.sleep(goal.seconds)
        result.fetched += 1
        feedback.fetched = result.fetched
        server.publish_feedback(feedback)
    if result.fetched < goal.things:
        server.set_preempted(result, "called off")
    else:
        server.set_succeeded(result)

# %% 13.1 wrong: never looks whether it is to stop | hint: Look before each thing whether server.is_preempt_requested()
def fetch(goal, server):
    for fetched in range(goal.things):
        time.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.1 wrong: returns the result, as a service does | hint: It returns nothing: it tells the server
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            return FetchResult(fetched=fetched)
        time.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
    return FetchResult(fetched=goal.things)

# %% 13.1 wrong: succeeds although it was called off | hint: It was called off, and did not succeed
def fetch(goal, server):
    done = 0
    while done < goal.things and not server.is_preempt_requested():
        time.sleep(goal.seconds)
        done += 1
        server.publish_feedback(FetchFeedback(fetched=done))
    server.set_succeeded(FetchResult(fetched=done))

# %% 13.1 wrong: aborts when it is called off | hint: set_aborted is for a robot that could not
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_aborted(FetchResult(fetched=fetched))
            return
        time.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.1 wrong: no feedback | hint: No feedback was sent
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched=fetched))
            return
        time.sleep(goal.seconds)
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.1 wrong: counts from 0 | hint: When the first thing is there, it is 1
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched=fetched))
            return
        time.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched=fetched))
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.1 wrong: an empty result | hint: set_succeeded(FetchResult(fetched=…))
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted()
            return
        time.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
    server.set_succeeded()

# %% 13.1 wrong: takes no time | hint: Sleep for goal.seconds with each thing
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched=fetched))
            return
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.1 wrong: what is missing when it is called off | hint: As many as the last feedback said
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched=goal.things - fetched))
            return
        time.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.1 wrong: tells first, and sleeps then | hint: Sleep for goal.seconds first
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched=fetched))
            return
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
        time.sleep(goal.seconds)
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.1 wrong: goes on after it was called off | hint: return after it
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched=fetched))
        time.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.1 wrong: succeeds in the loop | hint: stands behind the loop
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched=fetched))
            return
        time.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
        server.set_succeeded(FetchResult(fetched=fetched + 1))

# %% 13.1 wrong: a second for each | hint: and for nothing else
def fetch(goal, server):
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched=fetched))
            return
        time.sleep(1)
        server.publish_feedback(FetchFeedback(fetched=fetched + 1))
    server.set_succeeded(FetchResult(fetched=goal.things))

# %% 13.2 right: waits, calls off, and waits again
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    return client.get_result().fetched

# %% 13.2 right: by the call that does all of it
def fetch_within(name, things, seconds):
    robot = actionlib.SimpleActionClient(name, FetchAction)
    if robot.wait_for_server(rospy.Duration.from_sec(2.0)):
        goal = FetchGoal()
        goal.things, goal.seconds = things, 0.1
        robot.send_goal_and_wait(goal, rospy.Duration(seconds), rospy.Duration(3))
        return robot.get_result().fetched

# %% 13.2 wrong: waits without a bound | hint: rospy.Duration(…) bounds a wait
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    client.wait_for_result()
    return client.get_result().fetched

# %% 13.2 wrong: gives up, and calls nothing off | hint: When the time is up, call it off by cancel_goal()
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    client.wait_for_result(rospy.Duration(seconds))
    return client.get_result().fetched

# %% 13.2 wrong: returns nothing when the time is up | hint: When wait_for_result returns False, the time is up
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if client.wait_for_result(rospy.Duration(seconds)):
        return client.get_result().fetched

# %% 13.2 wrong: does not wait for the end after calling off | hint: the robot still finishes what it has in its hands
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
        time.sleep(0.15)
    return client.get_result().fetched

# %% 13.2 wrong: a plain number of seconds | hint: actionlib takes no plain number of seconds
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(seconds):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    return client.get_result().fetched

# %% 13.2 wrong: waits for a robot for ever | hint: Nobody serves it, and it waits for ever
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    client.wait_for_server()
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    return client.get_result().fetched

# %% 13.2 wrong: believes what it asked for | hint: The robot says how many it has: get_result().fetched
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
    return things

# %% 13.2 wrong: does not wait for the robot | hint: The goal never arrived
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    result = client.get_result()
    return result.fetched if result else None

# %% 13.2 wrong: no seconds | hint: And how long each takes
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things))
    if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    return client.get_result().fetched

# %% 13.2 wrong: five seconds in any case | hint: says how long to wait
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(4.5)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    return client.get_result().fetched

# %% 13.2 wrong: calls it off at once | hint: says how long to wait
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(2)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(0.5)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    return client.get_result().fetched

# %% 13.2 wrong: five seconds for a robot | hint: It waited for too long
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(5)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    return client.get_result().fetched

# %% 13.2 wrong: hardly waits for a robot | hint: The robot came 0.4 s after the call
def fetch_within(name, things, seconds):
    client = actionlib.SimpleActionClient(name, FetchAction)
    if not client.wait_for_server(rospy.Duration(0.25)):
        return None
    client.send_goal(FetchGoal(things=things, seconds=0.1))
    if not client.wait_for_result(rospy.Duration(seconds)):
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(2))
    return client.get_result().fetched

# %% 13.3 right: looks before it believes
def speed_of(robot, default):
    speed = rospy.get_param(f"/{robot}/speed", default)
    if not isinstance(speed, (int, float)) or speed <= 0:
        return default
    return speed

# %% 13.3 right: by an exception, and a relative name
def speed_of(robot, default):
    try:
        speed = float(rospy.get_param(robot + "/speed"))
    except (KeyError, TypeError, ValueError):
        return default
    return speed if speed > 0 else default

# %% 13.3 wrong: no default | hint: get_param raises a KeyError where nothing is set
def speed_of(robot, default):
    return rospy.get_param(f"/{robot}/speed")

# %% 13.3 wrong: a name of its own | hint: Its name is made of the robot's
def speed_of(robot, default):
    return rospy.get_param("~speed", default)

# %% 13.3 wrong: remembers the first | hint: a parameter tells nobody: ask each time anew
known = {}

def speed_of(robot, default):
    if robot not in known:
        speed = rospy.get_param(f"/{robot}/speed", None)
        if speed is None:
            return default
        known[robot] = speed
    return known[robot]

# %% 13.3 wrong: believes whatever is there | hint: Look whether it is a number
def speed_of(robot, default):
    return rospy.get_param(f"/{robot}/speed", default)

# %% 13.3 wrong: compares a text with 0 | hint: A text cannot be compared with a number
def speed_of(robot, default):
    speed = rospy.get_param(f"/{robot}/speed", default)
    return speed if speed > 0 else default

# %% 13.3 wrong: any number will do | hint: A speed is above 0
def speed_of(robot, default):
    speed = rospy.get_param(f"/{robot}/speed", default)
    return speed if isinstance(speed, (int, float)) else default

# %% 13.3 wrong: 0 is a speed | hint: 0 is not above 0
def speed_of(robot, default):
    speed = rospy.get_param(f"/{robot}/speed", default)
    return speed if isinstance(speed, (int, float)) and speed >= 0 else default

# %% 13.3 wrong: only a text is no number | hint: A list, and even a dict
def speed_of(robot, default):
    speed = rospy.get_param(f"/{robot}/speed", default)
    if isinstance(speed, str):
        return default
    if not isinstance(speed, list) and speed <= 0:
        return default
    return speed

# %% 13.4 right: case by case
choices = {
    "a": "topic",
    "b": "service",
    "c": "action",
    "d": "parameter",
    "e": "topic",
    "f": "service",
    "g": "action",
    "h": "parameter",
}

# %% 13.4 right: sorted by what they are
choices = {letter: what for what, letters in {"topic": "ae", "service": "bf", "action": "cg", "parameter": "dh"}.items() for letter in letters}

# %% 13.4 wrong: asks for the angles | hint: nobody can ask so often
choices = {"a": "service", "b": "service", "c": "action", "d": "parameter", "e": "topic", "f": "service", "g": "action", "h": "parameter"}

# %% 13.4 wrong: a service that takes a minute | hint: while a service is called, neither can be done
choices = {"a": "topic", "b": "service", "c": "service", "d": "parameter", "e": "topic", "f": "service", "g": "service", "h": "parameter"}

# %% 13.4 wrong: a topic for what has to be known | hint: A topic gives no answer
choices = {"a": "topic", "b": "service", "c": "action", "d": "parameter", "e": "topic", "f": "topic", "g": "action", "h": "parameter"}

# %% 13.4 wrong: a server for a constant | hint: No server has to run for that
choices = {"a": "topic", "b": "service", "c": "action", "d": "parameter", "e": "topic", "f": "service", "g": "action", "h": "service"}

# %% 13.4 wrong: in other words | hint: Case b has to be one of
choices = {"a": "topic", "b": "Services", "c": "action", "d": "parameter", "e": "topic", "f": "service", "g": "action", "h": "parameter"}

# %% 13.4 wrong: an action for the till | hint: it is done at once
choices = {"a": "topic", "b": "service", "c": "action", "d": "parameter", "e": "topic", "f": "action", "g": "action", "h": "parameter"}

# %% 13.4 wrong: a topic for a minute | hint: which a topic does not say
choices = {"a": "topic", "b": "service", "c": "topic", "d": "parameter", "e": "topic", "f": "service", "g": "action", "h": "parameter"}

# %% 13.4 wrong: a parameter for the gripper | hint: It changes, so it is no setting
choices = {"a": "topic", "b": "parameter", "c": "action", "d": "parameter", "e": "topic", "f": "service", "g": "action", "h": "parameter"}
