"""Subscribers: a mirror of every message, and a slow piece of work that keeps up."""

import statistics
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from typing import Any

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.hearing import Arrival
from course_pkg.examiner.ledger import first_unlike
from course_pkg.examiner.plain import Plain

JOINTS = "sensor_msgs/JointState"
KEEPER = """
kept = []


def begin(start, *args):
    kept.append(start(*args))
    return hasattr(kept[-1], "unregister") or hasattr(kept[-1], "stop")


def end():
    while kept:
        subscriber = kept.pop()
        for way in ("unregister", "stop"):  # of rospy.Subscriber, and of what node.subscribe returns
            if hasattr(subscriber, way):
                getattr(subscriber, way)()
"""
WITNESS = """
import rospy
from sensor_msgs.msg import JointState

witnessed = []


def listen_too(topic):
    kept.append(rospy.Subscriber(topic, JointState, witness))


def witness(message):
    witnessed.append(message)
"""
WORK = """
import threading
import time


class Work:
    def __init__(self, pause):
        self.pause, self.done, self.at_once, self.busy = pause, [], 0, 0
        self.lock = threading.Lock()

    def __call__(self, value):
        with self.lock:
            self.busy += 1
            self.at_once = max(self.at_once, self.busy)
            self.done.append([time.monotonic(), value])
        time.sleep(self.pause)
        with self.lock:
            self.busy -= 1


work = Work(PAUSE)
"""
FIELDS = ("name", "position", "velocity")
PAUSE = 0.3  # s that the work takes
HEADER = "the header stays, and with it the time of each stance"
NO_SUBSCRIBER = "Return the rospy.Subscriber, so that whoever started it can stop it."
NEVER_RETURNS = "It has to return at once: messages are handled by the callback, on a thread of their own."


@part(
    "02.2",
    points=2,
    goal="Mirror every message of one topic on another, at once, with its signs turned.",
    needs=["start_mirror"],
    deadline=30.0,
)
def a_mirror(exam: Exam) -> None:
    """Publish stances of a robot that nobody knows, and compare each with what comes out."""
    source, target = (f"/{exam.draw.word()}" for _ in range(2))
    hearing = exam.hear(target, JOINTS)
    with _begun(exam, "start_mirror", source, target, worded="start_mirror(source, target)"):
        hearing.published(
            hints={
                says(
                    "nobody"
                ): "Nobody publishes it when start_mirror() has returned. Make the publisher there, and "
                "not in the callback: it would lose what it says first.",
            }
        )
        exam.prepare(WITNESS)
        exam.run("listen_too", source, worded="start_mirror(source, target)")
        messages = _stances(exam, 40)
        speaking = exam.publish(source, JOINTS, messages, every=0.025, once=True)
        speaking.listened(hints="Make a rospy.Subscriber for the source, of type JointState, and return it.")
        speaking.finish(10.0)
        _mirrors(exam, messages, hearing.wait(len(messages), within=1.5))
        hearing.during(0.3)
        exam.expect(
            "one message for each",
            expected=len(messages),
            seen=hearing.count,
            hints="There are more on the target than on the source. Publish once for each message.",
        )
        _promptly(exam, speaking.sent, hearing.arrivals)
        expected, seen = _changed(messages, exam.read("witnessed"))
        exam.expect(
            "the message itself is left as it is",
            expected=expected,
            seen=seen,
            near=1e-9,
            hints="Another callback of this program got it with its signs turned. Make a new JointState.",
        )


def _changed(messages: Sequence[Plain], witnessed: Sequence[Plain]) -> tuple[Plain, Plain]:
    """Return what was given and what was seen of the first message that somebody changed, else two alike."""
    given, seen = (
        [{field: each[field] for field in FIELDS} for each in all_] for all_ in (messages, witnessed)
    )
    return first_unlike(given, seen, near=1e-9)


