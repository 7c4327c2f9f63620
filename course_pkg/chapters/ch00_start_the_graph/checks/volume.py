"""00.2: a function that returns the volume from the response of a service."""

from collections.abc import Sequence
from math import prod

from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.assertions import Hints, same
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.shared.geometry import boxes, is_rounded

FLOAT32 = 1e-6  # A side that is stored as a float32 has a smaller relative error than this number.
ROUNDED = "The returned volume has fewer digits than the volume in the response. Do not round the volume."


@part(
    "00.2",
    points=2,
    goal="Return the volume from the response of a service.",
    needs=["ask_for_volume"],
    runs=["server"],
)
def ask_a_question(context: CheckContext) -> None:
    """Respond with random volumes; the student's function can know a volume only from the response.

    The second request contains the same sides as the first request, but its response contains a new volume.
    """
    for _ in range(2):
        name = f"/{context.random.word()}"
        response: dict[str, float] = {}
        server = context.serve(name, "course_pkg/geometry", lambda _, response=response: response)
        _, *others = boxes(context, context.random.integer(2, 4))
        # These lengths have four decimals, so a function that rounds them fails.
        first = context.random.numbers(3, 0.5, 9.0, digits=4)
        for number, sides in enumerate([first, first, *others]):
            area, volume = (
                (2 * whole + 1) / 2048 for whole in context.random.integers(2, 1000, 9000)
            )  # A float32 stores the area and the volume exactly. Each number has eleven decimals.
            response.update(area=area, volume=volume)
            before = len(server.requests)
            returned = context.run("ask_for_volume", name, *sides).returned()
            requests = server.requests[before:]
            context.require(
                "the given service is called",
                holds=bool(requests),
                expected=f"a call of {name}",
                actual="no call",
                hints=(
                    "The check called ask_for_volume() twice with the same sides, but the second "
                    "time, your function did not call the service. Call the service each time your "
                    "function runs."
                )
                if number == 1
                else (
                    "Your function did not call the given service. Pass the argument `service` "
                    "to rospy.ServiceProxy."
                ),
            )
            named = dict(zip(("length", "width", "height"), sides, strict=True))
            for request in requests:
                context.expect(
                    "the sides are sent in the order length, width, height",
                    expected=named,
                    actual=request,
                    near=FLOAT32,
                    hints=_other_sides(named),
                )
            context.expect(
                "the volume of the response is returned",
                expected=volume,
                actual=returned,
                near=1e-9,
                hints=_no_volume(area, volume, sides),
            )


def _other_sides(sides: dict[str, float]) -> Hints:
    """Return hints for a request with wrong values; the dict `sides` contains the right values."""
    return [
        (
            lambda actual: 0.0 in actual.values(),
            (
                "One side in the request is 0, because ROS sends 0 for a number that you do not set. "
                "Set all three sides."
            ),
        ),
        (
            lambda actual: not same([*sorted(sides.values())], sorted(actual.values()), near=FLOAT32),
            (
                "The numbers in the request differ from the arguments of your function. Send the arguments "
                "unchanged."
            ),
        ),
        (
            ANYTHING,
            "The order of the sides in the request is wrong. Compare this order with "
            "the output of `rossrv show course_pkg/geometry`.",
        ),
    ]


def _no_volume(area: float, volume: float, sides: Sequence[float]) -> Hints:
    """Return hints for a returned value that is not `volume`, the volume in the response."""
    return [
        (None, NO_RETURN),
        (area, "Your function returned the area. Return the volume."),
        (
            area * sides[2],
            (
                "Your function multiplied the area in the response by the height. Return the field `volume` "
                "of the response."
            ),
        ),
        (
            prod(sides),
            (
                "Your function multiplied the sides, but the server of this check returns a "
                "different volume. Return the volume from the response of the server."
            ),
        ),
        (int(volume), ROUNDED),
        (is_rounded(volume), ROUNDED),
        (
            lambda actual: "volume" in actual,
            ("Your function returned the whole response. Return only the field `volume` of the response."),
        ),
        (
            lambda actual: volume in actual,
            "Your function returned more than the volume. Return only the volume.",
        ),
        (
            lambda actual: str(volume) in actual,
            "Your function returned the volume as a string. Return the volume as a number.",
        ),
        (ANYTHING, "Return the volume from the response without any change."),
    ]
