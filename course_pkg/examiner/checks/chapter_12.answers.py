"""What students answer in chapter 12; see answers.py for the form of this file."""

# %% before
import math
import threading
import time

import rospy
from course_pkg import join
from course_pkg.errors import CallTimeout, CameraSilent, PrinterFailed
from course_pkg.shop import OpenTill, Printer
from course_pkg.srv import AwaitCustomer, TillSet, TillTotal
from sensor_msgs.msg import Image, JointState
from std_srvs.srv import Trigger

node = join("chapter_12")

# %% 12.1 right: row by row
def sees_customer(frame):
    if frame.encoding != "mono8":
        raise ValueError(f"{frame.encoding} is not mono8")
    if frame.width == 0 or frame.height == 0 or frame.step < frame.width:
        raise ValueError("no points")
    if len(frame.data) != frame.height * frame.step:
        raise ValueError("the data do not fit")
    dark = 0
    for row in range(frame.height):
        points = frame.data[row * frame.step : row * frame.step + frame.width]
        dark += sum(point < 96 for point in points)
    return 10 * dark >= frame.width * frame.height

# %% 12.1 right: one condition, and slices
def sees_customer(frame):
    good = frame.encoding == "mono8" and 0 < frame.width <= frame.step and frame.height > 0
    if not good or len(frame.data) != frame.height * frame.step:
        raise ValueError("this is no frame")
    rows = [frame.data[start:][: frame.width] for start in range(0, len(frame.data), frame.step)]
    points = b"".join(bytes(row) for row in rows)
    return len([point for point in points if point < 96]) / len(points) >= 0.1

# %% 12.1 wrong: takes the filling for points | hint: A row has `step` bytes and only `width` points
def sees_customer(frame):
    if frame.encoding != "mono8" or not frame.data or len(frame.data) != frame.height * frame.step:
        raise ValueError("this is no frame")
    dark = sum(point < 96 for point in frame.data)
    return 10 * dark >= len(frame.data)

# %% 12.1 wrong: 96 counts as dark | hint: Darker than 96 is below 96
def sees_customer(frame):
    if frame.encoding != "mono8" or not frame.data or len(frame.data) != frame.height * frame.step:
        raise ValueError("this is no frame")
    dark = sum(point <= 96 for point in frame.data)
    return 10 * dark >= frame.width * frame.height

# %% 12.1 wrong: more than a tenth | hint: At least a tenth
def sees_customer(frame):
    if frame.encoding != "mono8" or not frame.data or len(frame.data) != frame.height * frame.step:
        raise ValueError("this is no frame")
    dark = sum(point < 96 for point in frame.data)
    return dark / len(frame.data) > 0.1

# %% 12.1 wrong: the average | hint: an average hides them
def sees_customer(frame):
    if frame.encoding != "mono8" or len(frame.data) != frame.height * frame.step:
        raise ValueError("this is no frame")
    return sum(frame.data) / len(frame.data) < 96

# %% 12.1 wrong: one dark point | hint: A dark point or two are noise
def sees_customer(frame):
    if frame.encoding != "mono8" or len(frame.data) != frame.height * frame.step:
        raise ValueError("this is no frame")
    return min(frame.data) < 96

# %% 12.1 wrong: believes every frame | hint: Bytes are missing
def sees_customer(frame):
    dark = 0
    for row in range(frame.height):
        dark += sum(point < 96 for point in frame.data[row * frame.step : row * frame.step + frame.width])
    return 10 * dark >= frame.width * frame.height

# %% 12.1 wrong: rows shorter than their points | hint: step is at least width
def sees_customer(frame):
    if frame.encoding != "mono8" or not frame.data or len(frame.data) != frame.height * frame.step:
        raise ValueError("the data do not fit")
    dark = 0
    for row in range(frame.height):
        dark += sum(point < 96 for point in frame.data[row * frame.step : row * frame.step + frame.width])
    return 10 * dark >= frame.width * frame.height

# %% 12.1 wrong: a broken frame shows nobody | hint: False is an answer, and says that nobody is there
def sees_customer(frame):
    if len(frame.data) != frame.height * frame.step:
        return False
    dark = 0
    for row in range(frame.height):
        dark += sum(point < 96 for point in frame.data[row * frame.step : row * frame.step + frame.width])
    return 10 * dark >= frame.width * frame.height

# %% 12.1 wrong: any encoding | hint: three bytes for each point
def sees_customer(frame):
    if len(frame.data) != frame.height * frame.step:
        raise ValueError("the data do not fit")
    dark = 0
    for row in range(frame.height):
        dark += sum(point < 96 for point in frame.data[row * frame.step : row * frame.step + frame.width])
    return 10 * dark >= frame.width * frame.height

# %% 12.1 wrong: nothing is a frame | hint: A frame of 0 by 0 points has its 0 bytes
def sees_customer(frame):
    if frame.encoding != "mono8" or len(frame.data) != frame.height * frame.step:
        raise ValueError("the data do not fit")
    dark = 0
    for row in range(frame.height):
        dark += sum(point < 96 for point in frame.data[row * frame.step : row * frame.step + frame.width])
    return 10 * dark >= frame.width * frame.height

# %% 12.1 wrong: at least so many bytes | hint: There are more bytes than rows have place for
def sees_customer(frame):
    if frame.encoding != "mono8" or len(frame.data) < frame.height * frame.step:
        raise ValueError("the data do not fit")
    dark = 0
    for row in range(frame.height):
        dark += sum(point < 96 for point in frame.data[row * frame.step : row * frame.step + frame.width])
    return 10 * dark >= frame.width * frame.height

# %% 12.1 wrong: returns how many | hint: The answer is True or False, and nothing else
def sees_customer(frame):
    if frame.encoding != "mono8" or len(frame.data) != frame.height * frame.step:
        raise ValueError("the data do not fit")
    return sum(point < 96 for point in frame.data)

# %% 12.1 wrong: refuses filling | hint: A row has `step` bytes and only `width` points
def sees_customer(frame):
    if frame.encoding != "mono8" or not frame.data or frame.step != frame.width or len(frame.data) != frame.height * frame.step:
        raise ValueError("malformed")
    return 10 * sum(point < 96 for point in frame.data) >= len(frame.data)

# %% 12.1 wrong: asserts | hint: That is an error of another type
def sees_customer(frame):
    assert frame.encoding == "mono8", "not mono8"
    assert frame.data and frame.width and frame.step >= frame.width and len(frame.data) == frame.height * frame.step, "bytes"
    dark = 0
    for row in range(frame.height):
        dark += sum(point < 96 for point in frame.data[row * frame.step : row * frame.step + frame.width])
    return 10 * dark >= frame.width * frame.height

