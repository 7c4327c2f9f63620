"""Example answers of chapter 15; tests/checking/answers/example_answers.py explains the format."""

# %% 15.1 right: uses a function that returns None for a malformed frame
solution()

# %% 15.1 right: uses a class with numpy, and an exception
'''%%writefile src/my_cashier/scripts/vision.py
#!/usr/bin/env python3
"""Tells whether a customer is in a frame."""
import numpy as np
import rospy
from sensor_msgs.msg import Image
from std_msgs.msg import Bool

THRESHOLD = 96


class Vision:
    def __init__(self):
        self.publisher = rospy.Publisher("customer_seen", Bool, queue_size=10)
        self.subscriber = rospy.Subscriber("frames", Image, self.callback)

    def points(self, frame):
        if frame.encoding != "mono8" or 0 in (frame.width, frame.height):
            raise ValueError("not a grey picture")
        if frame.step < frame.width:
            raise ValueError("the rows are too short")
        grid = np.frombuffer(frame.data, np.uint8).reshape(frame.height, frame.step)
        return grid[:, : frame.width]

    def callback(self, frame):
        try:
            points = self.points(frame)
        except ValueError as error:
            rospy.logwarn("left out: %s", error)
            return
        share = np.count_nonzero(points < THRESHOLD) / points.size
        self.publisher.publish(Bool(data=bool(share >= 0.1)))


def main():
    rospy.init_node("vision")
    Vision()
    rospy.spin()


if __name__ == "__main__":
    main()
'''

# %% 15.1 wrong: compares the mean brightness | hint: A fifth of the points is dark, so this frame shows a customer
replace("10 * dark >= frame.width * frame.height", "sum(map(sum, rows)) < 96 * frame.width * frame.height")
# %% 15.1 wrong: returns True for any dark point | hint: Only a twentieth of the points is dark
replace("10 * dark >= frame.width * frame.height", "dark > 0")
# %% 15.1 wrong: requires more than a tenth of the points | hint: Exactly a tenth of the points is dark, so this frame shows a
replace(">= frame.width", "> frame.width")
# %% 15.1 wrong: rounds the share of dark points | hint: The number of dark points is less than a tenth of all points, so this
replace("10 * dark >= frame.width * frame.height", "round(dark / (frame.width * frame.height), 2) >= 0.1")
# %% 15.1 wrong: rounds a tenth of the points down | hint: The number of dark points is less than a tenth of all points, so this
replace("10 * dark >= frame.width * frame.height", "dark >= frame.width * frame.height // 10")
# %% 15.1 wrong: treats 96 as dark | hint: Some points have the value 96, but a point is dark only if its
replace("point < 96", "point <= 96")
# %% 15.1 wrong: counts the padding | hint: Each row has frame.step bytes, but only the first frame.width bytes are points
replace("frame.data[start : start + frame.width]", "frame.data[start : start + frame.step]")
# %% 15.1 wrong: always publishes True | hint: No point is dark, so this frame shows no customer
replace("10 * dark >= frame.width * frame.height", "dark >= 0")
# %% 15.1 wrong: publishes only for frames with customers | hint: The node published nothing for a valid frame. Check whether the callback
replace("if customer is not None:", "if customer:")
# %% 15.1 wrong: publishes only for the first fifty frames | hint: The node stopped after some frames
replace("    if customer is not None:", "    frames.append(customer)\n    if customer is not None and len(frames) <= 50:")
replace("def sees", "frames = []\n\n\ndef sees")
# %% 15.1 wrong: publishes two messages for each frame | hint: The node published more than one message for a frame
replace("        seen.publish(customer)", "        seen.publish(customer)\n        seen.publish(customer)")
# %% 15.1 wrong: ends the node after a malformed frame | hint: The node published nothing for a valid frame after a malformed frame
replace("    if len(frame.data) != frame.height * frame.step:\n        return None", "    if len(frame.data) != frame.height * frame.step:\n        rospy.signal_shutdown('malformed')\n        return None")
# %% 15.1 wrong: accepts frames with missing bytes | hint: Bytes are missing in this frame
replace("    if len(frame.data) != frame.height * frame.step:\n        return None\n", "")
# %% 15.1 wrong: accepts frames with additional bytes | hint: This frame has more bytes than height * step, so it is not valid
replace("len(frame.data) != frame", "len(frame.data) < frame")
# %% 15.1 wrong: accepts any encoding | hint: The encoding of this frame is not mono8
replace('frame.encoding != "mono8" or ', "")
# %% 15.1 wrong: accepts another encoding with one byte per point | hint: The encoding of this frame is not mono8
replace('frame.encoding != "mono8"', 'frame.encoding not in ("mono8", "8UC1")')
# %% 15.1 wrong: accepts every encoding that begins with mono | hint: The encoding of this frame is not mono8
replace('frame.encoding != "mono8"', 'not frame.encoding.startswith("mono")')
# %% 15.1 wrong: accepts any step | hint: In this frame, a row has fewer bytes than points, which is
replace(" or frame.step < frame.width", "")
# %% 15.1 wrong: accepts an empty frame | hint: The height of this frame is 0
replace('if frame.encoding != "mono8" or not frame.width or not frame.height or frame.step < frame.width:\n        return None', 'if frame.encoding != "mono8" or frame.step < frame.width:\n        return None\n    if not frame.data:\n        return False')
# %% 15.1 wrong: accepts a width of 0 | hint: The width of this frame is 0, so all its bytes are padding
replace('not frame.width or not frame.height or', 'not frame.data or')
# %% 15.1 wrong: accepts a height of 0 | hint: The height of this frame is 0, so it has no points
replace(' or not frame.height', '')
# %% 15.1 wrong: subscribes with another message type | hint: The node subscribes to the topic of the frames with a wrong type
replace("import Image", "import CompressedImage as Image")
# %% 15.1 wrong: uses a global topic name | hint: The program uses the global name
replace('"frames"', '"/frames"')
# %% 15.1 wrong: uses another node name | hint: The program did not create the right node … The program did not create the right node
replace('init_node("vision")', 'init_node("camera")')
# %% 15.1 wrong: misspells a topic | hint: The program runs, but the check found
replace('"customer_seen"', '"costumer_seen"')
# %% 15.1 wrong: prepares the node as the course's programs do | hint: Your program starts or imports a program of the course
replace('rospy.init_node("vision")', 'rospy.init_node("vision")\n    from course_pkg.ros import prepare_node\n    prepare_node()')
# %% 15.1 wrong: omits spin | hint: The program reached its last line, so the node ended
replace("\n    rospy.spin()", "")

# %% 15.2 right: uses a condition
solution()
# %% 15.2 right: uses a loop that polls
replace("threading\n", "math\nimport time")
replace("import AwaitCustomer", "import AwaitCustomer, AwaitCustomerResponse")
replace("import Bool\n", "import Bool\n\nnewest = None")
replace("\nclass Detector … handle_detect)", "")
replace("    def handle_seen … notify_all()", "def callback(message):\n    global newest\n    newest = message.data")
replace("    def handle_detect … .patience)", """
def handle(req):
    if math.isnan(req.patience) or req.patience < 0 or req.patience > 60:
        raise rospy.ServiceException("%s is no legal patience" % req.patience)
    end = time.monotonic() + req.patience
    while not newest and time.monotonic() < end:
        time.sleep(0.02)
    return AwaitCustomerResponse(found=bool(newest))


def main():
    rospy.init_node("customer_detector")
    rospy.Subscriber("customer_seen", Bool, callback, queue_size=1)
    rospy.Service("detect_customer", AwaitCustomer, handle)
    rospy.spin()""")
