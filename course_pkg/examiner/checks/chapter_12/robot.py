"""12.6: two things at once: an arm that mirrors at once, and a question that stands."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.scripted import Act, Late, Refuse, ScriptedServer
from course_pkg.examiner.waiting import until

JOINTS = "sensor_msgs/JointState"
AWAIT = "course_pkg/AwaitCustomer"
STANDS = 0.5  # s for which a question of the check stands
GREETING = 0.25  # s that a greeting takes
SLACK = 1.2  # s: a busy machine is no mistake
REFUSING = 1.0  # s for which nobody can tell who is there
MOST = 8  # questions in that time that are no flood

A_GREETER = """
import threading
import time


class Work:
    def __init__(self):
        self.over = threading.Event()
        self.greeted = []
        self.mirrored = []
        self.begun = time.monotonic()

    def mirror(self, stance):
        self.mirrored.append([stance.header.stamp.secs, time.monotonic() - self.begun])

    def greet(self):
        self.greeted.append(time.monotonic() - self.begun)
        time.sleep(GREETING)

    def begin(self, start, stances, service):
        self.threads = set(threading.enumerate())
        self.subscriber = start(stances, self.mirror, service, self.greet, self.over)
        return hasattr(self.subscriber, "unregister") or hasattr(self.subscriber, "stop")

    def end(self):
        self.over.set()
        for way in ("unregister", "stop"):
            if hasattr(getattr(self, "subscriber", None), way):
                getattr(self.subscriber, way)()
        self.subscriber = None


work = Work()
"""


@part(
    "12.6",
    points=3,
    goal="Mirror at once while a question stands, and greet each customer.",
    needs=["start_robot"],
    deadline=40.0,
)
def two_things_at_once(exam: Exam) -> None:
    """Have customers come, nobody, and a camera that is gone, and publish stances all the time."""
    stances, service = (f"/{exam.draw.word()}" for _ in range(2))
    detector = _Detector()
    exam.prepare(A_GREETER.replace("GREETING", str(GREETING)))
    with _begun(exam, stances, service, detector) as server:
        speaking = exam.publish(stances, JOINTS, _numbered(), every=0.04, once=True)
        speaking.listened(hints="Make a rospy.Subscriber for `stances`, of type JointState, and return it.")
        _asks(exam, server)
        _greets(exam, detector)
        _mirrors(exam, speaking.sent)
        _goes_on(exam, detector)
        _ends(exam, server)


class _Detector:
    """Answers as a detector does: two customers, nobody, no camera, and then a customer again."""

    def __init__(self) -> None:
        self.found: list[float] = []  # when each customer was told of
        self.patience: list[float] = []
        self.refusing = False
        self.refused = 0
        self._asked = 0
        self._turn = threading.Lock()

    def answer(self, request: Any) -> Act:  # noqa: ANN401 -- a class that catkin generates
        """Answer a question, late as a rule: the student's program has to stand there."""
        with self._turn:
            self._asked += 1
            self.patience.append(request.patience)
            if self.refusing:
                self.refused += 1
                return Refuse("the camera has said nothing for 1 s, so nobody can tell")
            found = self._asked in (1, 3)
            if found:
                self.found.append(time.monotonic() + STANDS)
        return Late(STANDS, {"found": found})


def _numbered() -> list[dict[str, Any]]:
    return [
        {"header": {"stamp": {"secs": number + 1, "nsecs": 0}}, "name": ["a"], "position": [0.1]}
        for number in range(1000)
    ]


@contextmanager
def _begun(exam: Exam, stances: str, service: str, detector: _Detector) -> Iterator[ScriptedServer]:
    server = exam.serve(service, AWAIT, detector.answer)
    worded = "start_robot(stances, mirror, service, greet, over)"
    try:
        started = exam.run(
            "work.begin",
            Its("start_robot"),
            stances,
            service,
            within=3.0,
            worded=worded,
            hints={
                says(
                    "TimesUp"
                ): "It did not come back: the asking goes on, so it needs a thread of its own, and "
                "start_robot returns at once.",
            },
        )
        exam.expect(
            "the subscriber is returned",
            expected=True,
            seen=started.value,
            hints="Return the rospy.Subscriber, so that whoever started it can stop it.",
        )
        yield server
    finally:
        exam.run("work.end")


