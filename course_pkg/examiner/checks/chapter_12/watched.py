"""Around a student's robot of 12.6: hands that say what they do, and a detector that watches the arm."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence

from course_pkg.examiner import HangUp, Refuse
from course_pkg.examiner.hearing import Arrival, Hearing
from course_pkg.examiner.scripted import Act
from course_pkg.examiner.waiting import until

MOVES = 8  # stances for which a question stands, and a greeting lasts
LONGEST = 1.8  # s after which they end in any case: less than the patience of the question
FOUND = (1, 3)  # the questions at which somebody is there
HANGS = 6.0  # s for which a question is left without an answer, if its caller does not give up before

A_GREETER = """
import threading

import rospy
from std_msgs.msg import String


class Work:
    subscriber = None

    def __init__(self):
        self.over = threading.Event()
        self.gone = threading.Semaphore(0)

    def open(self, topic):
        self.said = rospy.Publisher(topic, String, queue_size=10_000)

    @property
    def is_heard(self):
        return self.said.get_num_connections() > 0

    def mirror(self, stance):
        self.said.publish(str(stance.header.stamp.secs))

    def greet(self):
        self.said.publish("greeting")
        self.gone.acquire(timeout=10.0)

    def go(self):
        self.gone.release()

    def begin(self, start, stances, service):
        self.subscriber = start(stances, self.mirror, service, self.greet, self.over)
        return hasattr(self.subscriber, "unregister") or hasattr(self.subscriber, "stop")

    def end(self):
        self.over.set()
        self.gone.release(100)
        for way in ("unregister", "stop"):
            if hasattr(self.subscriber, way):
                getattr(self.subscriber, way)()
        self.subscriber = None

    def close(self):
        self.end()
        self.said.unregister()


work = Work()
"""


class Detector:
    """Answers as a detector does: two customers and nobody; then as one without a camera, or not at all."""

    def __init__(self, said: Hearing) -> None:
        self.said = said  # a number for each stance that was mirrored, and a word for each greeting
        self.sent: Sequence[float] = ()  # of each stance that was published, when
        self.asked: list[float] = []  # of each question, when
        self.told: list[int] = []  # the questions at which somebody was there
        self.refusing = self.hanging = False
        self.moved: set[str] = set()  # what went on while the arm did
        self._turn = threading.Lock()

    def answer(self, _request: object) -> Act:
        """Answer a question; as a rule it stands while the arm goes on."""
        with self._turn:
            self.asked.append(time.monotonic())
            number = len(self.asked)
        if self.refusing:
            return Refuse("the camera has said nothing for 1 s, so nobody can tell")
        if self.hanging:
            self.hanging, self.refusing = False, True  # the next one is answered
            until(lambda: len(self.asked) > number, HANGS)
            return HangUp()
        self.moves_while("a question stood")
        if number in FOUND:
            self.told.append(number)
        return {"found": number in FOUND}

    def moves_while(self, what: str) -> None:
        """Wait until stances that are published from now on were mirrored, and note that they were."""
        last = len(self.sent) + MOVES
        if self.said.until(lambda arrivals: newest(arrivals) >= last, LONGEST):
            self.moved.add(what)

    @property
    def greeted(self) -> int:
        """How many greetings have begun."""
        return sum(arrival.fields["data"] == "greeting" for arrival in self.said.arrivals)


def newest(arrivals: Sequence[Arrival]) -> int:
    """Return the number of the stance that was mirrored last; 0 if none was."""
    said = (arrival.fields["data"] for arrival in reversed(arrivals))
    return next((int(words) for words in said if words.isdecimal()), 0)
