"""Names are made full, and given."""

import time

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.graph.snapshot import ServiceSeen

GEOMETRY = "course_pkg/geometry"
NO_RETURN = "None was returned, as by a function that comes to its end without a return line."
PATIENCE = 15.0  # s for a program to start; it takes 0.5 s, and more on a machine that is busy
NOT_STARTED = {
    says("NodeFailed"): "The service that it waited for did not come. What it printed says where it serves.",
    says("UnknownExecutable"): "The program is server, in the package course_pkg.",
}
MISSING = "A slash is missing between the namespace and what follows it."
AS_WRITTEN = "It came back as it was written. Only a slash in front makes a name global, not one within it."
ONCE = "In front of it stands the whole namespace of the node, once."
PARTS = "A name may have several parts, such as arm/image. All of them stay."
ROOM_KEEPER = """
kept = []


def start_a_room(start_in, room):
    kept.append(start_in(room))
    return hasattr(kept[-1], "stop")


def end_all_rooms():
    while kept:
        process = kept.pop()
        if hasattr(process, "stop"):
            process.stop()
"""


@part(
    "01.1",
    points=2,
    goal="Make the full name of a relative, a global or a private name.",
    needs=["full_name"],
)
def resolve_names(exam: Exam) -> None:
    """Try the three ways of writing in namespaces of different depth, then names of several parts."""
    image, name, robot, side = (exam.draw.word() for _ in range(4))
    rooms = {"/": "", f"/{side}": f"/{side}", f"/{robot}/{side}": f"/{robot}/{side}"}
    for namespace, before in rooms.items():
        _resolves(exam, "a global name is itself", f"/{image}", namespace, name, f"/{image}", before)
        rule = "a relative name goes into the namespace of the node"
        _resolves(exam, rule, image, namespace, name, f"{before}/{image}", before)
        rule = "a private name goes under the name of the node"
        _resolves(exam, rule, f"~{image}", namespace, name, f"{before}/{name}/{image}", before)
    deep = f"{exam.draw.word()}/{image}"
    rule = "a name of several parts is resolved like any other"
    _resolves(exam, rule, deep, f"/{side}", name, f"/{side}/{deep}", f"/{side}")
    _resolves(exam, rule, f"~{deep}", f"/{side}", name, f"/{side}/{name}/{deep}", f"/{side}")
    _resolves(exam, rule, f"/{deep}", f"/{side}", name, f"/{deep}", f"/{side}")


def _resolves(exam: Exam, rule: str, written: str, namespace: str, name: str, full: str, before: str) -> None:
    """Hold that `written` becomes `full`; `before` is the namespace without a slash at its end."""
    bare = written.lstrip("/~")
    exam.expect(
        rule,
        expected=full,
        seen=exam.run("full_name", written, namespace, name).value,
        hints=[
            (None, NO_RETURN),
            (lambda seen: isinstance(seen, list), "Those are several. Return one text."),
            (says("chapter_01"), "That is how this notebook means it. The node in question is another."),
            (says("//"), "Two slashes follow one another. The outermost namespace is / and ends in one."),
            (says("~"), "The ~ is still in it. It stands for the name of the node, and gives way to it."),
            (written if "/" in written[1:] else "", AS_WRITTEN),
            (says("^[^/]"), "A full name starts with a slash."),
            (says("./$"), "A full name does not end in a slash."),
            ({f"{before}{bare}", f"{before}{name}/{bare}"}.__contains__, MISSING if before else ""),
            *_misplaced(written[0], f"{before}/{name}", f"/{name}", bare),
        ],
    )


def _misplaced(kind: str, node: str, alone: str, bare: str) -> list[tuple[object, str]]:
    """Return hints for a name in a wrong place; `node` is the node's full name, `alone` without namespace."""
    if kind == "/":
        return [(says(""), "A global name is complete: return it as it is.")]
    if kind == "~":
        return [
            (
                f"{alone}/{bare}",
                "The node stands in a namespace itself: that comes first, then the node's name.",
            ),
            (says(f"^{alone}/.*/{bare}$"), "The namespace comes first, and then the node's name."),
            (says(f"{alone}/{bare}$"), ONCE),
            (says(f"/{bare}$"), "A private name belongs to the node: its name comes in between."),
            (says(""), PARTS),
        ]
    return [
        (f"{node}/{bare}", "Only a private name goes under the name of the node."),
        (f"/{bare}", "The namespace is missing. Only a global name goes without it."),
        (says(f"/{bare}$"), ONCE),
        (says(""), PARTS),
    ]


