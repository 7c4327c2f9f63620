"""06.1: the client that makes a single call."""

from collections.abc import Sequence

from course_pkg.chapters.ch06_write_a_client.checks.boxes import GEOMETRY, volumes
from course_pkg.checking import ANYTHING, CheckContext, Refuse, matches, part
from course_pkg.checking.assertions import same
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.plain_values import Fields
from course_pkg.checking.shared.geometry import boxes
from course_pkg.ros.protocol.json_channel import Json

CALLED = "Call the given service once, with length, width and height."
RETURNED = "Return the area and the volume from the response."


@part(
    "06.1",
    points=2,
    goal="Call the given service, and return the area and the volume from its response.",
    needs=["measure"],
    goals=[CALLED, RETURNED],
)
def the_geometry_client(context: CheckContext) -> None:
    """Respond with random numbers; the student's function can know these numbers only from the response."""
    for _ in range(2):
        name = f"/{context.random.word()}"
        response: dict[str, float] = {}
        server = context.serve(name, GEOMETRY, lambda _, response=response: response)
        first, *others = boxes(context, context.random.integer(2, 4))
        # The check would accept rounded sides if all sides had two decimals.
        first = [side + context.random.number(1e-4, 4e-4, digits=5) for side in first]
        for number, sides in enumerate([first, first, *others]):
            area, volume = volumes(context, 2)
            response.update(area=area, volume=volume)
            before = len(server.requests)
            returned = context.run("measure", name, *sides, hints=_UNAVAILABLE).returned()
            requests = server.requests[before:]
            _is_called_once(context, requests, sides, repeated=number == 1)
            with context.goal(RETURNED):
                _is_returned(context, returned, area, volume, sides)
    name = f"/{context.random.word()}"
    server = context.serve(name, GEOMETRY, lambda _: Refuse("not today"))
    context.run("measure", name, *context.random.numbers(3, 0.5, 9.0))
    context.require(
        "the service is called once",
        holds=len(server.requests) == 1,
        expected="one call of a service that refuses the request",
        actual=f"{len(server.requests)} calls",
        hints=(
            "The server refused the request, and the function called the server again. Call the service "
            "once, and do not catch the exception."
        ),
    )
    context.fulfilled(CALLED)


def _is_called_once(
    context: CheckContext, requests: Sequence[Fields], sides: Sequence[float], *, repeated: bool
) -> None:
    """Assert that one call of measure() sent one request, and that this request contains these sides.

    `repeated` is True if the previous call of measure() had the same sides.
    """
    context.require(
        "the given service is called",
        holds=repeated or bool(requests),
        expected="a call of the given service",
        actual="no call",
        hints=(
            "The given service was not called. Create the proxy with the name in "
            "`service`, and call the proxy with the three sides."
        ),
    )
    context.expect(
        "the service is called once",
        expected=1,
        actual=len(requests),
        hints=[
            (
                0,
                "The check called measure() twice with the same sides, but the second time, your "
                "function did not call the service. Call the service each time measure() runs.",
            ),
            (
                ANYTHING,
                "The function called the service more than once, so the server did the work "
                "again. Call the service once, and store the response in a variable.",
            ),
        ],
    )
    context.expect(
        "the request has length, width and height",
        expected=dict(zip(("length", "width", "height"), sides, strict=True)),
        actual=requests[0],
        near=1e-6,
        hints=[
            (
                lambda actual: 0.0 in actual.values(),
                "A side in the request is 0, because ROS sends 0 for a number that you do not set. "
                "Set all three sides.",
            ),
            (
                lambda actual: same([*sides], [*actual.values()], near=1e-3),
                "A side in the request is nearly equal to the argument of measure(), but not equal. Send the "
                "three arguments without rounding them.",
            ),
            (
                lambda actual: not same([*sorted(sides)], sorted(actual.values()), near=1e-6),
                "The numbers in the request differ from the arguments of measure(). Send the three "
                "arguments in every call.",
            ),
            (
                ANYTHING,
                "The server received the sides in the wrong order. Pass the sides as keyword arguments.",
            ),
        ],
    )


def _is_returned(
    context: CheckContext, returned: Json, area: float, volume: float, sides: Sequence[float]
) -> None:
    context.expect(
        "area and volume are returned, in this order",
        expected=[area, volume],
        actual=returned,
        near=1e-9,
        hints=[
            (None, NO_RETURN),
            (
                {"area": area, "volume": volume},
                "The function returned the whole response. Return only the fields "
                "`area` and `volume` of the response.",
            ),
            (
                [volume, area],
                "The order of the results is wrong. Return the area first, and then the volume.",
            ),
            (
                lambda actual: not isinstance(actual, list),
                "The function returned only one number. Return the area and the "
                "volume, with a comma between them.",
            ),
            (
                [*sides[:2]],
                "The function returned fields of the request. Read `area` and `volume` from the response.",
            ),
            (
                ANYTHING,
                "Return the area and the volume of the response. Do not compute or round these numbers.",
            ),
        ],
    )


_UNAVAILABLE = [
    (
        matches("unavailable"),
        "The given service exists, but your function called a different service. Create the "
        "proxy with the name in `service`.",
    )
]