# %% 12.1 wrong: says nothing | hint: Nobody learns what is wrong with the frame
def sees_customer(frame):
    if frame.encoding != "mono8" or not frame.width or not frame.height or frame.step < frame.width or len(frame.data) != frame.height * frame.step:
        raise ValueError
    dark = 0
    for row in range(frame.height):
        dark += sum(point < 96 for point in frame.data[row * frame.step : row * frame.step + frame.width])
    return 10 * dark >= frame.width * frame.height

# %% 12.1 wrong: bytes without points | hint: The frame has bytes, and all of them are filling
def sees_customer(frame):
    if frame.encoding != "mono8" or not frame.data or frame.step < frame.width or len(frame.data) != frame.height * frame.step:
        raise ValueError("malformed")
    dark = 0
    for row in range(frame.height):
        dark += sum(point < 96 for point in frame.data[row * frame.step : row * frame.step + frame.width])
    return 10 * dark >= frame.width * frame.height

# %% 12.2 right: with the time of the last good frame
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees = sees
        self.seen = None
        self.told = 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        try:
            seen = self.sees(frame)
        except ValueError:
            return
        with self.changed:
            self.seen, self.told = seen, time.monotonic()
            self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 right: a pair, and an end of its truth
class Eye:
    def __init__(self, sees):
        self.sees = sees
        self.changed = threading.Condition()
        self.newest = (None, float("-inf"))

    def start(self, topic):
        return rospy.Subscriber(topic, Image, callback=self.hear, queue_size=1, buff_size=2**20)

    def hear(self, frame):
        with self.changed:
            try:
                self.newest = (self.sees(frame), rospy.get_time() + 1)
                self.changed.notify_all()
            except ValueError as error:
                rospy.logdebug("left out: %s", error)

    def look(self):
        seen, until = self.newest
        if rospy.get_time() > until:
            return None
        return seen

# %% 12.2 right: the stamp of the frame
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees = sees
        self.last = None

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1, buff_size=1 << 22)

    def hear(self, frame):
        try:
            found = self.sees(frame)
        except ValueError as problem:
            rospy.logwarn_throttle(10, str(problem))
        else:
            with self.changed:
                self.last = (found, frame.header.stamp)
                self.changed.notify_all()

    def look(self):
        with self.changed:
            if self.last is None:
                return None
            found, stamp = self.last
            if rospy.Time.now() - stamp > rospy.Duration(1):
                return None
            return found

# %% 12.2 right: a worker looks at the newest
class Eye:
    def __init__(self, sees):
        self.sees = sees
        self.changed = threading.Condition()
        self.waiting = threading.Condition()
        self.frame = None
        self.known = None
        threading.Thread(target=self._work, daemon=True).start()

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear)

    def hear(self, frame):
        with self.waiting:
            self.frame = frame
            self.waiting.notify()

    def _work(self):
        while True:
            with self.waiting:
                while self.frame is None:
                    self.waiting.wait()
                frame, self.frame = self.frame, None
            try:
                seen = self.sees(frame)
            except ValueError:
                continue
            with self.changed:
                self.known = (time.time(), seen)
                self.changed.notify_all()

    def look(self):
        known = self.known
        if known and time.time() - known[0] < 1:
            return known[1]
        return None

# %% 12.2 wrong: once seen, always there | hint: Somebody was there, and has gone
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        try:
            seen = self.sees(frame)
        except ValueError:
            return
        with self.changed:
            self.seen = self.seen or seen
            self.told = time.monotonic()
            self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: begins with nobody | hint: Before the first frame nobody can tell
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen = sees, False

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        with self.changed:
            self.seen = self.sees(frame)
            self.changed.notify_all()

    def look(self):
        return self.seen

# %% 12.2 wrong: an error comes out of the callback | hint: a callback has nobody who catches it
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        with self.changed:
            self.seen, self.told = self.sees(frame), time.monotonic()
            self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: a broken frame shows nobody | hint: A malformed frame says nothing
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        with self.changed:
            try:
                self.seen = self.sees(frame)
            except ValueError:
                self.seen = False
            self.told = time.monotonic()
            self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: wakes nobody up | hint: the frame did not wake it
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        try:
            self.seen, self.told = self.sees(frame), time.monotonic()
        except ValueError:
            pass

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: notifies without holding | hint: A condition is held while it is notified
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        try:
            self.seen, self.told = self.sees(frame), time.monotonic()
        except ValueError:
            return
        self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: knowledge never grows old | hint: The last good frame was older than a second
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen = sees, None

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        try:
            seen = self.sees(frame)
        except ValueError:
            return
        with self.changed:
            self.seen = seen
            self.changed.notify_all()

    def look(self):
        return self.seen

# %% 12.2 wrong: a broken frame is fresh | hint: malformed ones that came since do not count
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        self.told = time.monotonic()
        try:
            seen = self.sees(frame)
        except ValueError:
            return
        with self.changed:
            self.seen = seen
            self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: works through all of them | hint: Of those that wait only the newest counts
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear)

    def hear(self, frame):
        try:
            seen = self.sees(frame)
        except ValueError:
            return
        with self.changed:
            self.seen, self.told = seen, time.monotonic()
            self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: keeps the subscriber to itself | hint: Return the rospy.Subscriber
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        self.subscriber = rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        try:
            seen = self.sees(frame)
        except ValueError:
            return
        with self.changed:
            self.seen, self.told = seen, time.monotonic()
            self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: wakes one | hint: notify() wakes one of those who wait
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        try:
            seen = self.sees(frame)
        except ValueError:
            return
        with self.changed:
            self.seen, self.told = seen, time.monotonic()
            self.changed.notify()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: wakes when it is another | hint: also one that shows the same
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        try:
            seen = self.sees(frame)
        except ValueError:
            return
        with self.changed:
            before, self.seen, self.told = self.seen, seen, time.monotonic()
            if seen != before:
                self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 1.0 else None

# %% 12.2 wrong: forgets too soon | hint: It counts for a whole second
class Eye:
    def __init__(self, sees):
        self.changed = threading.Condition()
        self.sees, self.seen, self.told = sees, None, 0.0

    def start(self, topic):
        return rospy.Subscriber(topic, Image, self.hear, queue_size=1)

    def hear(self, frame):
        try:
            seen = self.sees(frame)
        except ValueError:
            return
        with self.changed:
            self.seen, self.told = seen, time.monotonic()
            self.changed.notify_all()

    def look(self):
        return self.seen if time.monotonic() - self.told <= 0.1 else None