replace('rospy.init_node("customer_detector")\n    Detector()\n    rospy.spin()', "main()")
# %% 15.2 wrong: never forgets a customer | hint: The newest message reports no customer, but `found` is True in the response
replace("self.customer = message.data", "self.customer = self.customer or message.data")
# %% 15.2 wrong: does not wait for a customer | hint: The response came too early
based_on("uses a loop that polls")
replace("while not newest and", "while False and")
# %% 15.2 wrong: waits for at most 1 s | hint: The response came too early
replace("timeout=request.patience)", "timeout=min(request.patience, 1.0))")
# %% 15.2 wrong: waits for 30 s in any case | hint: The response came too late
replace(", timeout=request.patience)", ", timeout=30)")
# %% 15.2 wrong: starts the time limit again after each message | hint: because each message starts the time limit of `wait()` again
replace("            return self.changed.wait_for(lambda: self.customer, timeout=request.patience)", "            while not self.customer and self.changed.wait(request.patience):\n                pass\n            return self.customer")
# %% 15.2 wrong: always returns False | hint: The newest message reports a customer, but `found` is False in the response
based_on("uses a loop that polls")
replace("found=bool(newest)", "")
# %% 15.2 wrong: waits before the check | hint: A customer was there before the call
based_on("uses a loop that polls")
replace("    while not newest and time.monotonic() < end:\n        time.sleep(0.02)\n", "    time.sleep(req.patience)\n")
# %% 15.2 wrong: holds a lock while it waits | hint: Do not hold a lock while the handler waits
replace("            return self.changed.wait_for(lambda: self.customer, timeout=request.patience)", "            end = rospy.get_time() + request.patience\n            while not self.customer and rospy.get_time() < end:\n                self.changed.wait(0.02)\n            return self.customer")
replace("        with self.changed:\n            end", "        with self.turn, self.changed:\n            end")
replace("        self.customer = False", "        self.customer = False\n        self.turn = threading.Lock()")
# %% 15.2 wrong: wakes up only one thread | hint: The customer came while several calls were waiting, but one of these
replace("            self.customer = message.data\n            self.changed.notify_all()", "            if message.data and not self.customer:\n                self.changed.notify()\n            self.customer = message.data")
# %% 15.2 wrong: polls twice per second | hint: A call got its response late, because the handler polls with long pauses
based_on("uses a loop that polls")
replace("time.sleep(0.02)", "time.sleep(min(0.5, end - time.monotonic()))")
# %% 15.2 wrong: polls four times per second | hint: A call got its response late, because the handler polls with long pauses
based_on("uses a loop that polls")
replace("time.sleep(0.02)", "time.sleep(min(0.25, end - time.monotonic()))")
# %% 15.2 wrong: accepts any patience | hint: The handler accepted an impossible value of `patience`
replace("if not 0 <= request.patience <= 60:", "if False:")
replace("timeout=request.patience)", "timeout=max(0, request.patience))")
# %% 15.2 wrong: accepts the patience nan | hint: The handler accepted nan (not a number), because each comparison with nan is False
replace("if not 0 <= request.patience <= 60:", "if request.patience < 0 or request.patience > 60:")
# %% 15.2 wrong: omits the word "patience" in the error message | hint: The error message does not contain the word "patience"
replace('"patience has to be', '"it has to be')
# %% 15.2 wrong: limits a long patience to 60 s | hint: The handler waited before it refused
replace("if not 0 <= request.patience <= 60:", "if request.patience != request.patience or request.patience < 0:")
replace("timeout=request.patience)", "timeout=min(request.patience, 60))")
# %% 15.2 wrong: raises a ValueError | hint: The handler raised an error that is not a rospy.ServiceException
replace("raise rospy.ServiceException", "raise ValueError")
# %% 15.2 wrong: refuses a patience of 0 | hint: The handler refused a valid call
replace("0 <= request", "0 < request")
# %% 15.2 wrong: refuses a patience of 60 s | hint: The handler refused a valid call
replace("<= 60:", "< 60:")
# %% 15.2 wrong: subscribes with another message type | hint: The node does not subscribe to customer_seen with the right type
replace("import Bool", "import Int32 as Bool")

# %% 15.3 right: uses a condition, and stores the time of the newest message
solution()
# %% 15.3 right: uses a loop, and stores the newest message with its time
'''%%writefile src/my_cashier/scripts/customer_detector.py
#!/usr/bin/env python3
import rospy
from course_pkg.srv import AwaitCustomer, AwaitCustomerResponse
from std_msgs.msg import Bool

newest = (False, 0.0)


def callback(message):
    global newest
    newest = (message.data, rospy.get_time())


def look():
    """Return True or False, or None without a message in the last second."""
    customer, arrived = newest
    return customer if rospy.get_time() - arrived <= 1.0 else None


def handle(req):
    if req.patience != req.patience or req.patience < 0 or req.patience > 60:
        raise rospy.ServiceException("illegal patience")
    end = rospy.get_time() + req.patience
    while True:
        seen = look()
        if seen or rospy.get_time() >= end:
            break
        rospy.sleep(0.02)
    if seen is None:
        raise rospy.ServiceException("no message from the camera")
    return AwaitCustomerResponse(seen)


def main():
    rospy.init_node("customer_detector")
    rospy.Subscriber("customer_seen", Bool, callback, queue_size=1)
    rospy.Service("detect_customer", AwaitCustomer, handle)
    rospy.spin()


if __name__ == "__main__":
    main()
'''

# %% 15.3 wrong: uses the detector of exercise 15.2 | hint: Without messages from the camera, the node does not know whether a customer is
replace("return time.monotonic() - self.arrived > 1.0", "return False")
# %% 15.3 wrong: uses an old message about a customer | hint: The handler used a message that is older than 1 s
replace("lambda: self.customer and not self.is_silent()", "lambda: self.customer")
# %% 15.3 wrong: refuses immediately without a new message | hint: The node refused the call too early
replace("        with self.changed:\n            found", "        if self.is_silent():\n            raise rospy.ServiceException('the camera is silent')\n        with self.changed:\n            found")
# %% 15.3 wrong: uses only messages that come during the call | hint: A message can also be valid if it
replace("        with self.changed:\n            found", "        began = time.monotonic()\n        with self.changed:\n            found")
replace("if not found and self.is_silent()", "if not found and self.arrived < began")
# %% 15.3 wrong: uses a message until the end of the call in which it comes | hint: A message came during the call, but it was older than 1 s at the end
replace("        with self.changed:\n            found", "        began = time.monotonic()\n        with self.changed:\n            found")
replace("if not found and self.is_silent()", "if not found and self.is_silent() and self.arrived < began")
# %% 15.3 wrong: uses messages for only 0.2 s | hint: The node did not use the last message
replace("self.arrived > 1.0", "self.arrived > 0.2")
# %% 15.3 wrong: omits the word "camera" in the error message | hint: The error message does not contain the word "camera"
replace('"the camera is silent"', '"nothing is known"')
# %% 15.3 wrong: refuses if the camera was silent at the beginning | hint: The camera stopped for some time, but new messages came before the end of
replace("        with self.changed:\n            found", "        silent = self.is_silent()\n        with self.changed:\n            found")
replace("            if not found and self.is_silent():", "            if silent:")

# %% 15.5 right: creates a new message
solution()

# %% 15.5 right: uses a class that changes the received message
'''%%writefile src/my_cashier/scripts/robot_cashier.py
#!/usr/bin/python3
import math
import rospy
from sensor_msgs.msg import JointState


class Cashier:
    def __init__(self):
        self.pub = rospy.Publisher("mirrored_joints", JointState, queue_size=1)
        self.sub = rospy.Subscriber("joint_states", JointState, self.mirror, queue_size=10)

    def mirror(self, msg):
        if len(msg.name) != len(msg.position):
            return
        if msg.velocity and len(msg.velocity) != len(msg.name):
            return
        if not all(map(math.isfinite, msg.position + msg.velocity)):
            return
        msg.position = tuple(-p for p in msg.position)
        msg.velocity = tuple(-v for v in msg.velocity)
        self.pub.publish(msg)


def main():
    rospy.init_node("robot_cashier")
    cashier = Cashier()
    rospy.spin()


if __name__ == "__main__":
    main()
'''