def _stances(exam: Exam, count: int) -> list[dict[str, Any]]:
    names = [exam.draw.word() for _ in range(4)]
    return [
        {
            "header": {
                "stamp": {"secs": 1000 + number, "nsecs": exam.draw.integer(1, 999_999_999)},
                "frame_id": exam.draw.word(),
            },
            "name": names,
            "position": _of_both_signs(exam),
            "velocity": _of_both_signs(exam),
        }
        for number in range(count)
    ]


def _of_both_signs(exam: Exam) -> list[float]:
    """Draw four numbers that tell every slip with signs from every other."""
    return exam.draw.shuffled([*exam.draw.numbers(2, 0.1, 3.0), *exam.draw.numbers(2, -3.0, -0.1)])


@contextmanager
def _begun(exam: Exam, start: str, *args: object, worded: str) -> Iterator[None]:
    """Have the student's function start its subscriber, and end that after the block."""
    exam.prepare(KEEPER)
    try:
        started = exam.run("begin", Its(start), *args, worded=worded, hints={says("TimesUp"): NEVER_RETURNS})
        exam.expect("the subscriber is returned", expected=True, seen=started.value, hints=NO_SUBSCRIBER)
        yield
    finally:
        exam.run("end", worded=worded)


def _mirrors(exam: Exam, messages: Sequence[dict[str, Any]], heard: Sequence[Arrival]) -> None:
    """Compare what came out with what went in, one by one, by the time in the header."""
    stamps = [message["header"]["stamp"] for message in messages]
    seen = [arrival.fields["header"]["stamp"] for arrival in heard]
    exam.hold(
        HEADER,
        bool(heard) and seen[0] in stamps,
        expected="the stamps that were published",
        seen=seen[:3] if heard else "nothing was heard",
        hints={
            says("nothing was heard"): "Nothing came out. Publish the image in the callback. (An error in a "
            "callback is printed by rospy, which goes on.)",
            says("'secs': 0, 'nsecs': 0"): "The time is 0, as in a header that is new. Hand the header on.",
            says(""): "That is another time than the robot's. Hand the header on as it is.",
        },
    )
    for arrival in heard:
        message = messages[stamps.index(arrival.fields["header"]["stamp"])]
        exam.expect(
            HEADER,
            expected=message["header"]["frame_id"],
            seen=arrival.fields["header"]["frame_id"],
            hints="A header has more than its time: it has a frame_id, too. Hand the whole header on.",
        )
        _is_image(exam, message, arrival.fields)
    exam.expect(
        "every message is mirrored, in order",
        expected=[stamp["secs"] for stamp in stamps],
        seen=[stamp["secs"] for stamp in seen],
        hints=[
            (lambda seen: len(seen) == 1, "Only one was mirrored. A callback is called for each message."),
            (
                lambda seen: len(set(seen)) < len(seen),
                "Some came more than once. Publish in the callback, once for each message.",
            ),
            (
                lambda seen: seen[0] != stamps[0]["secs"] and len(seen) > len(stamps) / 2,
                "The first are missing. Make the publisher before the subscriber, and not in the callback.",
            ),
            (
                lambda seen: len(seen) < len(stamps),
                "Some were left out. Do nothing in the callback that takes time, and drop nothing.",
            ),
            (says(""), "Publish once for each message, in the callback."),
        ],
    )


def _is_image(exam: Exam, message: dict[str, Any], image: dict[str, Any]) -> None:
    exam.expect(
        "the names stay",
        expected=message["name"],
        seen=image["name"],
        hints={
            (): "The names are missing. Hand them on.",
            tuple(reversed(message["name"])): "The list was turned around. It is the signs that turn.",
            says(""): "Hand the names on as they are: the positions stand in their order.",
        },
    )
    for field, other in (("position", "velocity"), ("velocity", "position")):
        values = message[field]
        exam.expect(
            f"every {field} has its sign turned",
            expected=[-value for value in values],
            seen=image[field],
            near=1e-9,
            hints=[
                (values, f"The {field} came out as it went in. Turn the sign of each."),
                ([], f"The list is empty: {field} was left out."),
                (values[::-1], "The list was turned around. It is the signs that turn."),
                ([abs(value) for value in values], "A sign that turns makes plus of minus, too: -value."),
                ([-value for value in message[other]], f"Those are of the field {other}. Name the fields."),
                (says(""), "Turn the sign of each number, and nothing else."),
            ],
        )


