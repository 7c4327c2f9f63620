"""The watch that tells a stream that runs from one that has ended."""

import time

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.outcome import Outcome
from course_pkg.examiner.publishing import Publishing
from course_pkg.examiner.waiting import until

KEEPER = """
watches = {}


def begin(kind, topic):
    watches[topic] = kind(topic)


def state(topic):
    return watches[topic].state()


def end():
    for watch in watches.values():
        for value in vars(watch).values():
            if hasattr(value, "unregister"):
                value.unregister()
    watches.clear()
"""
WORDS = ("waiting", "running", "ended")
LIMIT = 1.0  # s without a message
AT_ONCE = 0.4  # s; a busy machine may need more once, and not each time


@part(
    "02.5",
    points=2,
    goal="Say of a stream whether it is waiting, running or ended, at once, whenever asked.",
    needs=["Watch"],
    deadline=40.0,
)
def watch_a_stream(exam: Exam) -> None:
    """Ask one before the first message, in a stream and after it; have another that is asked late."""
    topic, unasked = (f"/{exam.draw.word()}" for _ in range(2))
    exam.prepare(KEEPER)
    try:
        for name in (topic, unasked):
            exam.run("begin", Its("Watch"), name, worded="Watch(topic)", hints=_RETURNS).value  # noqa: B018
        for _ in range(exam.draw.integer(1, 4)):
            _says(exam, topic, "before the first message it is waiting", "waiting", _BEFORE)
        time.sleep(1.3)
        _says(exam, topic, "before the first message it is waiting", "waiting", _BEFORE)
        speaking = _speaks(exam, unasked)
        until(lambda: len(speaking.sent) > 5, 5.0)  # by then the first has long come
        _says(exam, unasked, "it watches from the start, asked or not", "running", _UNASKED)
        _says(exam, topic, "one watch knows nothing of another", "waiting", _APART)
        _runs(exam, topic, "while messages come it is running")
        _runs(exam, topic, "when they come again it is running again")
    finally:
        exam.run("end")


def _speaks(exam: Exam, topic: str) -> Publishing:
    """Publish ten messages a second to the watch."""
    speaking = exam.publish(topic, "std_msgs/UInt32", [{"data": 7}], every=0.1)
    speaking.listened(hints="Make a rospy.Subscriber for the topic, of type UInt32, when the watch is made.")
    return speaking


def _runs(exam: Exam, topic: str, rule: str) -> None:
    """Speak for a while, then be silent, and stay registered as one who could speak."""
    speaking = _speaks(exam, topic)
    time.sleep(0.5)
    for _ in range(exam.draw.integer(5, 9)):
        _says(exam, topic, rule, "running", _WHILE)
        time.sleep(0.06)
    time.sleep(1.0)
    _says(exam, topic, rule, "running", _WHILE)
    speaking.stop()
    time.sleep(0.5)
    end = speaking.sent[-1] + LIMIT
    _says(exam, topic, "a pause of half a second is no end", "running", _PAUSE, before=end)
    time.sleep(max(end + 0.4 - time.monotonic(), 0.0))
    until(lambda: _asked(exam, topic).value != "running", 0.4)  # a busy machine hands the last one over late
    for _ in range(exam.draw.integer(1, 4)):
        _says(exam, topic, "without a message for longer than a second it has ended", "ended", _END)


def _asked(exam: Exam, topic: str) -> Outcome:
    return exam.run("state", topic, worded="Watch(topic).state()", hints=_RETURNS)


def _says(
    exam: Exam,
    topic: str,
    rule: str,
    word: str,
    hints: list[tuple[object, str]],
    before: float = float("inf"),
) -> None:
    """Hold that it says `word`, unless the answer came only at the time `before` (s, time.monotonic())."""
    asked = _asked(exam, topic)
    in_time = time.monotonic() < before
    exam.hold(
        "the answer is one of the three words",
        asked.value in WORDS,
        expected="waiting, running or ended",
        seen=asked.value,
        hints={
            None: "None was returned, as by a function that comes to its end without a return line.",
            says("waiting|running|ended"): "Write the word as it stands in the exercise, in small letters.",
            says(""): "Return one of the three words, as a text.",
        },
    )
    exam.expect(rule, expected=word if in_time else asked.value, seen=asked.value, hints=hints)
    exam.hold(
        "it answers at once",
        asked.took < AT_ONCE or until(lambda: _asked(exam, topic).took < AT_ONCE, 3 * AT_ONCE),
        expected="an answer without waiting",
        seen=f"an answer after {asked.took:.1f} s",
        hints="Do not wait for a message when you are asked. Note when one comes, in the callback.",
    )


_RETURNS = {
    says("TimesUp"): "It waits for a message. Listen with a callback that notes when one comes, and return.",
    says(
        "TypeError.*NoneType"
    ): "Before the first message there is no time to compare with. Look for that first.",
}
_BEFORE: list[tuple[object, str]] = [
    ("running", "No message has come yet: it is not running."),
    ("ended", "Nothing can have ended that has not begun: before the first message it is waiting."),
]
_UNASKED: list[tuple[object, str]] = [
    (says(""), "It was spoken to before it was asked for the first time. Listen when the watch is made."),
]
_APART: list[tuple[object, str]] = [
    (
        says(""),
        "The other watch was spoken to. Keep what a watch knows in self, and not in one place for all.",
    ),
]
_WHILE: list[tuple[object, str]] = [
    ("waiting", "Messages come ten times a second. Note each in the callback."),
    ("ended", "The last message is less than a second old. Note the time of each one that comes."),
]
_PAUSE: list[tuple[object, str]] = [
    (
        "ended",
        "The last message came half a second ago. A stream has ended after a whole second without one.",
    ),
    ("waiting", "Messages have come. It is waiting only before the first."),
]
_END: list[tuple[object, str]] = [
    (
        "running",
        "No message came for more than a second. The publisher is still registered, but silent: look at the "
        "time of the last message.",
    ),
    ("waiting", "Messages have come. A stream that ran and does not any more has ended."),
]