# %% 15.5 wrong: does not change the velocities | hint: ` is the same as in the joint state
replace("[-value for value in joints.velocity]", "joints.velocity")
# %% 15.5 wrong: publishes an empty list of velocities | hint: is empty in the mirror image, but not in the joint state
replace("                velocity=[-value for value in joints.velocity],\n", "")
# %% 15.5 wrong: makes all positions negative | hint: A negative number has to become a positive number
replace("[-value for value in joints.position]", "[-abs(value) for value in joints.position]")
# %% 15.5 wrong: reverses the positions | hint: Some numbers are wrong
replace("[-value for value in joints.position]", "[-value for value in reversed(joints.position)]")
# %% 15.5 wrong: uses a new header | hint: The time stamp of a mirror image is different from the time stamp of the
replace("                header=joints.header,\n", "")
# %% 15.5 wrong: changes the frame_id of the header | hint: Copy the whole header:
replace("        mirrored.publish(", "        joints.header.frame_id = ''\n        mirrored.publish(")
# %% 15.5 wrong: omits the efforts | hint: ` of the mirror image is different from this field of the joint state
replace("                effort=joints.effort,\n", "")
# %% 15.5 wrong: accepts any number of positions | hint: The number of names is different from the number of positions
replace("len(joints.position) != count or ", "")
# %% 15.5 wrong: accepts any number of velocities | hint: The number of velocities has to be 0 or equal to the number of
replace(" or len(joints.velocity) not in (0, count)", "")
# %% 15.5 wrong: mirrors nan | hint: A position or velocity was nan or inf, which is not valid
replace("all(math.isfinite(value) for value in [*joints.position, *joints.velocity])", "True")
# %% 15.5 wrong: mirrors infinite positions | hint: A position or velocity was nan or inf, which is not valid
replace("all(math.isfinite(value) for value in [*joints.position, *joints.velocity])", "not any(map(math.isnan, joints.position)) and all(map(math.isfinite, joints.velocity))")
# %% 15.5 wrong: mirrors velocities that are nan | hint: A position or velocity was nan or inf, which is not valid
replace("all(math.isfinite(value) for value in [*joints.position, *joints.velocity])", "all(map(math.isfinite, joints.position)) and not any(map(math.isinf, joints.velocity))")
# %% 15.5 wrong: mirrors only the first six joints | hint: of the mirror image is too short
replace("[-value for value in joints.position]", "[-value for value in joints.position[:6]]")
# %% 15.5 wrong: publishes zeros for an invalid joint state | hint: The node published zeros for an invalid joint state, so the arm would move
replace("    if is_valid(joints):", "    if not is_valid(joints):\n        joints.position, joints.velocity = [0.0] * len(joints.name), []\n    if True:")
# %% 15.5 wrong: ignores joint states without velocities | hint: The node ignored a joint state without
replace("not in (0, count)", "!= count")
# %% 15.5 wrong: ignores joint states with infinite efforts | hint: The node ignored a joint state with an
replace("*joints.velocity]", "*joints.velocity, *joints.effort]")
# %% 15.5 wrong: checks the number of efforts | hint: The node ignored a joint state in which the number of
replace("len(joints.velocity) not in (0, count)", "len(joints.velocity) not in (0, count) or len(joints.effort) not in (0, count)")
# %% 15.5 wrong: checks only whether the sum is finite | hint: The node ignored a joint state with two positions of 1e308
replace("all(math.isfinite(value) for value in [*joints.position, *joints.velocity])", "math.isfinite(sum([*joints.position, *joints.velocity]))")
# %% 15.5 wrong: ignores a joint state without joints | hint: A joint state with 0 names and 0 positions is valid
replace("if len(joints.position) != count", "if not count or len(joints.position) != count")
# %% 15.5 wrong: publishes each mirror image twice | hint: Some mirror images arrived more than once
replace("        mirrored.publish(", "        mirrored.publish(JointState(joints.header, joints.name, [-p for p in joints.position], [-v for v in joints.velocity], joints.effort))\n        mirrored.publish(")
# %% 15.5 wrong: unregisters the subscriber after an invalid joint state | hint: After the first invalid joint state, the node published no more messages
replace("    if is_valid(joints):", "    if not is_valid(joints):\n        subscriber.unregister()\n    else:")
replace('    rospy.Subscriber("joint', '    subscriber = rospy.Subscriber("joint')
# %% 15.5 wrong: uses a loop with a pause | hint: Some mirror images are missing
replace('("robot_cashier")', '("robot_cashier")\n    rospy.Subscriber("joint_states", JointState, lambda joints: None)')
replace('rospy.Subscriber("joint_states", JointState, handle_joints)\n    rospy.spin()', """while not rospy.is_shutdown():
        handle_joints(rospy.wait_for_message("joint_states", JointState))
        rospy.sleep(0.1)""")
# %% 15.5 wrong: publishes 0.1 s too late | hint: The mirror images arrive late
replace("    if is_valid(joints):", "    rospy.sleep(0.1)\n    if is_valid(joints):")
# %% 15.5 wrong: unregisters the subscriber after thirty mirror images | hint: The node published some mirror images, and then published no more
replace("    if is_valid(joints):", "    global count\n    if is_valid(joints):\n        count += 1\n        if count > 30:\n            subscriber.unregister()\n            return")
replace("def is_valid", "count = 0\n\n\ndef is_valid")
replace('    rospy.Subscriber("joint', '    subscriber = rospy.Subscriber("joint')
# %% 15.5 wrong: publishes nothing | hint: No mirror image arrived. In the callback, publish
replace("    if is_valid(joints):", "    if joints is None:")
# %% 15.5 wrong: subscribes with another message type | hint: The node does not subscribe to joint_states with the right type
replace('''"joint_states", JointState, handle''', '''"joint_states", JointTrajectory, handle''')
replace("import math\n", "import math\n\nfrom std_msgs.msg import Header as JointTrajectory\n")

# %% 15.6 right: calls in the main thread
solution()

# %% 15.6 right: uses a class with a thread, and a single loop
'''%%writefile src/my_cashier/scripts/robot_cashier.py
#!/usr/bin/env python3
import math
import threading
import rospy
from course_pkg.srv import AwaitCustomer, AwaitCustomerRequest
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Cashier:
    def __init__(self):
        self.wait = float(rospy.get_param("~wait", 2.0))
        self.visit = False
        self.mirrored = rospy.Publisher("mirrored_joints", JointState, queue_size=5)
        self.greetings = rospy.Publisher("greetings", String, queue_size=5)
        rospy.Subscriber("joint_states", JointState, self.mirror)
        threading.Thread(target=self.work, daemon=True).start()

    def mirror(self, msg):
        n = len(msg.name)
        bad = [x for x in list(msg.position) + list(msg.velocity) if not math.isfinite(x)]
        if len(msg.position) == n and len(msg.velocity) in (0, n) and not bad:
            self.mirrored.publish(
                JointState(msg.header, msg.name, [-x for x in msg.position], [-x for x in msg.velocity], msg.effort)
            )

    def work(self):
        detect = rospy.ServiceProxy("detect_customer", AwaitCustomer)
        while not rospy.is_shutdown():
            try:
                found = detect(AwaitCustomerRequest(patience=0.0 if self.visit else self.wait)).found
            except rospy.ServiceException as e:
                rospy.logwarn(e)
                rospy.sleep(0.5)
                continue
            if found and not self.visit:
                self.greetings.publish(String("Good day!"))
            if self.visit and not found:
                self.reset()
            self.visit = found
            if found:
                rospy.sleep(0.2)

    def reset(self):
        try:
            rospy.ServiceProxy("till/reset", Trigger)()
        except rospy.ServiceException as e:
            rospy.logwarn(e)


def main():
    rospy.init_node("robot_cashier")
    Cashier()
    rospy.spin()


if __name__ == "__main__":
    main()
'''