@part(
    "01.2",
    points=2,
    goal="Start a server for a room, as the node measurer with the service measure in the room's namespace.",
    needs=["start_in"],
    deadline=45.0,
)
def a_measurer_for_each_room(exam: Exam) -> None:
    """Start two rooms, look for both on the graph, and call both: the second must not end the first."""
    exam.prepare(ROOM_KEEPER)
    rooms = [exam.draw.word() for _ in range(2)]
    try:
        for room in rooms:
            before = {service.uri for service in exam.look().services}
            started = exam.run(
                "start_a_room", Its("start_in"), room, worded="start_in(room)", within=15.0, hints=NOT_STARTED
            )
            exam.expect(
                "the process is returned",
                expected=True,
                seen=started.value,
                hints="Return what node.run returns, so that whoever started it can stop it.",
            )
            _serves(exam, room, before)
        for room in rooms:
            exam.hold(
                "the measurers of two rooms run side by side",
                exam.look().node(f"/{room}/measurer") is not None,
                expected="both nodes on the graph",
                seen=f"/{room}/measurer is gone",
                hints="The second one ended the first. A node's full name has to be its own.",
            )
            length, width, height = exam.draw.numbers(3, 0.5, 9.0)
            measure = exam.service(f"/{room}/measure", GEOMETRY)
            exam.expect(
                "the service of a room measures boxes",
                expected=length * width,
                seen=measure(length=length, width=width, height=height).area,
                near=1e-3,
            )
    finally:
        exam.run("end_all_rooms")


def _serves(exam: Exam, room: str, before: set[str]) -> None:
    """Hold that the room's service comes, and belongs to the room's node; at `before` there are others."""
    wanted, node = f"/{room}/measure", f"/{room}/measurer"
    deadline, service = time.monotonic() + PATIENCE, None
    new: list[ServiceSeen] = []
    while service is None and time.monotonic() < deadline:
        seen = exam.look()
        service = seen.service(wanted)
        others = [other for other in seen.services if other.uri not in before and other.type == GEOMETRY]
        new = new or others  # one that was seen may be too busy to tell its type at the last look
        deadline = min(deadline, time.monotonic() + 1.0) if new else deadline
    if service is None:
        exam.fail(
            "the service of a room is measure, in the namespace of the room",
            expected=wanted,
            seen=new[0].name if new else "no new service",
            hint=_astray(room, new[0].name if new else ""),
        )
    exam.hold("the service of a room is measure, in the namespace of the room", True)
    exam.expect(
        "the node of a room is measurer, in the namespace of the room",
        expected=node,
        seen=service.node,
        hints={
            says(
                "SERVER_NODE"
            ): "That is the name that the program proposes. __name:=measurer gives it another.",
            "/measurer": "The node is not in the namespace of the room. __ns:= moves all of it.",
            says(""): "The namespace is that of the room, and the name measurer.",
        },
    )


def _astray(room: str, found: str) -> str:
    """Return what to do about a service that is called `found` where it should be measure of the room."""
    if not found:
        return 'The program that serves one is server: node.run("course_pkg", "server", …).'
    if found == "/measure":
        return "It is /measure for every room. With a slash in front it is global, and no namespace moves it."
    if found == "/getGeometry":
        return "Its name and place are as ever. __ns:=… moves it, getGeometry:=… renames it, without blanks."
    if found == f"/{room}/getGeometry":
        return "It is in its room, and has kept its name. The old name comes first: getGeometry:=measure."
    if found == f"/{room}/measurer/measure":
        return "It is under the node. The namespace is the room alone, and a name with ~ is private."
    if found.endswith(f"{room}/measure"):
        return "That is another place. The namespace is the room, with one slash in front."
    return "The room that the function is given is the namespace; the service is called measure in it."
