"""The geometry servers: one server measures every box, and the other server refuses impossible boxes."""

import re
from collections.abc import Callable, Mapping
from itertools import combinations
from math import prod

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints, same
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.shared.geometry import NEAR, is_rounded, near_to, random_boxes
from course_pkg.checking.shared.served_by import require_served_by_notebook, require_still_served

SIDES = ("length", "width", "height")
NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
# In an error message, an exact value may differ from the side by this number of metres.
EXACT = 1e-6
SLIGHTLY = -1e-5  # A negative side above this number of metres is only slightly negative.
# A message may contain at most this many numbers. If a message contains many numbers, one of them may equal
# the right value by chance.
MANY = 6
# The pattern matches an error message from the student's handler, but no message of rospy itself.
OWN_TEXT = "cannot process request: (?!(service )?handler returned)"
WHOLE = (
    "Your handler uses only whole numbers for the sides. Multiply the sides with all their digits after the "
    "decimal point."
)
AREA, VOLUME = "Return the area of the floor.", "Return the volume."
MEASURED = "Return the area and the volume of a box without a negative side."
REFUSED = "Refuse a negative side with a rospy.ServiceException."
NAMED = "Write the name and the value of the side in the error message."


@part(
    "05.1",
    points=2,
    goal="Serve /getGeometry, and return the area of the floor and the volume of a box.",
    needs=["handle_geometry|geometry_service"],
    goals=[AREA, VOLUME],
)
def area_and_volume(context: CheckContext) -> None:
    """Send boxes of several sizes; in all boxes except one, the three sides are different."""
    get_geometry = context.service("/getGeometry", "course_pkg/geometry")
    require_served_by_notebook(context, "/getGeometry")
    boxes = random_boxes(context)
    for number, (length, width, height) in enumerate(boxes, 1):
        if number == len(boxes):
            require_still_served(context, "/getGeometry")
        response = get_geometry(length=length, width=width, height=height)
        with context.goal(AREA):
            context.expect(
                "area is width times length",
                expected=width * length,
                actual=response.area,
                near=near_to(width * length),
                hints=_about_area(width, length, height),
            )
        with context.goal(VOLUME):
            context.expect(
                "volume is area times height",
                expected=width * length * height,
                actual=response.volume,
                near=near_to(width * length * height),
                hints=_about_volume(width, length, height),
            )


def _about_volume(width: float, length: float, height: float) -> Hints:
    area = width * length
    return [
        (_product_of_whole(width, length, height), WHOLE),
        (
            0.0,
            (
                "The volume is 0, because ROS sends 0 for a number that you do not set. Set the field "
                "`volume`."
            ),
        ),
        (
            area,
            "The field `volume` contains the area. Set this field to the product of all three sides.",
        ),
        (area + height, "Your volume is area + height. Multiply by the height; do not add the height."),
        (
            area * height * 1e6,
            ("Your volume is in cubic centimetres. Do not convert the sides: return cubic metres."),
        ),
        (
            is_rounded(area * height),
            "Your volume is rounded. Return all digits of the volume.",
        ),
        (ANYTHING, "The volume is wrong. Multiply all three sides: width, length and height."),
    ]


def _product_of_whole(*sides: float) -> Callable[[float], bool]:
    """Return a condition for the product of the sides without their digits after the decimal point.

    If this product is 0 or the rounded right value, the condition is false, because other mistakes are more
    probable.
    """
    product, right = prod(map(int, sides)), prod(sides)
    return lambda actual: actual == product and product not in (0, int(right), round(right))


def _about_area(width: float, length: float, height: float) -> Hints:
    return [
        (_product_of_whole(width, length), WHOLE),
        (0.0, "The area is 0, because ROS sends 0 for a number that you do not set. Set the field `area`."),
        (width + length, "Your area is width + length. Multiply the two sides; do not add them."),
        (
            lambda actual: any(same(actual, side * height, NEAR) for side in (width, length)),
            "Your area is the area of a wall. Return the area of the floor, which is width times length.",
        ),
        (
            width * length * height,
            "The field `area` contains the volume. In the response, the area comes first, and "
            "then the volume.",
        ),
        (
            width * length * 1e4,
            ("This area is in square centimetres. Do not convert the sides, because they are in metres."),
        ),
        (
            is_rounded(width * length),
            "The area is rounded. Return the area without rounding.",
        ),
        (
            ANYTHING,
            "The area is wrong. Return the area of the floor, which has the sides width and length.",
        ),
    ]


