"""The checks of chapter 06: the student's clients, served from outside."""

from course_pkg.examiner import Exam, part


@part(
    "06.1",
    points=2,
    goal="Return the area and the volume that the service answers.",
    needs=["measure"],
)
def asks_and_returns(exam: Exam) -> None:
    """Only the service knows the numbers: nothing in the request leads to them."""
    service = f"/geometry_{exam.draw.word()}"
    area, volume = exam.draw.numbers(2, 100, 900)
    server = exam.serve(service, "course_pkg/geometry", lambda _: {"area": area, "volume": volume})
    length, width, height = exam.draw.numbers(3, 0.5, 9.0)
    value = exam.run("measure", service, length, width, height).value
    exam.expect(
        "it asks the service that it is given, once, with each side in its field",
        expected=[{"length": length, "width": width, "height": height}],
        seen=server.requests,
        near=1e-4,
        hints=[
            ([], "The service was not asked: the numbers have to come from it, whatever its name."),
            (
                [{"length": width, "width": length, "height": height}],
                "length and width are swapped: positional arguments go in the order of the .srv file.",
            ),
            (lambda seen: any(0.0 in request.values() for request in seen), "A field that is left out is 0."),
            (lambda seen: len(seen) > 1, "Ask once and keep the response: each call costs the server work."),
        ],
    )
    exam.expect(
        "it returns area and volume as the service answered them",
        expected=[area, volume],
        seen=value,
        near=1e-4,
        hints=[
            (None, "It returns nothing: to print a value is not to return it."),
            ({"area": area, "volume": volume}, "That is the whole response; take area and volume out of it."),
            ([volume, area], "The order is area, then volume."),
            (area, "That is the area alone: return both, as in `return area, volume`."),
            (volume, "That is the volume alone: return both, as in `return area, volume`."),
        ],
    )