# %% 15.6 wrong: only mirrors the joint states | hint: No call arrived
replace("while not rospy.is_shutdown():\n        if is_there(wait):\n            attend_visit()", "rospy.spin()")
# %% 15.6 wrong: makes no more calls after the first response | hint: The node called the service only once
replace("while not rospy … attend_visit()", "while is_there(wait) is None:\n        pass\n    rospy.spin()")
# %% 15.6 wrong: exits if the first call fails | hint: The node called a service that did not exist yet, and rospy.ServiceException ended the
replace('rospy.logwarn("detect_customer: %s", error)\n        rospy.sleep(0.5)\n        return None', "raise")
# %% 15.6 wrong: exits after a refused call | hint: The node made no call after a failed call
replace("    while not rospy.is_shutdown():\n        if is_there", "    rospy.wait_for_service('detect_customer')\n    while not rospy.is_shutdown():\n        if is_there")
replace('        rospy.logwarn("detect_customer: %s", error)\n        rospy.sleep(0.5)\n        return None', "        raise")
# %% 15.6 wrong: uses a persistent connection, and creates it only once | hint: remove this argument
replace('"detect_customer", AwaitCustomer', '"detect_customer", AwaitCustomer, persistent=True')
# %% 15.6 wrong: exits if a reset fails | hint: A call of till/reset failed, and the node then stopped calling detect_customer
replace('''        rospy.logwarn("till/reset: %s", error)''', '''        raise''')
# %% 15.6 wrong: uses another default value | hint: Use rospy.get_param("~wait", 2.0)
replace('"~wait", 2.0', '"~wait", 5.0')
# %% 15.6 wrong: uses a fixed patience | hint: The field `patience` has a wrong value
replace('rospy.get_param("~wait", 2.0)', '2.0')
# %% 15.6 wrong: waits for the next customer although a customer is there | hint: In the last response, `found` was True, so a customer is there
replace("    there = True\n", "    there = False\n")
# %% 15.6 wrong: ends a visit after a refused call | hint: A failed call does not end a visit
replace("while there is not False and", "while there and")
# %% 15.6 wrong: calls again with patience 0 after a visit | hint: In the last response, `found` was False, so no customer is there
replace("there = is_there(0)", "there = is_there(0)\n    is_there(0)")
# %% 15.6 wrong: does not pause during a visit | hint: wait 0.2 s between two calls
replace("        if there:\n            rospy.sleep(0.2)\n", "")
# %% 15.6 wrong: pauses for 1 s during a visit | hint: wait only 0.2 s between two calls, and not longer
replace("rospy.sleep(0.2)", "rospy.sleep(1.0)")
# %% 15.6 wrong: does not pause after a refusal | hint: The node made the next call immediately after a failed call
replace("        rospy.sleep(0.5)\n", "")
# %% 15.6 wrong: pauses for 3 s after a refusal | hint: the next call came too late
replace("rospy.sleep(0.5)", "rospy.sleep(3)")
# %% 15.6 wrong: makes another call before the response arrives | hint: The node made a second call before it got the first response
replace("import math", "import math\nimport threading")
replace("return detect(patience).found", """results = []
        thread = threading.Thread(target=lambda: results.append(detect(patience).found), daemon=True)
        thread.start()
        thread.join(0.8)
        return results[0] if results else False""")
# %% 15.6 wrong: publishes no greeting | hint: A customer came, but the node sent no greeting
replace('    greetings.publish("Good day!")\n', "")
# %% 15.6 wrong: publishes several greetings in a visit | hint: The node published more than one greeting in a visit
replace("        there = is_there(0)\n", "        there = is_there(0)\n        if there:\n            greetings.publish('Good day!')\n")
# %% 15.6 wrong: greets the customer at the end of the visit | hint: The greeting came at the end of the visit
replace('    greetings.publish("Good day!")\n', "")
replace("    try:\n        reset()", '    greetings.publish("Good day!")\n    try:\n        reset()')
# %% 15.6 wrong: mirrors invalid joint states | hint: A mirror image is wrong, or it belongs to an invalid joint state
replace("    if is_valid(joints):", "    if joints is not None:")
# %% 15.6 wrong: uses the whole response as a truth value | hint: `found` was False, but the node acted as if a customer was there
replace("return detect(patience).found", "return bool(detect(patience))")
# %% 15.6 wrong: publishes another greeting | hint: The text of the greeting is wrong
replace("Good day!", "Hello")
# %% 15.6 wrong: does not call till/reset | hint: The visit is over, but the node did not call till/reset
replace("        reset()\n", "        pass\n")
# %% 15.6 wrong: calls till/reset at the beginning of a visit | hint: The node called till/reset before the visit had ended
replace("""    try:
        reset()
    except rospy.ServiceException as error:
        rospy.logwarn("till/reset: %s", error)
""", "")
replace('    there = True\n', """    there = True
    try:
        reset()
    except rospy.ServiceException:
        pass
""")
# %% 15.6 wrong: waits for the service till/reset without a limit | hint: The service till/reset does not exist, and the node stopped calling detect_customer
replace("        reset()\n", '        rospy.wait_for_service("till/reset")\n        reset()\n')
# %% 15.6 wrong: calls till/reset before and after a visit | hint: The node called till/reset more than once after a visit
replace('    greetings.publish("Good day!")\n', '    greetings.publish("Good day!")\n    try:\n        reset()\n    except rospy.ServiceException:\n        pass\n')
# %% 15.6 wrong: mirrors nothing during a visit | hint: During a visit, the node published no mirror images
replace("def is_valid", "visiting = False\n\n\ndef is_valid")
replace("    if is_valid(joints):", "    if is_valid(joints) and not visiting:")
replace('    greetings.publish("Good day!")\n', '    global visiting\n    visiting = True\n    greetings.publish("Good day!")\n')
replace("    try:\n        reset()\n", "    visiting = False\n    try:\n        reset()\n")
# %% 15.6 wrong: calls the service in the callback | hint: The node publishes no mirror image while it waits for the
replace("handle_joints(joints):", "handle_joints(joints):\n    if is_there(wait):\n        attend_visit()")
replace("while not rospy.is_shutdown():\n        if is_there(wait):\n            attend_visit()", "rospy.spin()")

# %% 15.4 right: uses sys.exit with the error message
solution()
# %% 15.4 right: uses two functions, and an exit status
replace("import sys … AwaitCustomer", '"""Is there a customer?"""\nimport sys\nimport rospy\nimport course_pkg.srv')
replace('def main() … else "nobody")', """def ask(wait):
    rospy.wait_for_service("detect_customer", 3.0)
    detect = rospy.ServiceProxy("detect_customer", course_pkg.srv.AwaitCustomer)
    return detect(patience=wait).found""")
replace("main()", """rospy.init_node("ask_customer")
    try:
        found = ask(float(rospy.get_param("~wait", default=2)))
    except rospy.ROSException as e:
        print("no detector:", e, file=sys.stderr)
        sys.exit(1)
    except rospy.ServiceException as e:
        print("refused:", e, file=sys.stderr)
        sys.exit(1)
    if found:
        print("customer")
    else:
        print("nobody")""")