# %% 12.3 right: wait_for
def await_customer(eye, patience):
    with eye.changed:
        found = eye.changed.wait_for(eye.look, timeout=patience)
    if found is None:
        raise CameraSilent("the camera is silent")
    return found

# %% 12.3 right: a loop with one end
def await_customer(eye, patience):
    end = time.monotonic() + patience
    with eye.changed:
        while not (seen := eye.look()) and time.monotonic() < end:
            eye.changed.wait(end - time.monotonic())
    if seen is None:
        raise CameraSilent("nobody can tell")
    return seen

# %% 12.3 right: ten looks a second
def await_customer(eye, patience):
    end = time.monotonic() + patience
    while True:
        seen = eye.look()
        if seen:
            return True
        if time.monotonic() >= end:
            break
        time.sleep(min(0.1, max(0, end - time.monotonic())))
    if seen is None:
        raise CameraSilent("nobody can tell")
    return False

# %% 12.3 right: a thousand looks a second
def await_customer(eye, patience):
    begin = rospy.get_time()
    while rospy.get_time() - begin < patience:
        if eye.look():
            return True
        rospy.sleep(0.001)
    last = eye.look()
    if last is None:
        raise CameraSilent("no frame")
    return last

# %% 12.3 wrong: waits for ever | hint: It waits, and never gives up
def await_customer(eye, patience):
    with eye.changed:
        eye.changed.wait_for(eye.look)
    return True

# %% 12.3 wrong: sleeps, and looks then | hint: Look first, and wait only if nobody is
def await_customer(eye, patience):
    time.sleep(patience)
    seen = eye.look()
    if seen is None:
        raise CameraSilent("nobody can tell")
    return seen

# %% 12.3 wrong: only looks | hint: The answer was no before the time was over
def await_customer(eye, patience):
    seen = eye.look()
    if seen is None:
        raise CameraSilent("nobody can tell")
    return seen

# %% 12.3 wrong: takes any frame for a customer | hint: Each frame wakes up who waits
def await_customer(eye, patience):
    with eye.changed:
        if not eye.look():
            eye.changed.wait(patience)
        seen = eye.look()
    if seen is None:
        raise CameraSilent("nobody can tell")
    return seen

# %% 12.3 wrong: the time begins anew | hint: Its time begins anew with each frame
def await_customer(eye, patience):
    with eye.changed:
        while not eye.look():
            if not eye.changed.wait(patience):
                break
        seen = eye.look()
    if seen is None:
        raise CameraSilent("nobody can tell")
    return seen

# %% 12.3 wrong: a silent camera sees nobody | hint: False says that nobody is there
def await_customer(eye, patience):
    with eye.changed:
        return bool(eye.changed.wait_for(eye.look, timeout=patience))

# %% 12.3 wrong: gives up as soon as the camera is silent | hint: The camera came back in time
def await_customer(eye, patience):
    end = time.monotonic() + patience
    with eye.changed:
        while not (seen := eye.look()):
            if seen is None:
                raise CameraSilent("nobody can tell")
            if time.monotonic() >= end:
                return False
            eye.changed.wait(min(0.1, end - time.monotonic()))
    return True

# %% 12.3 wrong: keeps the processor busy | hint: A loop without a pause
def await_customer(eye, patience):
    end = time.monotonic() + patience
    seen = eye.look()
    while not seen and time.monotonic() < end:
        seen = eye.look()
    if seen is None:
        raise CameraSilent("nobody can tell")
    return seen

# %% 12.3 wrong: sleeps with the condition in its hands | hint: it holds `changed` while it sleeps
def await_customer(eye, patience):
    end = time.monotonic() + patience
    with eye.changed:
        while not eye.look() and time.monotonic() < end:
            time.sleep(0.05)
        seen = eye.look()
    if seen is None:
        raise CameraSilent("nobody can tell")
    return seen

# %% 12.3 wrong: no patience, no look | hint: With no patience at all there is still time for a look
def await_customer(eye, patience):
    end = time.monotonic() + patience
    seen = False
    while time.monotonic() < end:
        seen = eye.look()
        if seen:
            return True
        time.sleep(0.05)
    if seen is None:
        raise CameraSilent("nobody can tell")
    return False

# %% 12.3 wrong: one at a time | hint: Four asked at the same time
turn = threading.Lock()


def await_customer(eye, patience):
    if not turn.acquire(blocking=False):
        return False
    with turn_given_back(), eye.changed:
        found = eye.changed.wait_for(eye.look, timeout=patience)
    if found is None:
        raise CameraSilent("nobody can tell")
    return found


def turn_given_back():
    import contextlib

    stack = contextlib.ExitStack()
    stack.callback(turn.release)
    return stack

# %% 12.3 wrong: once silent, always silent | hint: The camera was silent for a while
def await_customer(eye, patience):
    end = time.monotonic() + patience
    silent = False
    with eye.changed:
        while True:
            seen = eye.look()
            if seen:
                return True
            silent = silent or seen is None
            if time.monotonic() >= end:
                break
            eye.changed.wait(max(0.0, end - time.monotonic()))
    if silent:
        raise CameraSilent("it was silent")
    return False

# %% 12.3 wrong: waits without holding | hint: A condition is held while one waits at it
def await_customer(eye, patience):
    found = eye.changed.wait_for(eye.look, timeout=patience)
    if found is None:
        raise CameraSilent("nobody can tell")
    return found

# %% 12.3 wrong: nobody is a silent camera | hint: the camera saw that nobody is there
def await_customer(eye, patience):
    with eye.changed:
        if not eye.changed.wait_for(eye.look, timeout=patience):
            raise CameraSilent("nobody can tell")
    return True

# %% 12.3 wrong: another error | hint: Whoever asks catches CameraSilent
def await_customer(eye, patience):
    with eye.changed:
        found = eye.changed.wait_for(eye.look, timeout=patience)
    if found is None:
        raise RuntimeError("nobody can tell")
    return found

# %% 12.4 right: looks first
def handle_detect(wait, request):
    if not 0 <= request.patience <= 60:
        raise rospy.ServiceException(f"patience is {request.patience}, and has to be from 0 to 60 s")
    try:
        return wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.4 right: in words of its own
