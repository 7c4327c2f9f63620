"""12.2: an eye that knows what the newest good frame shows."""

from __future__ import annotations

import time

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.plain import Plain
from course_pkg.examiner.waiting import until

FRAMES = "sensor_msgs/Image"
SLOW = 0.02  # s that it takes to look at a frame of the flood
FLOOD = 100  # frames: two seconds' work, said in a fifth of one
FRESH = 0.6  # s after the flood in which its last frame is known even to one who looked at all of them
FLOODED = 5.0  # s after which all of them were looked at
NOTED = 1.0  # s for an eye that looks at its frames on a thread of its own
WAITERS = 3  # who wait for a change at the same time
STALE = 1.3  # s after which no frame is from the last second

# The first point of a frame says what the check's own way of looking finds in it.
A_LOOK = """
import threading
import time

import rospy
from sensor_msgs.msg import Image

NOBODY, SOMEBODY, BROKEN = 200, 20, 99


def sees(frame):
    if frame.step == 2:
        trial.looked += 1
        time.sleep(SLOW)
    if frame.data[0] == BROKEN:
        raise ValueError("this is no frame")
    return frame.data[0] == SOMEBODY


class Trial:
    looked = 0

    def make(self, cls):
        self.eye = cls(sees)

    def hear(self, *points):
        for point in points:
            frame = Image(width=1, height=1, step=1, encoding="mono8", data=bytes([point]))
            frame.header.stamp = rospy.Time.now()
            self.eye.hear(frame)
        return self.eye.look()

    def look(self):
        return self.eye.look()

    def stays(self, point):
        for _ in range(3):
            began = time.monotonic()
            self.hear(point)
            time.sleep(0.6)
            seen = self.eye.look()
            if time.monotonic() - began < 0.95:  # a machine that slept longer proves nothing
                return seen
        return point == SOMEBODY

    def wakes(self, point):
        woken = []
        ready = threading.Semaphore(0)

        def wait():
            with self.eye.changed:
                ready.release()
                if self.eye.changed.wait(2.0):
                    woken.append(1)

        waiters = [threading.Thread(target=wait) for _ in range(WAITERS)]
        for waiter in waiters:
            waiter.start()
            ready.acquire(timeout=2.0)
        with self.eye.changed:
            pass
        self.hear(point)
        for waiter in waiters:
            waiter.join(2.5)
        return len(woken)

    def start(self, topic):
        self.subscriber = self.eye.start(topic)
        return hasattr(self.subscriber, "unregister") or hasattr(self.subscriber, "stop")

    def end(self):
        for way in ("unregister", "stop"):
            if hasattr(getattr(self, "subscriber", None), way):
                getattr(self.subscriber, way)()


trial = Trial()
"""
NOBODY, SOMEBODY, BROKEN = 200, 20, 99
ERRORS = {
    says("un-acquired lock"): "A condition is held while it is notified: with self.changed: ...",
    says("this is no frame"): (
        "A malformed frame makes sees(frame) raise a ValueError, and a callback has nobody who catches it: "
        "catch it in hear(), and leave that frame out."
    ),
    says("has no attribute"): "Everything that look() uses has to be there from __init__ on.",
    says("'NoneType'"): "Before the first frame there is nothing to reckon with: look() is None then.",
    says("TimesUp"): "It did not come back. hear() and look() wait for nothing.",
}


@part(
    "12.2",
    points=3,
    goal="Know what the newest good frame of a stream shows, and when nobody can tell.",
    needs=["Eye"],
    deadline=30.0,
)
def an_eye(exam: Exam) -> None:
    """Show it frames one by one, broken ones among them; let it wait; then flood it."""
    exam.prepare(A_LOOK.replace("SLOW", str(SLOW)).replace("WAITERS", str(WAITERS)))
    made = exam.run("trial.make", Its("Eye"), worded="Eye(sees)", hints=ERRORS)
    exam.hold("an Eye can be made", not made.error, seen=made.error, hints=ERRORS)
    blind = "Before the first frame nobody can tell: look() is None then, and not False."
    _knows(exam, "it knows nothing before the first frame", None, _look(exam), blind)
    _one_by_one(exam)
    _wakes_who_waits(exam)
    _grows_old(exam)
    _flooded(exam)


def _look(exam: Exam) -> Plain:
    return exam.run("trial.look", worded="eye.look()", hints=ERRORS).value


def _hear(exam: Exam, *points: int) -> Plain:
    """Have it hear frames, and look; the words are the same whatever was drawn."""
    return exam.run("trial.hear", *points, worded="eye.hear(frame)", hints=ERRORS).value


