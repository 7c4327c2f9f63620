"""The geometry servers: one that measures every box, and one that refuses what can be none."""

import re
from collections.abc import Mapping
from itertools import combinations

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.calls import Service

SIDES = ("length", "width", "height")
OWN_WORDS = "cannot process request: (?!(service )?handler returned)"  # else rospy found the words


@part(
    "05.1",
    points=2,
    goal="Answer /getGeometry with the area and the volume of a box.",
    needs=["handle_geometry"],
)
def area_and_volume(exam: Exam) -> None:
    """Send three boxes of three different sides each."""
    get_geometry = exam.service("/getGeometry", "course_pkg/geometry")
    for _ in range(3):
        length, width, height = exam.draw.numbers(3, 0.5, 9.0)
        response = get_geometry(length=length, width=width, height=height)
        exam.expect(
            "area is width times length",
            expected=width * length,
            seen=response.area,
            near=1e-3,
            hints={
                0.0: "The area is 0, as a field is that never gets a value.",
                width + length: "That is width + length. An area is a product.",
                2 * (width + length): "That is the way around the floor. An area is a product.",
                width * height: "That is the front of the box, width times height, and not its floor.",
                length * height: "That is a side of the box, length times height, and not its floor.",
                width * length * height: "That is the volume. The response has area first, then volume.",
                (
                    lambda seen, area=width * length: abs(seen - area) <= 1
                ): "It is rounded. Return it as it is.",
                says(""): "The floor of the box is meant: width times length.",
            },
        )
        exam.expect(
            "volume is area times height",
            expected=width * length * height,
            seen=response.volume,
            near=1e-3,
            hints={
                0.0: "The volume is 0, as a field is that never gets a value.",
                width + length + height: "That is the sum of the sides. A volume is their product.",
                width * length + height: "That is area + height. A volume is a product.",
                width * length: "That is the area once more: multiply it by the height.",
                says(""): "Multiply all three sides: width, length and height.",
            },
        )


@part(
    "05.3",
    points=2,
    goal="Answer /getGeometryChecked as before, but refuse a negative side, and name it.",
    needs=["handle_checked_geometry"],
)
def a_box_that_cannot_be(exam: Exam) -> None:
    """Send a good box and three flat ones; then each side negative in turn, and each two of them."""
    get_geometry = exam.service(
        "/getGeometryChecked",
        "course_pkg/geometry",
        hints={says(OWN_WORDS): "This box can be. Zero is fine; less is not."},
    )
    for flat in ("", *SIDES):
        sides = _box(exam, {flat: 0.0})
        response = get_geometry(**sides)
        area = sides["width"] * sides["length"]
        exam.expect(
            "a box that can be is measured",
            expected=[area, area * sides["height"]],
            seen=[response.area, response.volume],
            near=1e-3,
        )
    depths = [*(-float(depth) for depth in exam.draw.integers(2, 2, 9)), -0.5]
    for side, depth in zip(exam.draw.shuffled(SIDES), depths, strict=True):
        _refused(exam, get_geometry, {side: depth})
    for pair in combinations(SIDES, 2):
        _refused(exam, get_geometry, dict(zip(pair, exam.draw.shuffled(depths[:2]), strict=True)))


def _box(exam: Exam, given: Mapping[str, float]) -> dict[str, float]:
    drawn = zip(SIDES, exam.draw.numbers(3, 0.5, 9.0), strict=True)
    return {side: given.get(side, value) for side, value in drawn}


def _refused(exam: Exam, get_geometry: Service, negative: Mapping[str, float]) -> None:
    """Hold that a box is refused in words that name the first of its negative sides."""
    words = get_geometry.refused(
        "a negative side is refused",
        saying="responded with an error",
        hints={
            (
                lambda seen: isinstance(seen, dict)
            ): "It was measured like any other. Compare each side with zero, as it came: -0.5 is negative.",
        },
        **_box(exam, negative),
    )
    exam.hold(
        "the refusal is a rospy.ServiceException",
        bool(says(OWN_WORDS).search(words)),
        expected="service cannot process request: …, in words of your own",
        seen=words,
        hints={
            says(
                "error processing request"
            ): "Another exception came out of the handler. Only rospy.ServiceException "
            "reads as a refusal; any other reads as a fault.",
            says(
                "returned None"
            ): "The handler returned None, so rospy found the words. Raise rospy.ServiceException "
            "with words of your own.",
            says(
                "handler returned"
            ): "What the handler returned is no response, so rospy found the words. Do not return the "
            "refusal, raise it: raise rospy.ServiceException(...).",
        },
    )
    side, value = next(iter(negative.items()))
    reason = words.lower().partition("process request:")[2]
    named = [name for name in SIDES if name in reason]
    exam.hold(
        "the words name the side and its value",
        named == [side] and value in map(float, re.findall(r"-?\d+(?:\.\d+)?", reason)),
        expected=f"words with {side} and {value:g} in them, and no other side",
        seen=words,
        hints=_unclear(named, side),
    )


def _unclear(named: list[str], side: str) -> str:
    """Return what to do about words that name the sides in `named` where they should name `side`."""
    if not named:
        return "The client can't know which side was wrong. Name it, and say its value."
    if named != [side]:
        return "Name the first negative side, in the order length, width, height, and no other."
    return "The side is named. Say its value, too, as it came."