def handle_detect(wait, request):
    patience = request.patience
    if math.isnan(patience) or patience < 0 or patience > 60:
        raise rospy.ServiceException("The patience cannot be that")
    try:
        found = wait(patience)
    except CameraSilent:
        raise rospy.ServiceException("no word from the camera") from None
    return {"found": found}

# %% 12.4 wrong: takes any patience | hint: A patience below 0 was taken
def handle_detect(wait, request):
    try:
        return wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.4 wrong: two comparisons that nan passes | hint: nan was taken
def handle_detect(wait, request):
    if request.patience < 0 or request.patience > 60:
        raise rospy.ServiceException("patience has to be from 0 to 60 s")
    try:
        return wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.4 wrong: no upper end | hint: More than 60 s were taken
def handle_detect(wait, request):
    if not request.patience >= 0:
        raise rospy.ServiceException("patience has to be from 0 to 60 s")
    try:
        return wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.4 wrong: answers no | hint: A refusal is raise rospy.ServiceException(words)
def handle_detect(wait, request):
    if not 0 <= request.patience <= 60:
        return False
    try:
        return wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.4 wrong: an error of another type | hint: An error of another type is a stumble
def handle_detect(wait, request):
    if not 0 <= request.patience <= 60:
        raise ValueError("patience has to be from 0 to 60 s")
    try:
        return wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.4 wrong: does not say what was wrong | hint: name the field, patience
def handle_detect(wait, request):
    if not 0 <= request.patience <= 60:
        raise rospy.ServiceException("invalid request")
    try:
        return wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.4 wrong: lets the camera's error out | hint: Catch CameraSilent
def handle_detect(wait, request):
    if not 0 <= request.patience <= 60:
        raise rospy.ServiceException("patience has to be from 0 to 60 s")
    return wait(request.patience)

# %% 12.4 wrong: no camera, nobody there | hint: No answer is not an answer of no
def handle_detect(wait, request):
    if not 0 <= request.patience <= 60:
        raise rospy.ServiceException("patience has to be from 0 to 60 s")
    try:
        return wait(request.patience)
    except CameraSilent:
        return False

# %% 12.4 wrong: one after the other | hint: One caller had to wait for another
turn = threading.Lock()


def handle_detect(wait, request):
    if not 0 <= request.patience <= 60:
        raise rospy.ServiceException("patience has to be from 0 to 60 s")
    with turn:
        try:
            return wait(request.patience)
        except CameraSilent as error:
            raise rospy.ServiceException(str(error))

# %% 12.4 wrong: hands on the request | hint: The handler came to its end without a return
def handle_detect(wait, request):
    if not 0 <= request.patience <= 60:
        raise rospy.ServiceException("patience has to be from 0 to 60 s")
    try:
        wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.4 wrong: refuses when the waiting is over | hint: It waited first, and refused then
def handle_detect(wait, request):
    try:
        found = wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))
    if not 0 <= request.patience <= 60:
        raise rospy.ServiceException("patience has to be from 0 to 60 s")
    return found

# %% 12.4 wrong: refuses 0 | hint: both 0 and 60 are among them
def handle_detect(wait, request):
    if not 0 < request.patience <= 60:
        raise rospy.ServiceException("patience has to be from 0 to 60 s")
    try:
        return wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.4 wrong: returns the words | hint: What is returned is an answer
def handle_detect(wait, request):
    if not 0 <= request.patience <= 60:
        return "patience has to be from 0 to 60 s"
    try:
        return wait(request.patience)
    except CameraSilent as error:
        raise rospy.ServiceException(str(error))

# %% 12.5 right: a callback
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        counts = {len(stance.position), len(stance.velocity) or len(stance.position)}
        if counts != {len(stance.name)} or not all(map(math.isfinite, [*stance.position, *stance.velocity])):
            return
        image = JointState(header=stance.header, name=stance.name)
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 right: an error for what is no stance
def turned(values, count):
    if len(values) != count or any(math.isnan(value) or math.isinf(value) for value in values):
        raise ValueError("this is no stance")
    return [-value for value in values]


def make_mirror(target):
    shown = node.advertise(target, JointState)

    def mirror(stance):
        count = len(stance.name)
        try:
            position = turned(stance.position, count)
            velocity = turned(stance.velocity, count) if stance.velocity else []
        except ValueError as error:
            rospy.logwarn_throttle(5, "left out: %s", error)
        else:
            shown.publish(JointState(stance.header, stance.name, position, velocity, []))

    return mirror

# %% 12.5 wrong: mirrors whatever comes | hint: There are not as many positions as names
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        image = JointState(header=stance.header, name=stance.name)
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 wrong: looks at lengths only | hint: nan and inf are no angles
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        if len(stance.position) != len(stance.name):
            return
        image = JointState(header=stance.header, name=stance.name)
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 wrong: zeros for a broken one | hint: Zeros are a stance, too
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        position, velocity = stance.position, stance.velocity
        if len(position) != len(stance.name) or not all(map(math.isfinite, [*position, *velocity])):
            position, velocity = [0.0] * len(stance.name), []
        image = JointState(header=stance.header, name=stance.name)
        image.position = [-value for value in position]
        image.velocity = [-value for value in velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 wrong: wants velocities | hint: A stance without velocities is a good one
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        good = len(stance.position) == len(stance.name) == len(stance.velocity)
        if not good or not all(map(math.isfinite, [*stance.position, *stance.velocity])):
            return
        image = JointState(header=stance.header, name=stance.name)
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 wrong: ends with the first broken one | hint: It ended with the first message that is no stance
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        if len(stance.position) != len(stance.name):
            publisher.unregister()
            return
        image = JointState(header=stance.header, name=stance.name)
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 wrong: a new header | hint: Hand the header on
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        counts = {len(stance.position), len(stance.velocity) or len(stance.position)}
        if counts != {len(stance.name)} or not all(map(math.isfinite, [*stance.position, *stance.velocity])):
            return
        image = JointState(name=stance.name)
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 wrong: the publisher in the callback | hint: Make the publisher there, not in the function
def make_mirror(target):
    def mirror(stance):
        publisher = rospy.Publisher(target, JointState, queue_size=10)
        counts = {len(stance.position), len(stance.velocity) or len(stance.position)}
        if counts != {len(stance.name)} or not all(map(math.isfinite, [*stance.position, *stance.velocity])):
            return
        image = JointState(header=stance.header, name=stance.name)
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 wrong: looks ten times a second | hint: a loop with a pause sees only some
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)
    newest = []

    def work():
        while not rospy.is_shutdown():
            time.sleep(0.1)
            if newest:
                stance = newest[-1]
                newest.clear()
                counts = {len(stance.position), len(stance.velocity) or len(stance.position)}
                if counts == {len(stance.name)} and all(map(math.isfinite, [*stance.position, *stance.velocity])):
                    image = JointState(header=stance.header, name=stance.name)
                    image.position = [-value for value in stance.position]
                    image.velocity = [-value for value in stance.velocity]
                    publisher.publish(image)

    threading.Thread(target=work, daemon=True).start()
    return newest.append

