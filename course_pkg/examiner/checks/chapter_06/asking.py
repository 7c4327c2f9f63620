"""The client that asks once."""

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.checks.chapter_06.boxes import GEOMETRY, NO_RETURN, volumes


@part(
    "06.1",
    points=2,
    goal="Return the area and the volume that the service answers with.",
    needs=["measure"],
)
def the_geometry_client(exam: Exam) -> None:
    """Serve twice, with answers of their own, so that only asking helps."""
    for _ in range(2):
        name = f"/{exam.draw.word()}"
        length, width, height = exam.draw.numbers(3, 0.5, 9.0)
        area, volume = volumes(exam, 2)
        server = exam.serve(name, GEOMETRY, lambda _, a=area, v=volume: {"area": a, "volume": v})
        returned = exam.run("measure", name, length, width, height, hints=_UNAVAILABLE).value
        exam.hold(
            "the service that was named is called",
            bool(server.requests),
            expected=f"a call of {name}",
            seen="no call of it",
            hints="Make the proxy with the name in `service`, and call it with the three sides.",
        )
        exam.expect(
            "it is called once",
            expected=1,
            seen=len(server.requests),
            hints=(
                "Call once and keep the response; each call makes the server work, and makes you wait, again."
            ),
        )
        exam.expect(
            "the request holds length, width and height",
            expected={"length": length, "width": width, "height": height},
            seen=server.requests[0],
            near=1e-4,
            hints={
                (lambda seen: 0.0 in seen.values()): "By name, a field that is left out is 0 without a word.",
                says(""): "The sides arrived in another order than length, width, height.",
            },
        )
        exam.expect(
            "area and volume are returned, in this order",
            expected=[area, volume],
            seen=returned,
            near=1e-6,
            hints=[
                (None, NO_RETURN),
                (
                    {"area": area, "volume": volume},
                    "That is the whole response. Return its area and its volume.",
                ),
                ([volume, area], "That is the volume first."),
                (lambda seen: not isinstance(seen, list), "Return the two with a comma between them."),
                (lambda seen: any(isinstance(each, str) for each in seen), "Return numbers, and no texts."),
                ([length, width], "Those are fields of the request. Read them from the response."),
                (says(""), "This server measures in its own way: return what it says, unchanged."),
            ],
        )


_UNAVAILABLE = {
    says("unavailable"): "The service that was named is there. Make the proxy with the name in `service`."
}