# %% 15.4 wrong: does not wait for the service | hint: The service started 1 s after the program, but the program had
replace('        rospy.wait_for_service("detect_customer", timeout=3)\n', "")
# %% 15.4 wrong: uses a fixed patience | hint: The field `patience` has a wrong value
replace('rospy.get_param("~wait", 2.0)', "2.0")
# %% 15.4 wrong: sends only the whole part of the parameter | hint: but `patience` was a whole number
replace('rospy.get_param("~wait", 2.0)', 'int(rospy.get_param("~wait", 2.0))')
# %% 15.4 wrong: uses another default value | hint: The second argument of rospy.get_param is this default value
replace('"~wait", 2.0', '"~wait", 5.0')
# %% 15.4 wrong: calls the service twice | hint: The program called the service more than once
replace('AwaitCustomer)(patience)', 'AwaitCustomer)(patience)\n        response = rospy.ServiceProxy("detect_customer", AwaitCustomer)(patience)')
# %% 15.4 wrong: calls again after a refusal | hint: The service refused the call, and the program called the service again
replace("\n\ndef main():", """

def ask(patience):
    detect = rospy.ServiceProxy("detect_customer", AwaitCustomer)
    try:
        return detect(patience)
    except rospy.ServiceException:
        rospy.sleep(0.5)
        return detect(patience)


def main():""")
replace('rospy.ServiceProxy("detect_customer", AwaitCustomer)(patience)', "ask(patience)")
# %% 15.4 wrong: does not call the service | hint: The program did not call the service
replace('rospy.ServiceProxy("detect_customer", AwaitCustomer)(patience)', 'rospy.ServiceProxy("detect_customer", AwaitCustomer)')
replace('response.found', 'patience')
# %% 15.4 wrong: calls spin at the end | hint: The program called the service, but the program did not end
replace('else "nobody")', 'else "nobody")\n    rospy.spin()')
# %% 15.4 wrong: prints nothing | hint: The program printed nothing
replace('print("customer" if', '("customer" if')
# %% 15.4 wrong: uses the whole response as a truth value | hint: `found` was False, but the program printed "customer"
replace("if response.found", "if response")
# %% 15.4 wrong: prints the response | hint: The program printed a wrong line
replace('"customer" if response.found else "nobody"', "response")
# %% 15.4 wrong: prints two lines | hint: The program printed more than one line
replace('    print("customer"', '    print("The detector says:")\n    print("customer"')
# %% 15.4 wrong: exits with an error status if there is no customer | hint: "nobody" is a valid result, so the exit status has to be 0
replace('else "nobody")', 'else "nobody")\n    sys.exit(0 if response.found else 3)')
# %% 15.4 wrong: does not catch a refusal | hint: A refused call raises rospy.ServiceException
replace("(rospy.ROSException, rospy.ServiceException)", "rospy.ROSException")
# %% 15.4 wrong: omits the reason in the error message | hint: The output does not contain the reason for the failure
replace("sys.exit(str(error))", 'sys.exit("failed")')
# %% 15.4 wrong: prints only a part of the error message | hint: The text of this rospy.ServiceException differs from the text of a refusal
replace("sys.exit(str(error))", 'text = str(error)\n        sys.exit(text if isinstance(error, rospy.ROSException) and "timeout" in text else text.split("request: ")[1])')
# %% 15.4 wrong: exits with status 0 after a refusal | hint: The call failed, so the exit status has to be 1
replace("sys.exit(str(error))", "print(error)\n        return")
# %% 15.4 wrong: waits without a limit | hint: The service does not exist, and the program waited for more than 3 s
replace(", timeout=3)", ")")
# %% 15.4 wrong: waits for five seconds | hint: The service does not exist, and the program waited for more than 3 s
replace("timeout=3", "timeout=5")
# %% 15.4 wrong: does not catch the timeout | hint: After its timeout, rospy.wait_for_service raises rospy.ROSException
replace("(rospy.ROSException, rospy.ServiceException)", "rospy.ServiceException")
# %% 15.4 wrong: prints nothing if there is no service | hint: The service does not exist, and the program ended without a message
based_on("uses two functions, and an exit status")
replace('        print("no detector:", e, file=sys.stderr)\n', "")

# %% 15.7 right: uses a dict
solution()
# %% 15.7 right: uses a class that stores the total
replace("from course_pkg … cents by item", "from course_pkg.srv import TillSet, TillSetResponse, TillTotal, TillTotalResponse")
replace("def handle_set … .values())", """class Till(object):
    def __init__(self):
        self.items = dict()
        self.total = 0
        rospy.Service("till/set", TillSet, self.set)
        rospy.Service("till/total", TillTotal, self.get_total)

    def set(self, req):
        if req.item == "" or req.cents < 0:
            raise rospy.ServiceException("'%s' for %d cents is impossible" % (req.item, req.cents))
        self.total += req.cents - self.items.get(req.item, 0)
        self.items[req.item] = req.cents
        return TillSetResponse(total=self.total)

    def get_total(self, req):
        res = TillTotalResponse()
        res.cents = self.total
        res.items = len(self.items)
        return res""")
replace("""def handle_total(request):
    return sum(prices.values()), len(prices)""", 'def main():\n    rospy.init_node("till")\n    till = Till()\n    rospy.spin()')
replace("""rospy.init_node("till")
    rospy.Service("till/set", TillSet, handle_set)
    rospy.Service("till/total", TillTotal, handle_total)
    rospy.spin()""", "main()")
# %% 15.7 wrong: returns the price of the item instead of the total | hint: The total is wrong
replace("    return sum(prices.values())\n", "    return request.cents\n")
# %% 15.7 wrong: adds the old and the new price of an item | hint: The total contains the old price and the new price of an item
based_on("uses a class that stores the total")
replace(" - self.items.get(req.item, 0)", "")
# %% 15.7 wrong: does not count items that cost 0 cents | hint: An item that costs 0 cents is missing
replace("sum(prices.values()), len(prices)", "sum(prices.values()), len([p for p in prices.values() if p])")
# %% 15.7 wrong: counts the calls instead of the items | hint: The field `items` is wrong
based_on("uses a class that stores the total")
replace("        self.items[req.item] =", "        self.calls = getattr(self, 'calls', 0) + 1\n        self.items[req.item] =")
replace("len(self.items)", "getattr(self, 'calls', 0)")
# %% 15.7 wrong: returns the largest price as the total | hint: The field `cents` of till/total is wrong
replace("sum(prices.values()), len(prices)", "max(prices.values(), default=0), len(prices)")
# %% 15.7 wrong: accepts negative prices | hint: The till accepted negative cents
replace("request.cents < 0", "False")
# %% 15.7 wrong: omits the cents in the error message | hint: The error message is not complete
replace('f"{request.item}: {request.cents} cents are negative"', '"an item cannot be negative"')
# %% 15.7 wrong: accepts an empty name | hint: The till accepted an item with an empty name
replace("if not request.item:", "if False:")
# %% 15.7 wrong: stores an item before it refuses the call | hint: The till refused the call, but the stored items have changed
replace('    if not request.item:', '    prices[request.item] = request.cents\n    if not request.item:')
# %% 15.7 wrong: removes the old price before it refuses negative cents | hint: The till refused the call, but the stored items have changed
replace("    if request.cents < 0:", "    prices.pop(request.item, None)\n    if request.cents < 0:")
# %% 15.7 wrong: limits a price to 32 bits | hint: The till returned a wrong sum when the sum was above 2147483647
replace("    prices[request.item] = request.cents\n", "    prices[request.item] = min(request.cents, 2**31 - 1)\n")
# %% 15.7 wrong: converts the names to small letters | hint: The items milk and MILK are two different items
replace("prices[request.item]", "prices[request.item.lower()]")
# %% 15.7 wrong: refuses a price of 0 cents | hint: The till refused a valid item
replace("request.cents < 0", "request.cents <= 0")
# %% 15.7 wrong: refuses each name that does not consist of letters | hint: The till refused a valid item
replace("if not request.item:", "if not request.item.isalpha():")
# %% 15.7 wrong: raises a ValueError | hint: The handler raised an error that is not a rospy.ServiceException
replace("raise rospy.ServiceException(f", "raise ValueError(f")