# %% 12.5 wrong: listens itself, and never comes back | hint: stances come later, when rospy calls it
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)
    rospy.Subscriber("/joint_states", JointState, publisher.publish)
    while not rospy.is_shutdown():
        time.sleep(0.1)

# %% 12.5 wrong: returns nothing | hint: Return the function
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        position = [-value for value in stance.position]
        publisher.publish(JointState(header=stance.header, name=stance.name, position=position))

# %% 12.5 wrong: only the positions | hint: The list is empty: velocity was left out
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        counts = {len(stance.position), len(stance.velocity) or len(stance.position)}
        if counts == {len(stance.name)} and all(map(math.isfinite, [*stance.position, *stance.velocity])):
            position = [-value for value in stance.position]
            publisher.publish(JointState(header=stance.header, name=stance.name, position=position))

    return mirror

# %% 12.5 wrong: more positions than names | hint: There are not as many positions as names
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        if len(stance.position) < len(stance.name) or len(stance.velocity) not in (0, len(stance.position)):
            return
        if not all(map(math.isfinite, [*stance.position, *stance.velocity])):
            return
        image = JointState(header=stance.header, name=stance.name)
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 wrong: any number of velocities | hint: There are velocities, and not as many as positions
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        if len(stance.position) != len(stance.name) or not all(map(math.isfinite, [*stance.position, *stance.velocity])):
            return
        image = JointState(header=stance.header, name=stance.name)
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.5 wrong: only the stamp | hint: Hand all of it on: header=stance.header
def make_mirror(target):
    publisher = rospy.Publisher(target, JointState, queue_size=10)

    def mirror(stance):
        counts = {len(stance.position), len(stance.velocity) or len(stance.position)}
        if counts != {len(stance.name)} or not all(map(math.isfinite, [*stance.position, *stance.velocity])):
            return
        image = JointState(name=stance.name)
        image.header.stamp = stance.header.stamp
        image.position = [-value for value in stance.position]
        image.velocity = [-value for value in stance.velocity]
        publisher.publish(image)

    return mirror

# %% 12.6 right: a thread that asks
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            try:
                if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                    greet()
            except (rospy.ServiceException, CallTimeout):
                over.wait(0.5)

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 right: a proxy, and a function for one question
def start_robot(stances, mirror, service, greet, over):
    detect = rospy.ServiceProxy(service, AwaitCustomer)

    def ask():
        try:
            return detect(2.0).found
        except rospy.ServiceException:
            time.sleep(0.5)
            return False

    def work():
        while not over.is_set():
            if ask():
                greet()

    subscriber = node.subscribe(stances, JointState, lambda stance: mirror(stance))
    threading.Thread(target=work, daemon=True, name="asking").start()
    return subscriber

# %% 12.6 wrong: asks before it comes back | hint: the asking goes on, so it needs a thread of its own
def start_robot(stances, mirror, service, greet, over):
    subscriber = rospy.Subscriber(stances, JointState, mirror)
    while not over.is_set():
        try:
            if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                greet()
        except (rospy.ServiceException, CallTimeout):
            over.wait(0.5)
    return subscriber

# %% 12.6 wrong: the thread is run, not started | hint: the asking goes on, so it needs a thread of its own
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                greet()

    threading.Thread(target=work()).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: asks in the callback | hint: asking is the work of another thread
def start_robot(stances, mirror, service, greet, over):
    def hear(stance):
        mirror(stance)
        try:
            if not over.is_set() and node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                greet()
        except (rospy.ServiceException, CallTimeout):
            over.wait(0.5)

    return rospy.Subscriber(stances, JointState, hear, queue_size=1)

# %% 12.6 wrong: one lock for both | hint: Don't ask and don't greet where they are handled
def start_robot(stances, mirror, service, greet, over):
    turn = threading.Lock()

    def hear(stance):
        with turn:
            mirror(stance)

    def work():
        while not over.is_set():
            with turn:
                try:
                    if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                        greet()
                except (rospy.ServiceException, CallTimeout):
                    over.wait(0.5)
            time.sleep(0.2)

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, hear)

# %% 12.6 wrong: forgets to start | hint: Start the thread
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                greet()

    worker = threading.Thread(target=work, daemon=True)
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: asks once | hint: Ask in a loop
def start_robot(stances, mirror, service, greet, over):
    def work():
        if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
            greet()

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: any answer is a customer | hint: look at its found
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            try:
                if node.call(service, AwaitCustomer, patience=2, timeout=4):
                    greet()
            except (rospy.ServiceException, CallTimeout):
                over.wait(0.5)

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: no patience | hint: The patience is 0
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            try:
                if node.call(service, AwaitCustomer, timeout=4).found:
                    greet()
            except (rospy.ServiceException, CallTimeout):
                over.wait(0.5)

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: ends with the first refusal | hint: the thread ended with a ServiceException
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                greet()

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: asks again at once | hint: Pause for half a second
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            try:
                if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                    greet()
            except (rospy.ServiceException, CallTimeout):
                continue

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: never ends | hint: Look at over.is_set()
def start_robot(stances, mirror, service, greet, over):
    def work():
        while True:
            try:
                if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                    greet()
            except (rospy.ServiceException, CallTimeout):
                time.sleep(0.5)

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: keeps the subscriber | hint: Return the rospy.Subscriber
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            try:
                if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                    greet()
            except (rospy.ServiceException, CallTimeout):
                over.wait(0.5)

    threading.Thread(target=work, daemon=True).start()
    rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: greets on another thread, and asks on | hint: call it on the thread that asks
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            try:
                if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                    threading.Thread(target=greet, daemon=True).start()
            except (rospy.ServiceException, CallTimeout):
                over.wait(0.5)

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: no CallTimeout | hint: node.call raises a CallTimeout then
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            try:
                if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                    greet()
            except rospy.ServiceException:
                over.wait(0.5)

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.6 wrong: pauses for five seconds | hint: half a second, and no longer
def start_robot(stances, mirror, service, greet, over):
    def work():
        while not over.is_set():
            try:
                if node.call(service, AwaitCustomer, patience=2, timeout=4).found:
                    greet()
            except (rospy.ServiceException, CallTimeout):
                over.wait(5)

    threading.Thread(target=work, daemon=True).start()
    return rospy.Subscriber(stances, JointState, mirror)

