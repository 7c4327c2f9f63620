"""06.1: the client that makes a single call."""

from course_pkg.chapters.ch06_write_a_client.checks.boxes import GEOMETRY, volumes
from course_pkg.checking import ANYTHING, CheckContext, Refuse, matches, part
from course_pkg.checking.common_hints import NO_RETURN

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
        length, width, height = context.random.numbers(3, 0.5, 9.0)
        area, volume = volumes(context, 2)
        server = context.serve(name, GEOMETRY, lambda _, a=area, v=volume: {"area": a, "volume": v})
        returned = context.run("measure", name, length, width, height, hints=_UNAVAILABLE).returned()
        context.require(
            "the given service is called",
            holds=bool(server.requests),
            expected=f"a call of {name}",
            actual="no call",
            hints=(
                "The given service was not called. Create the proxy with the name in "
                "`service`, and call the proxy with the three sides."
            ),
        )
        context.expect(
            "it is called once",
            expected=1,
            actual=len(server.requests),
            hints=(
                "The function called the service more than once, so the server did the work "
                "again. Call the service once, and store the response in a variable."
            ),
        )
        context.expect(
            "the request has length, width and height",
            expected={"length": length, "width": width, "height": height},
            actual=server.requests[0],
            near=1e-4,
            hints=[
                (
                    lambda actual: 0.0 in actual.values(),
                    "The request contains 0 for a side, because a field without a value is 0. "
                    "Set all three sides.",
                ),
                (
                    ANYTHING,
                    "The server received the sides in the wrong order. Pass the sides as keyword arguments.",
                ),
            ],
        )
        with context.goal(RETURNED):
            context.expect(
                "area and volume are returned, in this order",
                expected=[area, volume],
                actual=returned,
                near=1e-6,
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
                        [length, width],
                        "The function returned fields of the request. Read `area` and `volume` "
                        "from the response.",
                    ),
                    (
                        ANYTHING,
                        "Return the area and the volume of the response. Do not compute or "
                        "round these numbers.",
                    ),
                ],
            )
        context.run("measure", name, length, width, height).returned()
        context.expect(
            "it is called once",
            expected=1,
            actual=len(server.requests) - 1,
            hints=(
                "A second call of measure() with the same sides returned the response of the first "
                "call. Call the service each time measure() runs."
            ),
        )
    name = f"/{context.random.word()}"
    server = context.serve(name, GEOMETRY, lambda _: Refuse("not today"))
    context.run("measure", name, *context.random.numbers(3, 0.5, 9.0))
    context.require(
        "it is called once",
        holds=len(server.requests) == 1,
        expected="one call of a service that refuses the request",
        actual=f"{len(server.requests)} calls",
        hints=(
            "The server refused the request, and the function called the server again. Call the service "
            "once, and do not catch the exception."
        ),
    )
    context.fulfilled(CALLED)


_UNAVAILABLE = [
    (
        matches("unavailable"),
        "The given service exists, but your function called a different service. Create the "
        "proxy with the name in `service`.",
    )
]
