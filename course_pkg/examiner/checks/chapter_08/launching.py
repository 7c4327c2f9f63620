"""A launch file with an argument."""

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.launched import becomes, telling_line
from course_pkg.examiner.scripted import closed_port
from course_pkg.graph import Snapshot

FILE = "my_exercise3.launch"
ALWAYS = {"/turtlesim", "/improved_pubvel_toggle"}
SECOND = "/spawn_turtle_plus"
SIGNS = {  # of the programs, by what nobody else serves
    "/spawn": "Nobody serves /spawn, as the simulator does. Compare pkg and type of that node.",
    "/change_speed": "Nobody serves /change_speed, as improved_pubvel_toggle does. Compare pkg and type.",
    "/MyTurtle/set_pen": "There is no MyTurtle, which spawn_turtle_plus makes. Compare pkg and type.",
}
READY = 25.0  # s for a launch file on a busy machine

START = f"""\
%%writefile {FILE}
<launch>
  <arg name="addturtle" default="true" />
  <node pkg="turtlesim" type="turtlesim" name="turtlesim" />
  <node pkg="course_pkg" type="spawn_turtle_plus" name="spawn_turtle_plus" />
</launch>
"""


@part(
    "08.8",
    points=2,
    goal="Write a launch file that starts a second turtle only where it is asked for.",
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
)
def two_turtles_or_one(exam: Exam) -> None:
    """Ask roslaunch what it would start; then start it, on a graph of its own, and look for the turtles."""
    folder = exam.folder(files=[FILE])
    for argument, wanted in (("addturtle:=false", False), ("", False), ("addturtle:=true", True)):
        listed = folder.command("roslaunch", "--nodes", FILE, *filter(None, [argument]), within=20.0)
        exam.hold(
            "roslaunch can read the file",
            listed.status == 0,
            expected="a list of nodes",
            seen=telling_line(listed.err or listed.out),
            hints=_UNREADABLE,
        )
        _lists(exam, set(listed.out.split()), argument, wanted)
    _runs(exam, folder)


_UNREADABLE = {
    says("not well-formed|mismatched|XML"): "The file is no XML: each <tag> is closed, each value in quotes.",
    says("unused args"): 'addturtle is not declared: <arg name="addturtle" default="false" />.',
    says("requires the 'addturtle'|requires.*arg"): "Without an argument it has to start, too: give <arg> a "
    'default="false".',
    says("is not a valid|invalid boolean|not a bool"): 'if= takes true or false: if="$(arg addturtle)".',
    says(""): "Try it: roslaunch --nodes my_exercise3.launch says what is wrong.",
}


def _lists(exam: Exam, nodes: set[str], argument: str, wanted: bool) -> None:
    exam.hold(
        "simulator and driver are there in any case",
        nodes >= ALWAYS,
        expected=", ".join(sorted(ALWAYS)),
        seen=", ".join(sorted(nodes)),
        hints='A node is missing, or its name is another: name="turtlesim" and '
        'name="improved_pubvel_toggle".',
    )
    words = argument or "no argument"
    exam.hold(
        "the second turtle's program only where addturtle is true",
        (SECOND in nodes) == wanted,
        expected=f"{'with' if wanted else 'without'} {SECOND} for {words}",
        seen=", ".join(sorted(nodes)),
        hints={
            (lambda _: wanted): "It is missing although it was asked for. if=, not unless=.",
            (lambda _: not argument): 'Without an argument there is one turtle: default="false".',
            says(""): 'It is there although nobody asked for it: <node if="$(arg addturtle)" … />.',
        },
    )


def _runs(exam: Exam, folder: object) -> None:
    uri = f"http://localhost:{closed_port()}"
    launch = ["env", f"ROS_MASTER_URI={uri}", "ROS_HOSTNAME=localhost", "roslaunch", FILE, "addturtle:=true"]
    with folder.start(*launch) as launched:  # type: ignore[attr-defined]
        there = becomes(
            uri,
            lambda seen: seen.service("/change_speed") and seen.service("/MyTurtle/set_pen"),
            READY,
        )
        alike = there and becomes(uri, _both_are_told, READY)
        served = [] if alike else [name for name in SIGNS if _serves(uri, name)]
        printed = "" if alike else launched.stop().out
    exam.hold(
        "started, both turtles are there and are told where to go",
        bool(alike),
        expected="turtle1 and MyTurtle, each with a driver",
        seen=telling_line(printed) if not there else "MyTurtle, whom nobody tells anything",
        hints=[
            (
                says("cannot locate node|Cannot locate"),
                "A program's name is wrong: type= is what you would give to rosrun, such as turtlesim_node.",
            ),
            *((says(""), hint) for name, hint in SIGNS.items() if name not in served),
            (
                lambda _: there,
                "MyTurtle is there, and nobody drives it: spawn_turtle_plus does. Compare its type.",
            ),
            (
                says(""),
                "Start it yourself and read what it prints: roslaunch my_exercise3.launch addturtle:=true",
            ),
        ],
    )


def _serves(uri: str, name: str) -> bool:
    return becomes(uri, lambda seen: seen.service(name), 0.5)


def _both_are_told(seen: Snapshot) -> bool:
    told = {topic.name: topic for topic in seen.topics}
    names = ("/turtle1/cmd_vel", "/MyTurtle/cmd_vel")
    return all(name in told and told[name].publishers and told[name].subscribers for name in names)