# %% 12.7 right: a dict
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if not request.item:
            raise rospy.ServiceException("an item needs a name")
        if request.cents < 0:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents are negative")
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 right: a sum that is kept
class Till:
    def __init__(self):
        self.turn = threading.Lock()
        self.prices = dict()
        self.sum = 0

    def handle_set(self, request):
        item, cents = request.item, request.cents
        if item == "" or cents < 0:
            raise rospy.ServiceException("%d cents for %r cannot be" % (cents, item))
        with self.turn:
            self.sum += cents - self.prices.get(item, 0)
            self.prices[item] = cents
            return {"total": self.sum}

    def handle_total(self, request):
        with self.turn:
            return {"cents": self.sum, "items": len(self.prices)}

# %% 12.7 wrong: adds each time | hint: The item was set twice with one price, and counts twice
class Till:
    def __init__(self):
        self.sum, self.count = 0, 0

    def handle_set(self, request):
        if request.cents < 0 or not request.item:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        self.sum += request.cents
        self.count += 1
        return self.sum

    def handle_total(self, request):
        return self.sum, self.count

# %% 12.7 wrong: answers with the price | hint: The answer is the sum of all of them
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if request.cents < 0 or not request.item:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        self.amounts[request.item] = request.cents
        return request.cents

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: the first price stays | hint: The old price stayed
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if request.cents < 0 or not request.item:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        self.amounts.setdefault(request.item, request.cents)
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: takes negative amounts | hint: A negative amount was taken
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: leaves negative amounts out | hint: the caller thinks that all is well
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if request.cents >= 0 and request.item:
            self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: an error of another type | hint: An error of another type is a stumble
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if request.cents < 0 or not request.item:
            raise ValueError(f"{request.item}: {request.cents} cents cannot be")
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: words that help nobody | hint: put the item and the amount into them
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if request.cents < 0 or not request.item:
            raise rospy.ServiceException("invalid amount")
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: notes first, and refuses then | hint: A request that is refused changes nothing
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        self.amounts[request.item] = request.cents
        if request.cents < 0 or not request.item:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: an item without a name | hint: a field that the caller forgot
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if request.cents < 0:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: items and cents | hint: The two are the wrong way round
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if request.cents < 0 or not request.item:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return len(self.amounts), sum(self.amounts.values())

# %% 12.7 wrong: what is free is no item | hint: a free one included
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if request.cents < 0 or not request.item:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        self.amounts[request.item] = request.cents
        if not request.cents:
            del self.amounts[request.item]
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: adds to what is not there | hint: An item that is set for the first time is in no dict yet
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if request.cents < 0 or not request.item:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        self.amounts[request.item] += request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: a dict in the class | hint: what stands in the class is shared by all of them
class Till:
    amounts = {}

    def handle_set(self, request):
        if not request.item or request.cents < 0:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.7 wrong: refuses what is free | hint: It refused what is good
class Till:
    def __init__(self):
        self.amounts = {}

    def handle_set(self, request):
        if not request.item or request.cents <= 0:
            raise rospy.ServiceException(f"{request.item}: {request.cents} cents cannot be")
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

    def handle_total(self, request):
        return sum(self.amounts.values()), len(self.amounts)

# %% 12.8 right: one lock around both
class PrintedTill:
    def __init__(self, printer):
        self.printer = printer
        self.turn = threading.Lock()
        self.amounts = {}

    def handle_set(self, request):
        with self.turn:
            try:
                self.printer.print(f"{request.item} {request.cents}")
            except PrinterFailed as error:
                raise rospy.ServiceException(str(error))
            self.amounts[request.item] = request.cents
            return sum(self.amounts.values())

# %% 12.8 right: takes the lock and gives it back
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts, self.lock = printer, {}, threading.RLock()

    def handle_set(self, request):
        self.lock.acquire()
        try:
            amounts = {**self.amounts, request.item: request.cents}
            self.printer.print("%s %d" % (request.item, request.cents))
            self.amounts = amounts
            return {"total": sum(amounts.values())}
        except PrinterFailed as error:
            raise rospy.ServiceException("not printed: %s" % error)
        finally:
            self.lock.release()

# %% 12.8 wrong: no lock | hint: Two lines were printed at the same time
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts = printer, {}

    def handle_set(self, request):
        try:
            self.printer.print(f"{request.item} {request.cents}")
        except PrinterFailed as error:
            raise rospy.ServiceException(str(error))
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

# %% 12.8 wrong: a lock for each call | hint: hold one lock, made in __init__
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts = printer, {}

    def handle_set(self, request):
        with threading.Lock():
            try:
                self.printer.print(f"{request.item} {request.cents}")
            except PrinterFailed as error:
                raise rospy.ServiceException(str(error))
            self.amounts[request.item] = request.cents
            return sum(self.amounts.values())

# %% 12.8 wrong: the lock is not given back | hint: The till never answers again
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts, self.turn = printer, {}, threading.Lock()

    def handle_set(self, request):
        self.turn.acquire()
        try:
            self.printer.print(f"{request.item} {request.cents}")
        except PrinterFailed as error:
            raise rospy.ServiceException(str(error))
        self.amounts[request.item] = request.cents
        total = sum(self.amounts.values())
        self.turn.release()
        return total

# %% 12.8 wrong: counts first | hint: Print first, and count then
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts, self.turn = printer, {}, threading.Lock()

    def handle_set(self, request):
        with self.turn:
            self.amounts[request.item] = request.cents
            try:
                self.printer.print(f"{request.item} {request.cents}")
            except PrinterFailed as error:
                raise rospy.ServiceException(str(error))
            return sum(self.amounts.values())

# %% 12.8 wrong: goes on without paper | hint: Nothing was printed, and it answered as if all were well
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts, self.turn = printer, {}, threading.Lock()

    def handle_set(self, request):
        with self.turn:
            try:
                self.printer.print(f"{request.item} {request.cents}")
            except PrinterFailed as error:
                rospy.logdebug(str(error))
            self.amounts[request.item] = request.cents
            return sum(self.amounts.values())

# %% 12.8 wrong: lets the printer's error out | hint: Catch PrinterFailed, and raise
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts, self.turn = printer, {}, threading.Lock()

    def handle_set(self, request):
        with self.turn:
            self.printer.print(f"{request.item} {request.cents}")
            self.amounts[request.item] = request.cents
            return sum(self.amounts.values())

