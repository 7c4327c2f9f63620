"""The checks of chapter 01: names are resolved, given, searched for, and held against who lives."""

import time

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.graph.snapshot import ServiceSeen

GEOMETRY = "course_pkg/geometry"
NUMBER = "std_msgs/UInt32"
NO_RETURN = "None was returned, as by a function that comes to its end without a return line."
PATIENCE = 8.0  # s for a program to start; it takes 0.5 s, and more on a machine that is busy
LOOKS_LIKE_IT = (
    "Another service answered, whose name only looks like it. Compare all that stands behind the last slash."
)
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
            (says("chapter_01"), "That is how this notebook means it. The node in question is another."),
            (says("//"), "Two slashes follow one another. The outermost namespace is / and ends in one."),
            (says("~"), "The ~ is still in it. It stands for the name of the node, and gives way to it."),
            (says("^[^/]"), "A full name starts with a slash."),
            (
                f"{before}{written}",
                _where(written, "A global name is complete. The namespace leaves it alone."),
            ),
            (
                f"{before}/{name}/{bare}",
                _where(written, "Only a private name goes under the name of the node."),
            ),
            (
                f"/{name}/{bare}",
                "The node stands in a namespace itself: that comes first, then the node's name.",
            ),
            (
                f"{before}/{bare}",
                _where(written, "A private name belongs to the node: its name comes in between."),
            ),
            (f"/{bare}", "The namespace is missing. Only a global name goes without it."),
        ],
    )


def _where(written: str, otherwise: str) -> str:
    """Return a hint for a global name that was not left as it is, or else another."""
    return "A global name is complete: return it as it is." if written.startswith("/") else otherwise


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
            started = exam.run("start_a_room", Its("start_in"), room, worded="start_in(room)", within=15.0)
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
        new = [other for other in seen.services if other.uri not in before and other.type == GEOMETRY]
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
    if found.endswith(f"{room}/measure"):
        return "That is another place. The namespace is the room, with one slash in front."
    return "The room that the function is given is the namespace; the service is called measure in it."


@part(
    "01.3",
    points=3,
    goal="Find the service whose name ends in a given part, ask it, and return the volume, or None.",
    needs=["ask_wherever"],
    deadline=25.0,
)
def ask_it_wherever_it_lives(exam: Exam) -> None:
    """Serve at three depths, each beside names that are nearly right; then ask for one that nobody serves."""
    for depth in exam.draw.shuffled([0, 1, 3]):
        last = exam.draw.word()
        place = "".join(f"/{exam.draw.word()}" for _ in range(depth))
        volume, *others = (whole + 0.375 for whole in exam.draw.integers(4, 1000, 9000))
        named = {f"{place}/x{last}": others[0], f"/{last}/x": others[1], f"{place}/{last}x": others[2]}
        for name, wrong in named.items():
            exam.serve(name, GEOMETRY, lambda _, v=wrong: {"volume": v})
        server = exam.serve(f"{place}/{last}", GEOMETRY, lambda _, v=volume: {"volume": v})
        length, width, height = exam.draw.numbers(3, 0.5, 9.0)
        exam.expect(
            "the volume comes from the service that was meant",
            expected=volume,
            seen=exam.run("ask_wherever", last, length, width, height, hints=_LOST).value,
            near=1e-6,
            hints=[
                (None, "It is there, and None was returned. It may be in any namespace, or in none."),
                *((other, LOOKS_LIKE_IT) for other in others),
                (length * width * height, "You multiplied. This server measures in its own way: ask it."),
                (says("volume"), "That is the whole response. Return its volume."),
                (says(f"/{last}$"), "That is its name. Ask it, and return the volume."),
            ],
        )
        exam.expect(
            "it is sent length, width and height",
            expected={"length": length, "width": width, "height": height},
            seen=server.requests[0],
            near=1e-4,
            hints="Compare the order of your arguments with rossrv show course_pkg/geometry.",
        )
    exam.expect(
        "None when nobody serves it",
        expected=None,
        seen=exam.run("ask_wherever", exam.draw.word(), 1.0, 2.0, 3.0, hints=_LOST).value,
        hints="No service is called so. Return None after the search.",
    )


_LOST = {
    says(
        "unavailable"
    ): "The name that was called is not the full one. Call the service by the name that you found.",
    says(
        "IndexError|StopIteration"
    ): "The search found nothing, and its first find was used. Return None then.",
    says("TypeError.*NoneType"): "The search found nothing, and None was used as a name. Return None then.",
}


@part(
    "01.4",
    points=2,
    goal="Return the nodes that publish a topic and answer a ping, sorted.",
    needs=["living_publishers"],
    deadline=25.0,
)
def who_really_publishes(exam: Exam) -> None:
    """List living and killed publishers of two topics; then ask for a topic of the killed, and for none."""
    topic, other, grave = (f"/{exam.draw.word()}" for _ in range(3))
    names = [f"{exam.draw.choice(['', '/left', '/right'])}/{exam.draw.word()}" for _ in range(7)]
    living, dead = names[:3], names[3:5]
    for number, name in enumerate([living[0], dead[0], living[1], dead[1], living[2]]):
        exam.puppet(name, topic, NUMBER, alive=number % 2 == 0)
    exam.puppet(names[5], other, NUMBER)
    exam.puppet(names[6], grave, NUMBER, alive=False)
    exam.expect(
        "the living publishers of a topic, sorted",
        expected=sorted(living),
        seen=_living(exam, topic),
        hints=[
            (None, NO_RETURN),
            (
                lambda seen: sorted(seen) == sorted(living),
                "They are the right ones. Return them sorted: sorted(...) makes a list in order.",
            ),
            (lambda seen: sorted(seen) == sorted(dead), "Those are the dead ones: they did not answer."),
            (
                lambda seen: set(seen) & set(dead),
                "One of those was killed, and is listed still. Ping each, and leave out who does not answer.",
            ),
            (
                lambda seen: names[5] in seen,
                "One of those publishes another topic. Look up the one that is given.",
            ),
            (lambda seen: topic in seen, "That is a topic. Behind its name in the list stand the nodes."),
            (
                [],
                "Somebody publishes it. The lists hold pairs: a topic, and the names of its nodes.",
            ),
            (lambda seen: isinstance(seen, int), "That is how many there are. Return their names."),
            (lambda seen: "object" in seen, "That is no list. sorted(...) makes one."),
            (says(""), "Return the names of the nodes, as the list of publishers has them behind the topic."),
        ],
    )
    exam.expect(
        "nobody is an empty list",
        expected=[[], []],
        seen=[_living(exam, grave), _living(exam, f"/{exam.draw.word()}")],
        hints={
            (lambda seen: None in seen): "None is no list. Return [] when there is nobody.",
            says(""): "Nobody living publishes these two. The answer is an empty list.",
        },
    )


def _living(exam: Exam, topic: str) -> object:
    return exam.run(
        "living_publishers",
        topic,
        within=6.0,
        hints={
            says("TimesUp"): "Without max_count=1, rosnode_ping goes on pinging for ever.",
            says("KeyError"): "No node has ever published that topic, so it is in no list. That is nobody.",
        },
    ).value