# %% 15.8 right: holds one lock while it prints and stores
solution()
# %% 15.8 right: uses acquire and release, and catches the error
replace("\nimport rospy … and counted", """import rospy
from course_pkg.srv import PrintLine, TillSet, TillSetResponse, TillTotal, TillTotalResponse""")
replace("def handle_set … len(prices)", """class Till:
    def __init__(self):
        self.items = {}
        self.lock = threading.Lock()
        self.printer = rospy.ServiceProxy("print_line", PrintLine)
        rospy.Service("till/set", TillSet, self.set)
        rospy.Service("till/total", TillTotal, self.total)

    def set(self, req):
        if len(req.item) == 0 or req.cents < 0:
            raise rospy.ServiceException("%s %d?" % (req.item, req.cents))
        self.lock.acquire()
        try:
            rospy.wait_for_service("print_line", timeout=1)
            self.printer(req.item + " " + str(req.cents))
            self.items[req.item] = req.cents
            return TillSetResponse(sum(self.items.values()))
        except (rospy.ServiceException, rospy.ROSException) as e:
            raise rospy.ServiceException("not printed: " + str(e))
        finally:
            self.lock.release()

    def total(self, req):
        return TillTotalResponse(sum(self.items.values()), len(self.items))""")
replace("print_line = rospy … handle_total)", "Till()")
# %% 15.8 wrong: prints nothing | hint: The till printed nothing
replace('        print_line(f"{request.item} {request.cents}")\n', "")
# %% 15.8 wrong: prints another line | hint: The printed line is wrong
replace('"{request.item} {request.cents}"', '"{request.item}: {request.cents}"')
# %% 15.8 wrong: hides the printer's refusal | hint: The printer refused the line, but the till accepted the item
replace('        print_line(f"{request.item} {request.cents}")\n', '''        try:
            print_line(f"{request.item} {request.cents}")
        except rospy.ServiceException as error:
            rospy.logwarn(error)
''')
# %% 15.8 wrong: omits the printer's error message | hint: The error message does not contain the printer's message
based_on("uses acquire and release, and catches the error")
replace('"not printed: " + str(e)', '"not printed"')
# %% 15.8 wrong: stores the price before it prints the line | hint: The line was not printed, but the till changed its stored prices
based_on("prints nothing")
replace("= request.cents", '= request.cents\n        print_line(f"{request.item} {request.cents}")')
# %% 15.8 wrong: waits for the printer without a limit | hint: The service print_line does not
replace("        print_line(f", "        rospy.wait_for_service('print_line')\n        print_line(f")
# %% 15.8 wrong: prints a refused line again | hint: The till called print_line again after the printer had refused
replace('        print_line(f"{request.item} {request.cents}")\n', """        try:
            print_line(f"{request.item} {request.cents}")
        except rospy.ServiceException:
            print_line(f"{request.item} {request.cents}")
""")
# %% 15.8 wrong: prints no line if the price is unchanged | hint: Print exactly one line in each call of till/set
replace("        print_line(", "        if prices.get(request.item) != request.cents:\n            print_line(")
# %% 15.8 wrong: prints a line for a refused item | hint: The till printed a line for a refused item
replace('    if not request.item:', '    print_line(f"{request.item} {request.cents}")\n    if not request.item:')
replace('        print_line(f"{request.item} {request.cents}")\n        prices', '        prices')
# %% 15.8 wrong: uses no lock | hint: The printer got two lines at the same time
replace("    with turn:\n        print_line", "    if True:\n        print_line")
# %% 15.8 wrong: repeats until the printer is free | hint: The printer refused a line, because it was still printing another line
based_on("hides the printer's refusal")
replace("""raise rospy.ServiceException(f"{request.item}: {request.cents} cents are negative")
    with turn:""", 'raise rospy.ServiceException(f"{request.item}: {request.cents} cents are negative")\n    for attempt in range(200):')
replace('(f"{request.item} {request.cents}")', '(f"{request.item} {request.cents}")\n            break')
replace("rospy.logwarn(error)", 'if "jam" not in str(error):\n                raise\n            rospy.sleep(0.01)\n    with turn:')
# %% 15.8 wrong: releases the lock before it calculates the sum | hint: A total is not the sum of the prices that were printed
replace("""prices[request.item] = request.cents
        return sum(prices.values())""", "prices[request.item] = request.cents\n    rospy.sleep(0.2)\n    return sum(prices.values())")
# %% 15.8 wrong: does not release the lock after a refused call, and also locks the total | hint: After a refused call, the next call got no response
based_on("prints nothing")
replace("with turn:\n        prices[request.item] = request.cents\n        return sum(prices.values())", """turn.acquire()
    print_line(f"{request.item} {request.cents}")
    prices[request.item] = request.cents
    total = sum(prices.values())
    turn.release()
    return total""")
# %% 15.8 wrong: does not release the lock after a refused call | hint: After a refused call, the next call got no response
based_on("does not release the lock after a refused call, and also locks the total")
replace("\n    with turn:\n        return sum(prices.values()), len(prices)", "\n    return sum(prices.values()), len(prices)")
# %% 15.8 wrong: repeats a refused line without a limit | hint: The till called print_line again after the printer had refused
replace('        print_line(f"{request.item} {request.cents}")\n', """        while True:
            try:
                print_line(f"{request.item} {request.cents}")
                break
            except rospy.ServiceException:
                rospy.sleep(0.05)
""")
# %% 15.8 wrong: uses a persistent connection to the printer | hint: The printer was started again, but the till still refuses
replace('("print_line", PrintLine)', '("print_line", PrintLine, persistent=True)')
# %% 15.8 wrong: refuses every item | hint: The till refused an item although the printer works
replace('        print_line(f"{request.item} {request.cents}")\n', '        raise rospy.ServiceException("print_line is unavailable")\n')

# %% 15.9 right: clears the dict
solution()
# %% 15.9 right: uses a class and a response object
replace("threading\n", "threading")
replace("\n\nprices = {}  # cents by item\nturn = threading.Lock()  # held while a line is printed and counted", ", TriggerResponse")
replace('def handle_set … paid} cents"', """class Till:
    def __init__(self):
        self.items = {}
        self.lock = threading.RLock()
        self.printer = rospy.ServiceProxy("print_line", PrintLine)
        rospy.Service("till/set", TillSet, self.set)
        rospy.Service("till/total", TillTotal, lambda _: [self.sum(), len(self.items)])
        rospy.Service("till/reset", Trigger, self.reset)

    def sum(self):
        with self.lock:
            return sum(self.items.values())

    def set(self, req):
        if not req.item or req.cents < 0:
            raise rospy.ServiceException("%s for %d?" % (req.item, req.cents))
        with self.lock:
            self.printer(line="%s %d" % (req.item, req.cents))
            self.items[req.item] = req.cents
            return self.sum()

    def reset(self, _):
        response = TriggerResponse(success=True, message="already empty")
        with self.lock:
            if len(self.items) > 0:
                response.message = "paid %d cents" % self.sum()
            self.items = {}
        return response""")