@part(
    "05.3",
    points=2,
    goal=(
        "Serve /getGeometryChecked. Refuse a negative side with an error message that contains "
        "the name and the value of the side."
    ),
    needs=["handle_checked_geometry|checked_service"],
    goals={MEASURED: 1, REFUSED: 2, NAMED: 1},
)
def a_box_that_cannot_be(context: CheckContext) -> None:
    """Send a normal box, a small box, three boxes with a side of 0, and boxes with negative sides."""
    get_geometry = context.service(
        "/getGeometryChecked",
        "course_pkg/geometry",
        hints=[
            (
                matches(OWN_TEXT),
                "The handler refused a box without a negative side. Refuse only values below "
                "zero, and not zero itself.",
            )
        ],
    )
    require_served_by_notebook(context, "/getGeometryChecked")
    small = dict(zip(SIDES, context.random.numbers(3, 0.02, 0.4, digits=3), strict=True))
    for given in ({}, *({flat: 0.0} for flat in SIDES), small):
        _measured(context, get_geometry, _box(context, given))
    context.fulfilled(MEASURED)
    # A float32 stores the negative sides exactly. One of them has ten decimals, so a rounded value is wrong.
    fraction = context.random.choice([0.25, 0.375, 0.75])
    depths = [*(-depth - fraction for depth in context.random.integers(2, 1, 49)), -1 / 1024]
    for side, depth in zip(context.random.shuffled(SIDES), depths, strict=True):
        _refused(context, get_geometry, {side: depth})
    _refused(context, get_geometry, {context.random.choice(SIDES): -(2.0 ** -context.random.integer(20, 40))})
    require_still_served(context, "/getGeometryChecked")
    for pair in combinations(SIDES, 2):
        _refused(context, get_geometry, dict(zip(pair, context.random.shuffled(depths[:2]), strict=True)))
    context.fulfilled(REFUSED)


def _box(context: CheckContext, given: Mapping[str, float]) -> dict[str, float]:
    drawn = zip(SIDES, context.random.numbers(3, 0.5, 9.0), strict=True)
    return {side: given.get(side, value) for side, value in drawn}


def _measured(context: CheckContext, get_geometry: Service, sides: Mapping[str, float]) -> None:
    response = get_geometry(**sides)
    area = sides["width"] * sides["length"]
    for right, actual in ((area, response.area), (area * sides["height"], response.volume)):
        context.expect(
            "the handler measures a box without negative sides",
            expected=right,
            actual=actual,
            near=near_to(right),
            hints=[
                (
                    is_rounded(right),
                    "The area or the volume of a box is not exact. Return the same numbers as the handler of "
                    "/getGeometry, without rounding.",
                )
            ],
        )


def _refused(context: CheckContext, get_geometry: Service, negative: Mapping[str, float]) -> None:
    """Assert that a box is refused; `negative` contains its negative sides and their values.

    The error message must contain the name of the first negative side.
    """
    error = get_geometry.refused(
        "the handler refuses a negative side",
        saying="responded with an error",
        hints=[
            (
                lambda actual: isinstance(actual, dict) and max(negative.values()) > SLIGHTLY,
                "The server measured a box with a side that is only slightly negative. Compare each side "
                "with exactly 0.",
            ),
            (
                lambda actual: isinstance(actual, dict),
                "The server measured a box with a negative side. Before you calculate, compare each "
                "side with zero, and refuse each negative value, for example -0.5.",
            ),
        ],
        **_box(context, negative),
    )
    context.require(
        "the handler raises a rospy.ServiceException",
        holds=bool(matches(OWN_TEXT).search(error)),
        expected="service cannot process request: …, with your own message",
        actual=error,
        hints=[
            (
                matches("error processing request"),
                "The handler raised an exception of the wrong type. Raise "
                "rospy.ServiceException to refuse a request.",
            ),
            (
                matches("returned None"),
                "The handler returned None, so the error message is from rospy. Raise "
                "rospy.ServiceException with your own message.",
            ),
            (
                matches("handler returned"),
                "The handler returned a value that is not a response. Do not return the exception: "
                "raise the exception.",
            ),
        ],
    )
    side, value = next(iter(negative.items()))
    reason = error.lower().partition("process request:")[2]
    named = [name for name in SIDES if name in reason]
    numbers = [float(number) for number in re.findall(NUMBER, reason)]
    with context.goal(NAMED):
        context.require(
            "the error message contains the name and the value of the side",
            holds=named == [side]
            and len(numbers) <= MANY
            and any(abs(number - value) < EXACT for number in numbers),
            expected=f"a message that contains {side} and {value:g}, and no other side",
            actual=error,
            hints=_unclear(named, numbers, side, value, reason),
        )


def _unclear(named: list[str], numbers: list[float], side: str, value: float, reason: str) -> str:
    """Return the hint for a wrong error message.

    The right message contains the negative side's name `side` and its `value`, but no other side's name.
    `named` contains the sides in the error message, and `numbers` contains the numbers in this message.
    """
    if len(numbers) > MANY:
        return "The message contains too many numbers. Write only the value of the negative side."
    if "{" in reason:
        return (
            "The message contains braces. Write the letter f before the string, so that Python replaces "
            "the names in braces with their values."
        )
    if len(named) > 1 and side in named:
        return (
            "The message contains the names of more than one side. Write only the name of the "
            "first negative side."
        )
    if not named:
        return (
            "The message does not contain the name of a side. Write the name of the negative side "
            "and its value."
        )
    if named != [side]:
        return (
            "The message contains the name of the wrong side. Write the name of the first "
            "negative side, in the order of the fields."
        )
    if any(abs(number - value) < 1 for number in numbers):
        return "The message contains a rounded value. Write the value with all digits after the point."
    return "The message does not contain the value of the side. Write the value after the name."