def _asks(exam: Exam, server: ScriptedServer) -> None:
    asked = until(lambda: bool(server.requests), 2.5)
    exam.hold(
        "it asks whether somebody is there",
        asked,
        expected="a question",
        seen="none",
        hints="Nobody asked. Start the thread: threading.Thread(target=…, daemon=True).start().",
    )
    exam.expect(
        "with a patience of 2 s",
        expected=2.0,
        seen=server.requests[0]["patience"],
        near=1e-6,
        hints={0.0: "The patience is 0, as a field is that nobody set: that only looks, again and again."},
    )


def _greets(exam: Exam, detector: _Detector) -> None:
    """Wait for the second customer, and look at whom was greeted."""
    came = until(lambda: len(detector.found) >= 2, 3 * STANDS + 2 * GREETING + 2 * SLACK)
    exam.hold(
        "it asks again after each answer",
        came,
        expected="a third question",
        seen=f"{len(detector.patience)} questions",
        hints="It asked, and then no more. Ask in a loop: while not over.is_set().",
    )
    # Who has put the next question has done with the answer before it.
    until(lambda: len(detector.patience) >= 4, STANDS + GREETING + SLACK)
    exam.expect(
        "each customer is greeted, once, and nobody is not",
        expected=2,
        seen=len(exam.read("work.greeted")),
        hints=[
            (0, "Nobody was greeted: call greet() where found is True."),
            (
                lambda seen: seen > 2,
                "Somebody was greeted who was not there. A response is something that "
                "counts as true whatever is in it: look at its found.",
            ),
            (
                says(""),
                "Somebody was found, and not greeted. Call greet() after each answer that says found.",
            ),
        ],
    )


def _mirrors(exam: Exam, sent: list[float]) -> None:
    """Hold that what was published until now was mirrored, and at once."""
    count = len(sent) - 1
    until(lambda: any(number >= count for number, _ in exam.read("work.mirrored")), SLACK)
    seen = [number for number, _ in exam.read("work.mirrored") if number <= count]
    exam.hold(
        "every stance is mirrored, in order, whatever else goes on",
        seen == list(range(1, count + 1)),
        expected=f"{count} stances, the first to the last",
        seen=f"{len(seen)} of them",
        hints=[
            ((lambda _: not seen), "mirror was never called. It is the callback of the subscriber."),
            (
                says(""),
                "The arm stood still while a question stood, or somebody was greeted. The callback only "
                "mirrors; asking is the work of another thread, and no lock is shared.",
            ),
        ],
    )
    at = dict(exam.read("work.mirrored"))
    begun = exam.read("work.begun")
    late = sorted(at[number] + begun - sent[number - 1] for number in seen)[len(seen) * 17 // 20]
    exam.hold(
        "and at once",
        late < STANDS / 2,
        expected="a few milliseconds after the stance",
        seen=f"one in six of them later than {late:.1f} s",
        hints="The stances came, and had to wait. Don't ask and don't greet where they are handled.",
    )


def _goes_on(exam: Exam, detector: _Detector) -> None:
    """Refuse for a while: it has to ask again, and not all the time."""
    detector.refusing = True
    refused = until(lambda: detector.refused >= 1, STANDS + GREETING + SLACK)
    exam.hold(
        "it asks on and on",
        refused,
        expected="another question",
        seen="none",
        hints="It asked, and then no more. Ask in a loop: while not over.is_set().",
    )
    time.sleep(REFUSING)
    exam.hold(
        "a refusal does not end it",
        detector.refused > 1,
        expected="another question, half a second later",
        seen="none",
        hints="The detector refused, and the thread ended with a ServiceException that nobody caught. Catch "
        "it, pause, and ask again.",
    )
    exam.hold(
        "who is refused pauses before the next question",
        detector.refused <= MOST,
        expected="about two questions a second",
        seen="more than a dozen",
        hints="Refusals come at once, and so did the next questions. Pause for half a second: "
        "over.wait(0.5).",
    )


def _ends(exam: Exam, server: ScriptedServer) -> None:
    exam.run("work.end")
    until(lambda: False, 0.6)
    before = len(server.requests)
    until(lambda: len(server.requests) > before, 0.8)
    exam.expect(
        "it ends when it is told to",
        expected=0,
        seen=len(server.requests) - before,
        hints="`over` was set, and it asked on. Look at over.is_set() before each question.",
    )
