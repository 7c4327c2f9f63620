"""12.5: an arm in the looking glass, which leaves out what is no stance."""

from __future__ import annotations

import math
from typing import Any

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.hearing import Arrival, Hearing

JOINTS = "sensor_msgs/JointState"
PROMPT = 0.5  # s from a stance to its image; half a second of a busy machine is no mistake
AN_ARM = """
import rospy
from sensor_msgs.msg import JointState


class Arm:
    subscriber = None

    def make(self, make_mirror, target):
        self.mirror = make_mirror(target)
        return callable(self.mirror)

    def start(self, source):
        self.subscriber = rospy.Subscriber(source, JointState, self.mirror)

    def end(self):
        if self.subscriber:
            self.subscriber.unregister()


arm = Arm()
"""
Stance = dict[str, Any]


@part(
    "12.5",
    points=2,
    goal="Mirror each stance of the arm at once, and leave out what is none.",
    needs=["make_mirror"],
    deadline=30.0,
)
def an_arm(exam: Exam) -> None:
    """Publish stances, broken ones among them, and compare what comes out with what went in."""
    source, target = (f"/{exam.draw.word()}" for _ in range(2))
    hearing = exam.hear(target, JOINTS)
    exam.prepare(AN_ARM)
    try:
        made = exam.run(
            "arm.make",
            Its("make_mirror"),
            target,
            worded="make_mirror(target)",
            hints={says("TimesUp"): "It has to return at once: stances come later, when rospy calls it."},
        )
        exam.expect(
            "a function is returned",
            expected=True,
            seen=made.value,
            hints="Return the function that takes a stance: return mirror, without parentheses.",
        )
        hearing.published(
            hints={
                says("nobody"): (
                    "Nobody publishes it when make_mirror() has returned. Make the publisher there, not in "
                    "the function: it would lose what it says first."
                )
            }
        )
        stances = _stances(exam)
        speaking = exam.publish(source, JOINTS, stances, every=0.025, once=True)
        exam.run("arm.start", source, worded="rospy.Subscriber(source, JointState, mirror)")
        speaking.listened()
        speaking.finish(10.0)
        _examine(exam, hearing, stances, speaking.sent)
    finally:
        exam.run("arm.end")


def _stances(exam: Exam) -> list[Stance]:
    """Return stances, a good one after each that is broken, the first and the last good."""
    good = [_stance(exam, number) for number in range(24)]
    broken = [(good[3], "position", good[3]["position"][:2])]
    broken += [(good[8], "position", [])]
    broken += [(good[12], "position", [math.nan, *good[12]["position"][1:]])]
    broken += [(good[17], "velocity", [*good[17]["velocity"][:-1], math.inf])]
    broken += [(good[5], "position", [*good[5]["position"], 0.5])]  # one without velocities
    broken += [(good[14], "velocity", good[14]["velocity"][:2])]
    broken += [(good[19], "velocity", [*good[19]["velocity"], 0.5])]
    for stance, field, values in broken:
        stance[field] = values
    return good


def _stance(exam: Exam, number: int) -> Stance:
    return {
        "header": {
            "stamp": {"secs": 1000 + number, "nsecs": exam.draw.integer(1, 999_999_999)},
            "frame_id": "arm",
        },
        "name": ["base", "shoulder", "elbow"],
        "position": exam.draw.numbers(3, -3.0, 3.0),
        "velocity": exam.draw.numbers(3, -3.0, 3.0) if number % 5 else [],
    }


def _is_good(stance: Stance) -> bool:
    position, velocity = stance["position"], stance["velocity"]
    sizes = len(position) == len(stance["name"]) and len(velocity) in (0, len(position))
    return sizes and all(map(math.isfinite, [*position, *velocity]))