# %% 12.8 wrong: does not say why | hint: hand on those of PrinterFailed
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts, self.turn = printer, {}, threading.Lock()

    def handle_set(self, request):
        with self.turn:
            try:
                self.printer.print(f"{request.item} {request.cents}")
            except PrinterFailed:
                raise rospy.ServiceException("this did not work")
            self.amounts[request.item] = request.cents
            return sum(self.amounts.values())

# %% 12.8 wrong: prints nothing | hint: Nothing was printed: self.printer.print
class PrintedTill:
    def __init__(self, printer):
        self.amounts, self.turn = {}, threading.Lock()

    def handle_set(self, request):
        with self.turn:
            self.amounts[request.item] = request.cents
            return sum(self.amounts.values())

# %% 12.8 wrong: another line | hint: The line is f"{item} {cents}"
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts, self.turn = printer, {}, threading.Lock()

    def handle_set(self, request):
        with self.turn:
            try:
                self.printer.print(f"{request.item}: {request.cents} cents")
            except PrinterFailed as error:
                raise rospy.ServiceException(str(error))
            self.amounts[request.item] = request.cents
            return sum(self.amounts.values())

# %% 12.8 wrong: reads before it is its turn | hint: one thread put back what it had read
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts, self.turn = printer, {}, threading.Lock()

    def handle_set(self, request):
        amounts = dict(self.amounts)
        with self.turn:
            try:
                self.printer.print(f"{request.item} {request.cents}")
            except PrinterFailed as error:
                raise rospy.ServiceException(str(error))
            amounts[request.item] = request.cents
            self.amounts = amounts
        return sum(self.amounts.values())

# %% 12.8 wrong: takes the item out when it fails | hint: not the old price either
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts, self.turn = printer, {}, threading.Lock()

    def handle_set(self, request):
        with self.turn:
            self.amounts[request.item] = request.cents
            try:
                self.printer.print(f"{request.item} {request.cents}")
            except PrinterFailed as error:
                del self.amounts[request.item]
                raise rospy.ServiceException(str(error))
            return sum(self.amounts.values())

# %% 12.8 wrong: tries until it is printed | hint: It tries again and again
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.amounts = printer, {}

    def handle_set(self, request):
        while True:
            try:
                self.printer.print(f"{request.item} {request.cents}")
                break
            except PrinterFailed:
                time.sleep(0.01)
        self.amounts[request.item] = request.cents
        return sum(self.amounts.values())

# %% 12.8 wrong: counts only what is new | hint: An item that was set again is in the sum twice
class PrintedTill:
    def __init__(self, printer):
        self.printer, self.sum, self.turn = printer, 0, threading.Lock()

    def handle_set(self, request):
        with self.turn:
            try:
                self.printer.print(f"{request.item} {request.cents}")
            except PrinterFailed as error:
                raise rospy.ServiceException(str(error))
            self.sum += request.cents
            return self.sum

# %% 12.9 right: in its turn
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            if not self.amounts:
                return True, "already empty"
            paid = sum(self.amounts.values())
            self.amounts = {}
            return True, f"paid {paid} cents"

# %% 12.9 right: changes places
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            amounts, self.amounts = self.amounts, {}
        message = "paid %d cents" % sum(amounts.values()) if amounts else "It was empty already."
        return {"success": True, "message": message}

# %% 12.9 right: tries and gives back, with a full stop
from std_srvs.srv import TriggerResponse


class Register(OpenTill):
    """My register."""

    def __init__(self, printer):
        super().__init__(printer)
        self.customers = 0

    def handle_reset(self, request):
        answer = TriggerResponse(success=True)
        self.turn.acquire()
        try:
            if len(self.amounts) > 0:
                cents = 0
                for item in self.amounts:
                    cents += self.amounts[item]
                self.amounts.clear()
                self.customers += 1
                answer.message = f"The customer paid {cents}."
            else:
                answer.message = "Already empty."
        finally:
            self.turn.release()
        return answer

# %% 12.9 wrong: does not wait for its turn | hint: An item was being set, and the reset came in between
class Register(OpenTill):
    def handle_reset(self, request):
        if not self.amounts:
            return True, "already empty"
        paid = sum(self.amounts.values())
        self.amounts = {}
        return True, f"paid {paid} cents"

# %% 12.9 wrong: asks for the total in its turn | hint: It waits for itself
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            if not self.amounts:
                return True, "already empty"
            paid = self.total()
            self.amounts = {}
            return True, f"paid {paid} cents"

# %% 12.9 wrong: a second time is a mistake | hint: The caller wants an empty till, and it is empty
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            if not self.amounts:
                return False, "already empty"
            paid = sum(self.amounts.values())
            self.amounts = {}
            return True, f"paid {paid} cents"

# %% 12.9 wrong: takes the sum afterwards | hint: the sum was taken when the items were gone already
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            if not self.amounts:
                return True, "already empty"
            self.amounts = {}
            return True, f"paid {sum(self.amounts.values())} cents"

# %% 12.9 wrong: says done | hint: The sum of the items belongs into it
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            words = "done" if self.amounts else "already empty"
            self.amounts = {}
            return True, words

# %% 12.9 wrong: says the same twice | hint: say already
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            paid = sum(self.amounts.values())
            self.amounts = {}
            return True, f"paid {paid} cents"

# %% 12.9 wrong: empties nothing | hint: There is still something in it
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            if not self.amounts:
                return True, "already empty"
            amounts = dict(self.amounts)
            paid = sum(amounts.values())
            amounts.clear()
            return True, f"paid {paid} cents"

# %% 12.9 wrong: keeps the turn | hint: The turn was taken and never given back
class Register(OpenTill):
    def handle_reset(self, request):
        self.turn.acquire()
        if not self.amounts:
            return True, "already empty"
        paid = sum(self.amounts.values())
        self.amounts = {}
        return True, f"paid {paid} cents"

# %% 12.9 wrong: only a message | hint: Trigger answers with success, a bool, and message
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            if not self.amounts:
                return "already empty"
            paid = sum(self.amounts.values())
            self.amounts = {}
            return f"paid {paid} cents"

# %% 12.9 wrong: the total first, and then its turn | hint: that item is lost
class Register(OpenTill):
    def handle_reset(self, request):
        paid = self.total()
        with self.turn:
            if not self.amounts:
                return True, "already empty"
            self.amounts = {}
            return True, f"paid {paid} cents"

