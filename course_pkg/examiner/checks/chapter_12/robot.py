"""12.6: two things at once: an arm that mirrors at once, and a question that stands.

What goes on at the same time is seen by its order, and not by a clock: a question of the check stands until
stances that were published meanwhile have been mirrored, and a greeting lasts until then.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.checks.chapter_12.watched import A_GREETER, FOUND, HANGS, Detector, newest
from course_pkg.examiner.scripted import ScriptedServer
from course_pkg.examiner.waiting import until

JOINTS = "sensor_msgs/JointState"
AWAIT = "course_pkg/AwaitCustomer"
WORDS = "std_msgs/String"
EVERY = 0.04  # s between stances
ASKING = 6.0  # s for a question that is due, on a busy machine
LAST = 4  # the question after which it is clear who was greeted
REFUSALS = 3
PAUSE, TOO_LONG = 0.4, 1.5  # s between which half a second is, on a busy machine too
QUIET = 1.2  # s without a question, by which it has ended
ASK_ON = "It asked, and then no more. Ask in a loop: while not over.is_set()."
WORDED = "start_robot(stances, mirror, service, greet, over)"


@part(
    "12.6",
    points=3,
    goal="Mirror at once while a question stands, and greet each customer.",
    needs=["start_robot"],
    deadline=60.0,
)
def two_things_at_once(exam: Exam) -> None:
    """Have customers come, nobody, and a camera that is gone, and publish stances all the time."""
    stances, service, words = (f"/{exam.draw.word()}" for _ in range(3))
    exam.prepare(A_GREETER)
    said = exam.hear(words, WORDS)
    exam.run("work.open", words)
    until(lambda: exam.read("work.is_heard"), ASKING)
    detector = Detector(said)
    with _begun(exam, stances, service, detector) as server:
        speaking = exam.publish(stances, JOINTS, _numbered(), every=EVERY, once=True)
        detector.sent = speaking.sent
        speaking.listened(hints="Make a rospy.Subscriber for `stances`, of type JointState, and return it.")
        _asks(exam, server)
        _greets(exam, detector)
        _mirrors(exam, detector)
        _goes_on(exam, detector)
        _is_left_alone(exam, detector)
        _ends(exam, detector)


def _numbered() -> list[dict[str, Any]]:
    return [
        {"header": {"stamp": {"secs": number + 1, "nsecs": 0}}, "name": ["a"], "position": [0.1]}
        for number in range(2000)
    ]


@contextmanager
def _begun(exam: Exam, stances: str, service: str, detector: Detector) -> Iterator[ScriptedServer]:
    server = exam.serve(service, AWAIT, detector.answer)
    try:
        started = exam.run(
            "work.begin",
            Its("start_robot"),
            stances,
            service,
            within=3.0,
            worded=WORDED,
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
        exam.run("work.close")


def _asks(exam: Exam, server: ScriptedServer) -> None:
    asked = until(lambda: bool(server.requests), ASKING)
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


def _greets(exam: Exam, detector: Detector) -> None:
    """Let each greeting last for a while, until it is clear who was greeted."""
    greeted = 0
    while _is_greeted_again(detector, greeted):
        greeted += 1
        detector.moves_while("somebody was greeted")
        _is_greeted_first(exam, detector, greeted)
        exam.run("work.go", worded=WORDED)
    exam.hold(
        "it asks again after each answer",
        len(detector.asked) >= FOUND[-1],
        expected="a third question",
        seen=f"{len(detector.asked)} questions",
        hints=ASK_ON,
    )
    exam.expect(
        "each customer is greeted, once, and nobody is not",
        expected=len(FOUND),
        seen=greeted,
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


def _is_greeted_again(detector: Detector, greeted: int) -> bool:
    """Wait for another greeting, or until it is clear that there will be none; say whether it began."""
    until(lambda: detector.greeted > greeted or len(detector.asked) >= LAST, ASKING)
    return detector.greeted > greeted


def _is_greeted_first(exam: Exam, detector: Detector, greeted: int) -> None:
    """Hold that nobody has asked again while this greeting is under way."""
    if greeted <= len(detector.told) and len(detector.asked) > detector.told[greeted - 1]:
        exam.fail(
            "it asks again when the customer has gone",
            expected="no question while greet() is under way",
            seen="the next question",
            hint="The customer is still there, and would be found and greeted again. greet() comes back when "
            "the customer has gone: call it on the thread that asks, and ask again after it.",
        )


def _mirrors(exam: Exam, detector: Detector) -> None:
    """Hold that what was published until now was mirrored, and while the rest went on."""
    count = len(detector.sent)
    detector.said.until(lambda arrivals: newest(arrivals) >= count, ASKING)
    words = [arrival.fields["data"] for arrival in detector.said.arrivals]
    seen = [int(word) for word in words if word.isdecimal() and int(word) <= count]
    exam.hold(
        "every stance is mirrored, in order, whatever else goes on",
        seen == list(range(1, count + 1)),
        expected=f"{count} stances, the first to the last",
        seen=f"{len(seen)} of them",
        hints=[
            ((lambda _: not seen), "mirror was never called. It is the callback of the subscriber."),
            (
                (lambda _: len(set(seen)) < len(seen)),
                "mirror was called more than once for a stance. Once for each message.",
            ),
            (
                says(""),
                "The arm stood still while a question stood, or somebody was greeted. The callback only "
                "mirrors; asking is the work of another thread, and no lock is shared.",
            ),
        ],
    )
    still = [what for what in ("a question stood", "somebody was greeted") if what not in detector.moved]
    exam.hold(
        "and at once",
        not still,
        expected="an arm that goes on, whatever is asked",
        seen=f"an arm that stood still while {' and while '.join(still)}",
        hints="The stances came, and had to wait. Don't ask and don't greet where they are handled.",
    )


def _goes_on(exam: Exam, detector: Detector) -> None:
    """Refuse for a while: it has to ask again, and not all the time."""
    detector.refusing = True
    before = len(detector.asked)
    exam.hold(
        "it asks on and on",
        until(lambda: len(detector.asked) > before, ASKING),
        expected="another question",
        seen="none",
        hints=ASK_ON,
    )
    until(lambda: len(detector.asked) >= before + REFUSALS, ASKING)
    refused = detector.asked[before : before + REFUSALS]
    exam.hold(
        "a refusal does not end it",
        len(refused) > 1,
        expected="another question, half a second later",
        seen="none",
        hints="The detector refused, and the thread ended with a ServiceException that nobody caught. Catch "
        "it, pause, and ask again.",
    )
    pauses = [after - before for before, after in itertools.pairwise(refused)]
    exam.hold(
        "who is refused pauses before the next question",
        max(pauses) > PAUSE and min(pauses) < TOO_LONG,
        expected="the next question half a second later",
        seen=f"after {max(pauses) if max(pauses) < PAUSE else min(pauses):.1f} s",
        hints=[
            (
                (lambda _: max(pauses) < PAUSE),
                "Refusals come at once, and so did the next questions. Pause for half a second: "
                "over.wait(0.5).",
            ),
            (says(""), "Who comes meanwhile is not greeted. Pause for half a second, and no longer."),
        ],
    )


def _is_left_alone(exam: Exam, detector: Detector) -> None:
    """Leave a question without an answer: whoever has a time limit asks again, and others are hung up on."""
    detector.hanging, detector.refusing = True, False
    before = len(detector.asked)
    until(lambda: len(detector.asked) > before, ASKING)
    before = len(detector.asked)
    if not until(lambda: len(detector.asked) > before, HANGS + ASKING):
        exam.fail(
            "a question without an answer does not end it",
            expected="another question",
            seen="none",
            hint="No answer came, and the thread ended with an error that nobody caught. node.call raises a "
            "CallTimeout then, which is no ServiceException: catch both.",
        )


def _ends(exam: Exam, detector: Detector) -> None:
    detector.refusing = True
    exam.run("work.end", worded=WORDED)
    before, told = len(detector.asked), time.monotonic()
    quiet = until(lambda: time.monotonic() - max(told, detector.asked[-1]) > QUIET, 4 * QUIET)
    exam.expect(
        "it ends when it is told to",
        expected=0,
        seen=0 if quiet else len(detector.asked) - before,
        hints="`over` was set, and it asked on. Look at over.is_set() before each question.",
    )
