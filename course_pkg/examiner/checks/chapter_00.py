"""The checks of chapter 00: the graph is read, a service asked, a topic heard."""

from itertools import accumulate
from math import prod

from course_pkg.examiner import Exam, part, says

NO_RETURN = "None was returned, as by a function that comes to its end without a return line."
UNHEARD = {
    says("^NothingHeard|^ROSException.*timeout|^TimesUp"): "Ten numbers a second were published meanwhile. "
    "Subscribe to the name in `topic`, with the type UInt32."
}


@part(
    "00.1",
    points=1,
    goal="Name the node that measures boxes, the service that it serves, and the type of that service.",
    needs=["name_of_node", "name_of_service", "name_of_type"],
)
def read_the_graph(exam: Exam) -> None:
    """Compare the names with those that the graph has."""
    exam.expect(
        "the name of the node",
        expected="/SERVER_NODE",
        seen=exam.read("name_of_node"),
        hints={
            "SERVER_NODE": "Almost: names on the graph start with a slash.",
            says("^/?server$"): "That is the program. Ask rosnode list which name it took on the graph.",
            says("^/chapter"): "That is this notebook, which asks. Who answers?",
            says("getGeometry"): "That is a service. A node is a program that serves it.",
            says("^/server_node/?$"): "Almost: upper and lower case count, and no slash stands at the end.",
        },
    )
    exam.expect(
        "the name of the service",
        expected="/getGeometry",
        seen=exam.read("name_of_service"),
        hints={
            "getGeometry": "Almost: names on the graph start with a slash.",
            says("logger"): "Every node has that one. Which one is special to /SERVER_NODE?",
            says("^/?SERVER_NODE$"): "That is the node. Ask rosservice list what can be called.",
            says("course_pkg"): "That is the type. The name is what is called.",
            says("://"): "That is the address behind it. The name is what rosservice list shows.",
            says("^/getgeometry/?$"): "Almost: upper and lower case count, and no slash stands at the end.",
        },
    )
    exam.expect(
        "the type of the service",
        expected="course_pkg/geometry",
        seen=exam.read("name_of_type"),
        hints={
            says("^geometry$"): "Almost: a type is written with its package, package/type.",
            says(r"^course_pkg/geometry\.srv$"): "That is the file. The type has no ending.",
            says("^/course_pkg"): "Almost: a type is no name on the graph, and begins without a slash.",
            says(r"object|course_pkg\.srv"): "That is the class that Python has for it. The type is a text, "
            "package/type.",
            says("float32|---"): "Those are the fields. What is the type that has them called?",
            says("getGeometry"): "That is the name of the service. Ask rosservice type what it is made of.",
            says("(?-i:course_pkg/Geometry)"): "This type is spelt with a small g.",
        },
    )


@part(
    "00.2",
    points=2,
    goal="Return the volume that the service answers with.",
    needs=["ask_for_volume"],
)
def ask_a_question(exam: Exam) -> None:
    """Serve twice, with volumes of their own, so that only asking helps."""
    for _ in range(2):
        name = f"/{exam.draw.word()}"
        length, width, height = exam.draw.numbers(3, 0.5, 9.0)
        area, volume = (whole + 0.375 for whole in exam.draw.integers(2, 1000, 9000))  # exact as a float32
        server = exam.serve(name, "course_pkg/geometry", lambda _, a=area, v=volume: {"area": a, "volume": v})
        returned = exam.run("ask_for_volume", name, length, width, height).value
        exam.hold(
            "the service that was named is asked",
            bool(server.requests),
            expected=f"a call of {name}",
            seen="no call of it",
            hints={
                says(
                    ""
                ): "Whatever was returned, it was not asked for. Call node.call with the name in `service`."
            },
        )
        exam.expect(
            "the sides are sent in the order length, width, height",
            expected={"length": length, "width": width, "height": height},
            seen=server.requests[0],
            near=1e-4,
            hints={
                (
                    lambda seen: 0.0 in seen.values()
                ): "One arrived as 0, as a field does that is left out. Send all three.",
                says(""): "Compare the order of your arguments with the order in rossrv show "
                "course_pkg/geometry.",
            },
        )
        exam.expect(
            "the volume of the answer is returned",
            expected=volume,
            seen=returned,
            near=1e-6,
            hints=_no_volume(area, volume, (length, width, height)),
        )


def _no_volume(area: float, volume: float, sides: tuple[float, float, float]) -> list[tuple[object, str]]:
    """Return what to do about something that is not the `volume` of the answer; `area` is its area."""
    multiplied = "You multiplied. This server measures in its own way: return "
    return [
        (None, NO_RETURN),
        (area, "That is the area."),
        (area * sides[2], f"{multiplied}its volume."),
        (prod(sides), f"{multiplied}what it says."),
        (int(volume), "That is the volume without its fraction. Return it as it came."),
        (lambda seen: "volume" in seen, "That is the whole response. Return its volume."),
        (lambda seen: volume in seen, "That is more than was asked for. Return the volume alone."),
        (lambda seen: str(volume) in seen, "That is the volume as a text. Return the number."),
        (says(""), "Return the volume of the answer as it came."),
    ]


@part(
    "00.3",
    points=2,
    goal="Return the next three numbers that are published on a topic.",
    needs=["listen"],
    deadline=25.0,
)
def hear_a_stream(exam: Exam) -> None:
    """Publish on a topic of this check's own, which counts in steps that nobody can guess."""
    topic = f"/{exam.draw.word()}"
    steps = [exam.draw.integer(2, 50) for _ in range(300)]
    published = list(accumulate(steps, initial=exam.draw.integer(1000, 9000)))
    exam.publish(topic, "std_msgs/UInt32", [{"data": number} for number in published], every=0.1)
    heard = exam.run("listen", topic, within=12.0, hints=UNHEARD).value
    exam.hold(
        "a list is returned",
        isinstance(heard, list),
        expected="a list of three numbers",
        seen=heard,
        hints={
            None: NO_RETURN,
            (lambda seen: "object" in seen): "That is no list. list(...) makes one.",
            says(""): "One value is no list. Collect three numbers in a list.",
        },
    )
    exam.hold(
        "the list holds numbers",
        all(type(item) is int for item in heard),
        expected="numbers of type int",
        seen=heard,
        hints={
            says("data"): "Those are whole messages. A message's number is in its field data.",
            says("'"): "Those are texts. A message's data is a number already.",
        },
    )
    exam.expect(
        "three numbers are returned",
        expected=3,
        seen=len(heard),
        hints={
            0: "It returned before any came. Wait for three messages.",
            (lambda count: count > 3): "Those are too many. Return the first three, and no more.",
            says(""): "Wait for three messages.",
        },
    )
    exam.hold(
        "the numbers are those of the topic",
        set(heard) <= set(published),
        expected=f"numbers such as {published[:3]}",
        seen=heard,
        hints={
            (
                lambda seen: set(seen) & set(published)
            ): "Not all of those were published: the topic does not count in ones. Take each number from a "
            "message of its own.",
            says(""): "Nobody publishes those on the topic that was named. Subscribe to the name in `topic`.",
        },
    )
    first = published.index(min(heard))
    exam.expect(
        "the oldest comes first, and none is left out",
        expected=published[first : first + 3],
        seen=heard,
        hints={
            (
                lambda seen: len(set(seen)) < 3
            ): "A number stands there twice. Each message is published once: wait for the next one.",
            (lambda seen: seen != sorted(seen)): "Return them in the order in which they came.",
            says(""): "One that was published between them is missing.",
        },
    )