# %% 12.9 wrong: glued | hint: The number is no word of its own
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            if not self.amounts:
                return True, "already empty"
            paid = sum(self.amounts.values())
            self.amounts = {}
            return True, f"paid {paid}ct"

# %% 12.9 wrong: a refusal for what is empty | hint: A reset succeeds in any case
class Register(OpenTill):
    def handle_reset(self, request):
        with self.turn:
            if not self.amounts:
                raise rospy.ServiceException("already empty")
            paid = sum(self.amounts.values())
            self.amounts = {}
            return True, f"paid {paid} cents"

# %% 12.10 right: as on the page
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 right: with a main function
%%writefile ask_customer.py
"""Asks once whether a customer is there."""
import sys
import rospy
import course_pkg.srv as srv


def main():
    rospy.init_node("ask_customer", anonymous=False)
    wait = float(rospy.get_param("~wait", default=2))
    detect = rospy.ServiceProxy("detect_customer", srv.AwaitCustomer)
    try:
        detect.wait_for_service(3.0)
    except rospy.ROSException:
        print("no detector", file=sys.stderr)
        return 1
    try:
        found = detect(patience=wait).found
    except rospy.ServiceException as error:
        print(error, file=sys.stderr)
        return 1
    print("customer") if found else print("nobody")
    return 0


if __name__ == "__main__":
    sys.exit(main())

# %% 12.10 wrong: calls at once | hint: The detector came a moment after the program
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: waits for ever | hint: It still waited for a detector that never comes
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer")
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: a parameter of everybody | hint: The wait is a parameter of the node, and private
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: another default | hint: Where nobody sets it, it is 2 s
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 5.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: no default | hint: it has no default
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait")
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: a fixed patience | hint: rospy.get_param("~wait", 2.0)
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = 2.0
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: any answer is a customer | hint: A response counts as true whatever is in it
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer else "nobody")

# %% 12.10 wrong: catches only one of the two | hint: it raises a ROSException, which is no ServiceException
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except rospy.ServiceException as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: lets a refusal out | hint: Catch rospy.ServiceException, and print its words
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except rospy.ROSException as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: fails with success | hint: Whoever started it looks at the exit status
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    print(error)
    sys.exit(0)
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: keeps the reason to itself | hint: print the words of the ServiceException
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(1)
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: spins in the end | hint: no rospy.spin() at the end
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")
rospy.spin()

# %% 12.10 wrong: nobody is a failure | hint: Nobody is an answer, too
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")
sys.exit(0 if answer.found else 1)

# %% 12.10 wrong: prints the answer | hint: The line has nothing but the word
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("a customer" if answer.found else "nobody there")

# %% 12.10 wrong: another name | hint: was rospy.init_node called before everything else
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customers", timeout=3)
    answer = rospy.ServiceProxy("/detect_customers", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: waits for ten seconds | hint: Give the wait its limit
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=10)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: gives up without a word | hint: Nobody reads why it ended
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
except rospy.ROSException:
    sys.exit(1)
try:
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except rospy.ServiceException as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: status 2 | hint: The exit status that says
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    print(error)
    sys.exit(2)
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: two lines | hint: expects one line
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print(answer)
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: half a second | hint: It waited for less than 3 s
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=0.5)
    answer = rospy.ServiceProxy("/detect_customer", AwaitCustomer)(patience)
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.10 wrong: asks until somebody is there | hint: It asked more than once
%%writefile ask_customer.py
#!/usr/bin/env python3
import sys

import rospy
from course_pkg.srv import AwaitCustomer

rospy.init_node("ask_customer")
patience = rospy.get_param("~wait", 2.0)
try:
    rospy.wait_for_service("/detect_customer", timeout=3)
    detect = rospy.ServiceProxy("/detect_customer", AwaitCustomer)
    for _ in range(3):
        answer = detect(patience)
        if answer.found:
            break
except (rospy.ROSException, rospy.ServiceException) as error:
    sys.exit(str(error))
print("customer" if answer.found else "nobody")

# %% 12.11 right: an argument and a condition
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 right: a group, another order, and a parameter with its whole name
%%writefile my_cashier.launch
<launch>
  <arg name="wait" default="2" doc="in seconds"/>
  <arg name="till" default="1"/>
  <group if="$(arg till)">
    <node name="till" pkg="course_pkg" type="till" output="screen"/>
  </group>
  <param name="robot_cashier/wait" value="$(arg wait)"/>
  <node name="robot_cashier" pkg="course_pkg" type="robot_cashier" respawn="true"/>
  <node name="customer_detector" pkg="course_pkg" type="customer_detector"/>
  <node name="robot" pkg="course_pkg" type="robot"/>
  <node name="counter_camera" pkg="course_pkg" type="counter_camera"/>
</launch>

# %% 12.11 right: on the command line of the node
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier" args="_wait:=$(arg wait)" />
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: the till in any case | hint: It is there although nobody wants it
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: no till without the argument | hint: Without an argument there is a till
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="false" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: unless for if | hint: if=, not unless=
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node unless="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: no default | hint: give each <arg> a default
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: neither true nor false | hint: if= takes true or false
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="yes" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: the wait of everybody | hint: <param> stands inside of the robot_cashier's <node>
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <param name="wait" value="$(arg wait)" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: no parameter | hint: Inside of <node
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: a fixed wait | hint: The value is not the argument's
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="2.0" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: another default | hint: Without an argument it is 2 s
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="5.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: a node is forgotten | hint: /customer_detector is missing
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: the name with a suffix | hint: A program's name is wrong
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector.py" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: a tag that is not closed | hint: each <tag> is closed
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot">
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: value for default | hint: An <arg> with value= is fixed
%%writefile my_cashier.launch
<launch>
  <arg name="till" value="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: misspelt package | hint: pkg= and type=
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_package" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: the argument is misspelt | hint: An argument is not declared
%%writefile my_cashier.launch
<launch>
  <arg name="tills" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="robot" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>

# %% 12.11 wrong: another program under the name | hint: the program of its name as its type=
%%writefile my_cashier.launch
<launch>
  <arg name="till" default="true" />
  <arg name="wait" default="2.0" />
  <node pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node pkg="course_pkg" type="counter_camera" name="robot" />
  <node pkg="course_pkg" type="customer_detector" name="customer_detector" />
  <node pkg="course_pkg" type="robot_cashier" name="robot_cashier">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node if="$(arg till)" pkg="course_pkg" type="till" name="till" />
</launch>