def _promptly(exam: Exam, sent: Sequence[float], arrivals: Sequence[Arrival]) -> None:
    delays = [arrival.at - at for at, arrival in zip(sent, arrivals, strict=False)]
    exam.hold(
        "without delay",
        statistics.median(delays) < 0.15,
        expected="the image a few milliseconds after the stance",
        seen=f"half of them later than {statistics.median(delays):.2f} s",
        hints="They come late. Publish in the callback, and let nothing in it wait.",
    )


@part(
    "02.4",
    points=2,
    goal="Have slow work done on the newest value of a topic, one at a time.",
    needs=["follow"],
    deadline=30.0,
)
def only_the_newest(exam: Exam) -> None:
    """Publish for three seconds, much faster than the work is done, and look at what was worked on."""
    topic = f"/{exam.draw.word()}"
    values = exam.draw.numbers(150, -900.0, 900.0)
    exam.prepare(WORK.replace("PAUSE", str(PAUSE)))
    with _begun(exam, "follow", topic, Its("work"), worded="follow(topic, work)"):
        speaking = exam.publish(
            topic, "std_msgs/Float64", [{"data": value} for value in values], every=0.02, once=True
        )
        speaking.listened(hints="Make a rospy.Subscriber for the topic, of type Float64, and return it.")
        speaking.finish(10.0)
        time.sleep(3 * PAUSE)  # for the work on the last values
        done = exam.read("work.done")
    _worked(exam, [value for _, value in done], values)
    begun = [at for at, _ in done]
    overlap = any(later - earlier < 0.9 * PAUSE for earlier, later in pairwise(begun))
    exam.expect(
        "one at a time",
        expected=1,
        seen=max(exam.read("work.at_once"), 1 + overlap),
        hints="The work ran several times at once. A thread for each message is one too many.",
    )
    sent = dict(zip(values, speaking.sent, strict=True))
    oldest = max(at - sent[value] for at, value in done)
    exam.hold(
        "no value is long out of date when the work on it begins",
        oldest < 2 * PAUSE,
        expected="less than half a second from the robot to the work",
        seen=f"up to {oldest:.1f} s",
        hints="Too many may wait. With queue_size=1, only the newest does.",
    )
    exam.expect(
        "the newest value is not missed",
        expected=values[-1],
        seen=done[-1][1],
        hints="The last value was never worked on. Take the newest there is, and not every tenth or so.",
    )


def _worked(exam: Exam, seen: list[Any], values: list[float]) -> None:
    exam.hold(
        "the work is given values of the topic",
        bool(seen) and set(map(str, seen)) <= set(map(str, values)),
        expected="numbers that were published",
        seen=seen[:3] or "the work was never called",
        hints={
            says("never"): "Call work in the callback.",
            says("data"): "That is the whole message. The number is its data.",
            says(""): "Nobody published that. Call work in the callback, with the data of the message.",
        },
    )
    exam.hold(
        "it is called again and again",
        len(seen) > 3,
        expected="a call each time that the work is done",
        seen=f"{len(seen)} calls",
        hints="It was given one value and no more. A callback is called for each message.",
    )
    order = [values.index(value) for value in seen]
    exam.hold(
        "no value comes twice, and none before an earlier one",
        order == sorted(set(order)),
        expected="later values each time",
        seen=seen,
        hints="A value was worked on twice, or after a later one. Wait for a newer one before the next call.",
    )