def _examine(exam: Exam, hearing: Hearing, stances: list[Stance], sent: list[float]) -> None:
    good = [stance for stance in stances if _is_good(stance)]
    wanted = [stance["header"]["stamp"]["secs"] for stance in good]
    last = wanted[-1]
    hearing.until(lambda arrivals: any(_number(arrival) == last for arrival in arrivals), 5.0)
    heard = list(hearing.arrivals)
    exam.hold(
        "something comes out, with the time of its stance",
        bool(heard) and _number(heard[0]) >= 1000,
        expected="images with the stamps that were published",
        seen="nothing was heard" if not heard else f"the time {_number(heard[0])}",
        hints={
            says("nothing"): "Nothing came out. Publish the image in the function.",
            says(""): "That is another time than the robot's. Hand the header on: header=stance.header.",
        },
    )
    _leaves_out(exam, [arrival.fields for arrival in heard], stances)
    by_number = {stance["header"]["stamp"]["secs"]: stance for stance in good}
    for arrival in heard:
        _is_image(exam, by_number[_number(arrival)], arrival.fields)
    _complete(exam, wanted, [_number(arrival) for arrival in heard])
    when = {1000 + number: at for number, at in enumerate(sent)}
    slowest = sorted(arrival.at - when[_number(arrival)] for arrival in heard)[len(heard) // 2]
    exam.hold(
        "without delay",
        slowest < PROMPT,
        expected="the image a few milliseconds after the stance",
        seen=f"half of them later than {slowest:.1f} s",
        hints="They come late. Publish in the function, and let nothing in it wait.",
    )


def _number(arrival: Arrival) -> int:
    return int(arrival.fields["header"]["stamp"]["secs"])


def _leaves_out(exam: Exam, images: list[Stance], stances: list[Stance]) -> None:
    bad = {stance["header"]["stamp"]["secs"]: stance for stance in stances if not _is_good(stance)}
    for image in images:
        stance = bad.get(image["header"]["stamp"]["secs"])
        if stance is None:
            continue
        sizes = len(stance["position"]) != len(stance["name"])
        speeds = len(stance["velocity"]) not in (0, len(stance["position"]))
        zeros = not any(image["position"]) and image["position"]
        exam.fail(
            "what is no stance is left out",
            expected="no image of it",
            seen=f"an image of {len(stance['position'])} positions for {len(stance['name'])} joints"
            if sizes
            else f"an image of {len(stance['velocity'])} velocities for {len(stance['position'])} joints"
            if speeds
            else "an image of a number that is not finite",
            hint="Zeros are a stance, too, and the arm would go there. Publish nothing for a broken one."
            if zeros
            else "There are not as many positions as names, so nobody knows which joint stands how: compare "
            "the lengths, and leave the message out."
            if sizes
            else "There are velocities, and not as many as positions: compare these lengths, too. (None at "
            "all are well.)"
            if speeds
            else "nan and inf are no angles, and -nan is none either: math.isfinite tells. Look at the "
            "velocities, too.",
        )
    exam.hold("what is no stance is left out", holds=True)


def _is_image(exam: Exam, stance: Stance, image: Stance) -> None:
    header = {key: image["header"][key] for key in ("stamp", "frame_id")}
    if header != stance["header"]:
        exam.fail(
            "the header stays",
            expected=f"frame_id arm, stamp {_words(stance['header']['stamp'])}",
            seen=f"frame_id {header['frame_id'] or 'none'}, stamp {_words(header['stamp'])}",
            hint="The header says when and of what. Hand all of it on: header=stance.header.",
        )
    exam.expect(
        "the names stay",
        expected=stance["name"],
        seen=image["name"],
        hints={
            (): "The names are missing. Hand them on: name=stance.name.",
        },
    )
    for field in ("position", "velocity"):
        values = stance[field]
        exam.expect(
            f"every {field} has its sign turned",
            expected=[-value for value in values],
            seen=image[field],
            near=1e-9,
            hints=[
                (values, f"The {field} came out as it went in. Turn the sign of each."),
                ([], f"The list is empty: {field} was left out."),
                ([abs(value) for value in values], "A sign that turns makes plus of minus, too: -value."),
                (says(""), "Turn the sign of each number, and nothing else."),
            ],
        )


def _words(stamp: dict[str, int]) -> str:
    return f"{stamp['secs']}.{stamp['nsecs']:09d}"


def _complete(exam: Exam, wanted: list[int], seen: list[int]) -> None:
    exam.expect(
        "every good stance is mirrored, once and in order",
        expected=wanted,
        seen=seen,
        hints=[
            (
                lambda seen: len(set(seen)) < len(seen),
                "Some came more than once. Publish once for each stance.",
            ),
            (
                lambda seen: seen and seen == wanted[: len(seen)] and len(seen) < 5,
                "It ended with the first message that is no stance. Leave that one out, and go on.",
            ),
            (
                lambda seen: set(wanted) - set(seen) <= {1000 + 5 * n for n in range(6)},
                "A stance without velocities is a good one: many robots send none. Only where there are some "
                "do they have to be as many as the positions.",
            ),
            (
                lambda seen: seen == wanted[-len(seen) :],
                "The first are missing. Make the publisher before the subscriber, and not in the function.",
            ),
            (
                says(""),
                "Some were left out. Mirror each in the function: a loop with a pause sees only some.",
            ),
        ],
    )