def _heard(exam: Exam, known: bool, *points: int) -> Plain:
    """Have it hear frames; return what it knows then, as soon as that is `known`."""
    seen = _hear(exam, *points)
    if seen is not known:
        until(lambda: _look(exam) is known, NOTED)
        seen = _look(exam)
    return seen


def _knows(exam: Exam, rule: str, expected: bool | None, seen: Plain, hint: str) -> None:
    exam.expect(rule, expected=expected, seen=seen, hints=hint)


def _one_by_one(exam: Exam) -> None:
    keeps = "hear() has to keep what sees(frame) says."
    _knows(exam, "somebody is seen", True, _heard(exam, True, SOMEBODY), keeps)
    went = "Somebody was there, and has gone: only the newest frame counts, and no earlier one."
    _knows(exam, "the newest frame counts", False, _heard(exam, False, SOMEBODY, SOMEBODY, NOBODY), went)
    kept = "A malformed frame says nothing: what was known before it stays, for as long as that is fresh."
    for point, known in exam.draw.shuffled([(SOMEBODY, True), (NOBODY, False)]):
        _heard(exam, known, point)
        _knows(exam, "a malformed frame is left out", known, _heard(exam, known, BROKEN, BROKEN), kept)


def _wakes_who_waits(exam: Exam) -> None:
    for point in (NOBODY, NOBODY, SOMEBODY):
        exam.expect(
            "a good frame wakes up who waits for a change",
            expected=WAITERS,
            seen=exam.run("trial.wakes", point, worded="eye.changed.wait(2)", hints=ERRORS).value,
            hints=[
                (
                    0,
                    "A thread waited at eye.changed, and the frame did not wake it: each good frame calls "
                    "self.changed.notify_all(), also one that shows the same.",
                ),
                (says(""), "notify() wakes one of those who wait: self.changed.notify_all()."),
            ],
        )


def _grows_old(exam: Exam) -> None:
    """Let a second go by with nothing but malformed frames."""
    stays = exam.run("trial.stays", SOMEBODY, worded="eye.look()", hints=ERRORS).value
    early = "A frame of half a second ago was forgotten. It counts for a whole second: <= 1.0."
    _knows(exam, "somebody is seen", True, stays, early)
    _hear(exam, SOMEBODY)
    deadline = time.monotonic() + STALE
    while (rest := deadline - time.monotonic()) > 0:
        _hear(exam, BROKEN)
        time.sleep(min(rest, 0.2))
    hint = (
        "The last good frame was older than a second. Note when it came (time.monotonic()); malformed ones "
        "that came since do not count."
    )
    _knows(exam, "after a second without a good frame it knows nothing", None, _look(exam), hint)


def _flooded(exam: Exam) -> None:
    topic = f"/{exam.draw.word()}"
    started = exam.run("trial.start", topic, worded="eye.start(topic)", hints=ERRORS)
    try:
        exam.expect(
            "start() returns its subscriber",
            expected=True,
            seen=started.value,
            hints=("Return the rospy.Subscriber, so that whoever started it can stop it."),
        )
        frames = [_frame(NOBODY)] * (FLOOD - 1) + [_frame(SOMEBODY)]
        flood = exam.publish(topic, FRAMES, frames, every=0.002, once=True)
        flood.listened(hints="start() makes a rospy.Subscriber for the topic, of type Image.")
        flood.finish(10.0)
        prompt = until(lambda: _look(exam), FRESH)
        seen = prompt or until(lambda: _look(exam), FLOODED)
    finally:
        exam.run("trial.end")
    exam.hold(
        "in a flood of frames it keeps up with the newest",
        prompt is True or (seen is True and exam.read("trial.looked") < FLOOD),
        expected=f"the last of {FLOOD} frames, {FRESH:g} s after it came",
        seen="an older one" if seen is not None else "none",
        hints={
            says("none"): "No frame of the topic was taken in: start() hands each of them to self.hear.",
            says(
                ""
            ): "It works through all of them, and lags behind. Of those that wait only the newest counts: "
            "queue_size=1.",
        },
    )


def _frame(point: int) -> dict[str, Plain]:
    stamp = {"secs": int(time.time()) + 5, "nsecs": 0}  # who reckons with the stamp finds none of them old
    return {
        "header": {"stamp": stamp},
        "width": 1,
        "height": 1,
        "step": 2,
        "encoding": "mono8",
        "data": bytes([point, 0]),
    }