replace("print_line = rospy … handle_reset)", "Till()")
# %% 15.9 wrong: returns success=False for an empty till | hint: The field `success` is False, but a reset always succeeds
replace('True, "already empty"', 'False, "already empty"')
# %% 15.9 wrong: prints the sum in a reset | hint: The field `success` is False, but a reset always succeeds
replace("        prices.clear()\n", '        prices.clear()\n        print_line(f"sum {paid}")\n')
# %% 15.9 wrong: returns another message | hint: The message is wrong
replace('f"paid {paid} cents"', 'f"{paid} cents paid"')
# %% 15.9 wrong: adds the prices of all printed lines | hint: The total contains the old price and the new price of an item
replace("prices = {}  # cents by item", "prices = {}  # cents by item\nprinted = []")
replace("        prices[request.item] =", "        printed.append(request.cents)\n        prices[request.item] =")
replace("paid = sum(prices.values())", "paid = sum(printed)\n        printed.clear()")
# %% 15.9 wrong: omits the message for an empty till | hint: The till has no items, so the message has to be "already empty"
replace('        if not prices:\n            return True, "already empty"\n', "")
# %% 15.9 wrong: has lost the test of the name | hint: The till accepted an item with an empty name
replace("if not request.item:", "if False:")
# %% 15.9 wrong: has lost the test of the cents | hint: The till accepted negative cents
replace("request.cents < 0", "False")
# %% 15.9 wrong: checks the sum instead of the items | hint: The till has an item that costs 0 cents, so it is not empty
replace("if not prices:", "if not sum(prices.values()):")
# %% 15.9 wrong: does not remove the items | hint: remove all items, and set a stored total to 0
replace("        prices.clear()\n", "")
# %% 15.9 wrong: calculates the sum before it acquires the lock | hint: but the sum does not contain this item
replace("handle_reset(request):", """handle_reset(request):
    if not prices:
        return True, "already empty"
    paid = sum(prices.values())""")
replace('\n        if not prices:\n            return True, "already empty"\n        paid = sum(prices.values())', "")
# %% 15.9 wrong: uses no lock in the reset | hint: The handler of till/reset did not wait until the line was printed
replace("def handle_reset(request):\n    with turn:", "def handle_reset(request):\n    if True:")
# %% 15.9 wrong: releases the lock before it stores the item | hint: and this item was in the till after the reset
replace("by item", "by item\npending = {}")
replace("\n        prices[request.item] = request.cents\n        return sum(prices.values())", """
        pending[request.item] = request.cents
    rospy.sleep(0.3)
    prices.update(pending)
    pending.clear()
    return sum(prices.values())""")
replace("= sum(prices.values())", "= sum({**prices, **pending}.values())")

# %% 15.10 right: uses a group
solution()

# %% 15.10 right: uses a condition for each node, and a global parameter
'''%%writefile src/my_cashier/launch/cashier.launch
<?xml version="1.0"?>
<launch>
  <arg name="hardware" default="True"/>
  <arg name="wait" default="2"/>
  <node if="$(arg hardware)" name="counter_camera" pkg="course_pkg" type="counter_camera" output="screen"/>
  <node if="$(arg hardware)" name="robot" pkg="course_pkg" type="robot"/>
  <node unless="$(eval not arg('hardware'))" name="receipt_printer" pkg="course_pkg" type="receipt_printer"/>
  <node name="till" pkg="my_cashier" type="till.py" output="screen" respawn="true"/>
  <param name="robot_cashier/wait" value="$(arg wait)"/>
  <node name="robot_cashier" pkg="my_cashier" type="robot_cashier.py" output="screen"/>
  <node name="customer_detector" pkg="my_cashier" type="customer_detector.py"/>
  <node name="vision" pkg="my_cashier" type="vision.py"/>
</launch>
'''

# %% 15.10 wrong: does not close a tag | hint: The file is not valid XML
replace('name="robot" />', 'name="robot" >')
# %% 15.10 wrong: gives an argument a fixed value | hint: An <arg> tag has the attribute "value", so a user cannot change the argument
replace('name="hardware" default=', 'name="hardware" value=')
# %% 15.10 wrong: does not declare an argument | hint: An argument is not declared
replace('  <arg name="hardware" default="true" />\n', "")
# %% 15.10 wrong: omits a default value | hint: The file does not work without arguments
replace('name="wait" default="2.0"', 'name="wait"')
# %% 15.10 wrong: uses a number as the condition | hint: The value of the attribute "if" has to be true or false
replace('if="$(arg hardware)"', 'if="$(arg wait)"')
# %% 15.10 wrong: uses an unknown substitution | hint: Type `roslaunch --nodes my_cashier cashier.launch` in the terminal, and read the output
replace('value="$(arg wait)"', 'value="$(value wait)"')
# %% 15.10 wrong: always starts the hardware's nodes | hint: With hardware:=false, counter_camera, robot and receipt_printer must not start
replace('<group if="$(arg hardware)">', "<group>")
# %% 15.10 wrong: uses unless instead of if | hint: If the user sets no argument, the nodes of the hardware have to start
replace('<group if=', "<group unless=")
# %% 15.10 wrong: omits the till | hint: Compare the names of the nodes with the names in the exercise
replace('  <node pkg="my_cashier" type="till.py" name="till" />\n', "")
# %% 15.10 wrong: starts an additional node | hint: which is not in the exercise
replace('</launch>', '  <node pkg="my_cashier" type="ask_customer.py" name="ask_customer" />\n</launch>')
# %% 15.10 wrong: starts the course's till | hint: A <node> tag starts the wrong program
replace('pkg="my_cashier" type="till.py"', 'pkg="course_pkg" type="till"')
# %% 15.10 wrong: starts another program with launch-prefix | hint: A <node> tag starts the wrong program
replace('type="till.py"', 'type="till.py" launch-prefix="rosrun course_pkg till"')
# %% 15.10 wrong: remaps a service of the till | hint: The file gives another name to a topic or service of a node
replace('name="till" />', 'name="till"><remap from="till/set" to="nobody" /></node>')
# %% 15.10 wrong: remaps a topic with the attribute args | hint: The file gives another name to a topic or service of a node
replace('name="vision" />', 'name="vision" args="customer_seen:=nobody" />')
# %% 15.10 wrong: sets the parameter use_sim_time | hint: The parameter /use_sim_time is true
replace('  <group', '  <param name="/use_sim_time" value="true" />\n  <group')
# %% 15.10 wrong: sets another master for a node | hint: The file sets ROS_MASTER_URI for a node
replace('name="till" />', 'name="till"><env name="ROS_MASTER_URI" value="http://cashier:11311" /></node>')
# %% 15.10 wrong: omits the parameter | hint: The node robot_cashier has no parameter "wait"
replace('    <param name="wait" value="$(arg wait)" />\n', "")
# %% 15.10 wrong: sets the parameter outside of the node | hint: The parameter "wait" does not belong to robot_cashier
replace('  <node pkg="my_cashier" type="vision.py"', '  <param name="wait" value="$(arg wait)" />\n  <node pkg="my_cashier" type="vision.py"')
replace('    <param name="wait" value="$(arg wait)" />\n  </node>', "  </node>")
# %% 15.10 wrong: sets the parameter with an absolute name | hint: In a namespace, the node robot_cashier does not get the parameter
replace('    <param name="wait" value="$(arg wait)" />\n  </node>', "  </node>")
replace('  <group', '  <param name="/robot_cashier/wait" value="$(arg wait)" />\n  <group')
# %% 15.10 wrong: sets the parameter to a string | hint: The value of the parameter "wait" is a string
replace('value="$(arg wait)"', 'value="$(arg wait)" type="str"')
# %% 15.10 wrong: uses another default value | hint: If the user sets no argument, the value of "wait" has to be 2 s
replace('default="2.0"', 'default="3.0"')
# %% 15.10 wrong: sets the parameter to a fixed value | hint: The parameter always has the same value, even if the user passes another value
replace('value="$(arg wait)"', 'value="2.0"')

# %% 15.11 right: sets respawn for four nodes
solution()

# %% 15.11 right: sets a respawn delay and output on the screen
'''%%writefile src/my_cashier/launch/cashier.launch
<launch>
  <arg name="hardware" default="true"/>
  <arg name="wait" default="2.0"/>
  <node if="$(arg hardware)" name="counter_camera" pkg="course_pkg" type="counter_camera" respawn="true"/>
  <node if="$(arg hardware)" name="robot" pkg="course_pkg" type="robot" respawn="true"/>
  <node if="$(arg hardware)" name="receipt_printer" pkg="course_pkg" type="receipt_printer" respawn="true"/>
  <node name="till" pkg="my_cashier" type="till.py" output="screen" respawn="true" respawn_delay="0.5"/>
  <node name="robot_cashier" pkg="my_cashier" type="robot_cashier.py" output="screen" respawn="true">
    <param name="wait" type="double" value="$(arg wait)"/>
  </node>
  <node name="customer_detector" pkg="my_cashier" type="customer_detector.py" respawn="true"/>
  <node name="vision" pkg="my_cashier" type="vision.py" respawn="true"/>
</launch>
'''

# %% 15.11 wrong: starts the course's till | hint: A <node> tag starts the wrong program
based_on("sets a respawn delay and output on the screen")
replace('pkg="my_cashier" type="till.py"', 'pkg="course_pkg" type="till"')
# %% 15.11 wrong: starts only the nodes that this check uses | hint: Without an argument, the file does not start all nodes of the hardware
replace('<group if="$(arg hardware)"> … </group>', "")
# %% 15.11 wrong: always starts the robot | hint: With hardware:=false, counter_camera, robot and receipt_printer must not start
based_on("sets a respawn delay and output on the screen")
replace('<node if="$(arg hardware)" name="robot"', '<node name="robot"')
# %% 15.11 wrong: sets the parameter wait to a fixed value | hint: The parameter always has the same value, even if the user passes another value
replace('value="$(arg wait)"', 'value="2.0"')
# %% 15.11 wrong: does not set respawn | hint: roslaunch did not start a node again
replace(' respawn="true"', "", times=4)
# %% 15.11 wrong: sets a respawn delay of 10 s | hint: The attribute respawn_delay makes roslaunch
replace('name="till" respawn="true"', 'name="till" respawn="true" respawn_delay="10"')
# %% 15.11 wrong: reports the process id of another process | hint: roslaunch did not start a node again
change_node("till", """import subprocess
from rospy.impl.masterslave import ROSHandler

decoy = subprocess.Popen(["sleep", "300"])


def get_pid(self, caller_id):
    global decoy
    decoy = decoy if decoy.poll() is None else subprocess.Popen(["sleep", "300"])
    return 1, "", decoy.pid


ROSHandler.getPid = get_pid""")
launch = package / "launch/cashier.launch"
launch.write_text(RESPAWNING.replace('name="till" respawn="true"', 'name="till"'))

# %% 15.11 wrong: sets no respawn for one node | hint: roslaunch did not start a node again
replace('name="till" respawn="true"', 'name="till"')
# %% 15.11 wrong: writes a file that is not valid XML | hint: roslaunch ended. Type
replace('name="robot" />', 'name="robot" >')
# %% 15.11 wrong: gives the name of a file that does not exist | hint: roslaunch does not find a program, or its file is not executable
replace('type="vision.py"', 'type="vison.py"')
# %% 15.11 wrong: does not start vision | hint: Go to the exercise in which you … Go to the exercise in which you
replace('  <node pkg="my_cashier" type="vision.py" name="vision" respawn="true" />\n', "")
# %% 15.11 wrong: gives a node another name | hint: Go to the exercise in which you wrote this node, and run the check of
replace('name="till"', 'name="cash_register"')

# %% 15.11 wrong: never sees a customer | hint: The frames show a customer, but detect_customer does not find a customer
change_node("vision", "vision.sees_customer = lambda frame: False")

# %% 15.11 wrong: publishes no greeting | hint: The detector finds the customer, but no greeting arrived
change_node("robot_cashier", "robot_cashier.RobotCashier.greet = lambda self, wait: self._over.wait()")

# %% 15.11 wrong: greets a customer repeatedly | hint: The node greeted one customer more than once
change_node("robot_cashier", """robot_cashier.RobotCashier._await_departure = lambda self: self._over.wait(0.3)
robot_cashier.RobotCashier._empty_till = lambda self: None""")

# %% 15.11 wrong: returns the largest price as the total | hint: After two calls of till/set at the same time, the total was not the
change_node("till", "till.Till.handle_total = lambda self, _: (max(self._cents.values(), default=0), len(self._cents))")

# %% 15.11 wrong: uses no lock in the till | hint: Two customers called till/set at the same time, and one call failed
change_node("till", """import contextlib

make = till.Till.__init__


def unlocked(self):
    make(self)
    self._turn = contextlib.nullcontext()


till.Till.__init__ = unlocked""")

# %% 15.11 wrong: hides the printer's refusal | hint: The printer refused a line, but till/set did not refuse the item
change_node("till", """class Proxy(till.BoundedProxy):
    def __call__(self, line):
        try:
            super().__call__(line)
        except Exception:
            pass


till.BoundedProxy = Proxy""")

# %% 15.11 wrong: accepts an item without a name | hint: The till accepted an item without a name
based_on("uses no lock in the till")
replace('change_node("till", """import contextlib\n\nmake = till.Till.__init__', 'change_node("till", """handle_set = till.Till.handle_set')
replace("def unlocked(self):\n    make(self)\n    self._turn = contextlib.nullcontext()", """def handle(self, request):
    request.item = request.item or "no name"
    return handle_set(self, request)""")
replace("__init__ = unlocked", "handle_set = handle")
# %% 15.11 wrong: counts a refused item | hint: A refused item changed the total
based_on("accepts an item without a name")
replace('request.item = request.item or "no name"\n    return handle_set(self, request)', """try:
        return handle_set(self, request)
    except till.rospy.ServiceException:
        self._cents["refused"] = 5
        raise""")

# %% 15.11 wrong: does not reset the till after a visit | hint: The customer has left, but the till still has items
change_node("robot_cashier", "robot_cashier.RobotCashier._empty_till = lambda self: None")

# %% 15.11 wrong: mirrors only a few joint states | hint: Joint states arrived all the time, but the node published only a few mirror
change_node("robot_cashier", """import random

mirror = robot_cashier.RobotCashier.mirror
robot_cashier.RobotCashier.mirror = lambda self, joints: random.random() < 0.05 and mirror(self, joints)""")

# %% 15.11 wrong: returns an old result without a camera | hint: No frame came for more than 1 s, but detect_customer accepted a call
change_node("customer_detector", "customer_detector.await_customer = lambda eye, patience: bool(eye._seen)")

# %% 15.11 wrong: refuses all calls after a pause of the camera | hint: New frames came after a pause, but detect_customer still refuses
based_on("uses no lock in the till")
replace('till", """import contextlib', 'customer_detector", """import time')
replace("make = till.Till.__init__", "import course_pkg.shop.watch as watch\n\nlook = watch.Eye.look")
replace("def unlocked(self):\n    make(self)\n    self._turn = contextlib.nullcontext()", """def once(self):
    if look(self) is None and self._last > 0:
        self.dead = True
    return None if hasattr(self, "dead") else look(self)""")
replace("till.Till.__init__ = unlocked", "watch.Eye.look = once")
# %% 15.11 wrong: publishes no greeting after a second start | hint: After all nodes were killed and started again, the next customer was not greeted
based_on("uses no lock in the till")
replace("change_node … Till.__init__", 'change_node("robot_cashier", """import os\n\ngreet = robot_cashier.RobotCashier.greet')
replace("def unlocked(self):\n    make(self)\n    self._turn = contextlib.nullcontext()", """def once(self, wait):
    if os.path.exists("started"):
        self._over.wait()
    open("started", "w").close()
    greet(self, wait)""")
replace("till.Till.__init__ = unlocked", "robot_cashier.RobotCashier.greet = once")

# %% 15.11 wrong: publishes nothing in vision | hint: The camera publishes frames, but no message arrives on customer_seen
change_node("vision", "vision.Vision.handle_frame = lambda self, frame: None")
