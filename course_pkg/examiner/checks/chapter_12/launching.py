"""12.11: a launch file with two arguments: read by roslaunch, and then run."""

from __future__ import annotations

import re

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.folder import Folder, Running
from course_pkg.examiner.launched import becomes, telling_line
from course_pkg.examiner.scripted import closed_port
from course_pkg.examiner.waiting import until
from course_pkg.graph import Snapshot

FILE = "my_cashier.launch"
ALWAYS = {"/counter_camera", "/robot", "/customer_detector", "/robot_cashier"}
TILL = "/till"
READING = 20.0  # s for roslaunch to read the file on a busy machine
READY = 20.0  # s for the system to come up there

UNREADABLE = {
    says("not well-formed|mismatched|XML"): "The file is no XML: each <tag> is closed, each value in quotes.",
    says("unused args"): 'An argument is not declared: <arg name="till" … />.',
    says(
        "requires the|requires.*arg"
    ): "It has to start without arguments: declare each, and give each <arg> a default.",
    says("is not a valid|invalid boolean|not a .?bool"): 'if= takes true or false: if="$(arg till)".',
    says(""): f"Try it: roslaunch --nodes {FILE} says what is wrong.",
}


@part(
    "12.11",
    points=3,
    goal="Write a launch file for the whole system, with arguments for the till and for the wait.",
    needs=[f"file:{FILE}"],
    deadline=60.0,
)
def the_whole_system(exam: Exam) -> None:
    """Ask roslaunch what it would start, and with what parameters; then start it, on a graph of its own."""
    folder = exam.folder(files=[FILE])
    wait = exam.draw.number(2.5, 9.0)
    with (
        folder.start("roslaunch", "--nodes", FILE) as plain,
        folder.start("roslaunch", "--nodes", FILE, "till:=false") as without,
        folder.start("roslaunch", "--dump-params", FILE) as settings,
        folder.start("roslaunch", "--dump-params", FILE, f"wait:={wait}", "till:=false") as waiting,
    ):
        _lists(exam, _read(exam, plain), "no argument", till=True)
        _lists(exam, _read(exam, without), "till:=false", till=False)
        _hands_on(exam, _read(exam, settings), 2.0, "no argument")
        _hands_on(exam, _read(exam, waiting), wait, f"wait:={wait}")
    _runs(exam, folder)


def _read(exam: Exam, command: Running) -> str:
    """Return what roslaunch printed about the file; that it could read it is a rule."""
    until(lambda: command.status is not None, READING)
    status = command.status
    printed = command.stop().out
    exam.hold(
        "roslaunch can read the file",
        status == 0,
        expected="what it would start",
        seen=telling_line(printed),
        hints=UNREADABLE,
    )
    return printed


def _lists(exam: Exam, printed: str, words: str, *, till: bool) -> None:
    nodes = {line.strip() for line in printed.splitlines()}
    missing = sorted(ALWAYS - nodes)
    exam.hold(
        "camera, arm, detector and cashier are there in any case",
        not missing,
        expected=", ".join(sorted(ALWAYS)),
        seen=", ".join(sorted(node for node in nodes if node.startswith("/"))) or "no node",
        hints=f"{', '.join(missing)} is missing: each node has the name of its program.",
    )
    exam.hold(
        "the till is there unless till:=false",
        (TILL in nodes) == till,
        expected=f"{'with' if till else 'without'} {TILL} for {words}",
        seen=", ".join(sorted(nodes & (ALWAYS | {TILL}))),
        hints={
            (lambda _: till): 'Without an argument there is a till: default="true", and if=, not unless=.',
            says(""): 'It is there although nobody wants it: <node if="$(arg till)" … />.',
        },
    )


def _hands_on(exam: Exam, printed: str, wait: float, words: str) -> None:
    """Look for the cashier's own parameter among those that would be set."""
    found = re.search(r"^/robot_cashier/wait: *(.+)$", printed, re.MULTILINE)
    every = re.findall(r"^(\S*wait): *(.+)$", printed, re.MULTILINE)
    exam.hold(
        "the cashier's parameter wait is the argument",
        bool(found) and _number(found[1] if found else "") == wait,
        expected=f"/robot_cashier/wait: {wait:g} for {words}",
        seen=", ".join(f"{name}: {value}" for name, value in every) or "no parameter wait",
        hints=[
            (
                says("no parameter"),
                'Inside of <node …> … </node>: <param name="wait" value="$(arg wait)" />.',
            ),
            (
                (lambda _: not found),
                "That is another node's, or nobody's: <param> stands inside of the robot_cashier's <node>.",
            ),
            ((lambda _: words == "no argument"), 'Without an argument it is 2 s: default="2.0".'),
            (says(""), 'The value is not the argument\'s: value="$(arg wait)".'),
        ],
    )


def _number(text: str) -> float | None:
    try:
        return float(text.strip().strip("'\""))
    except ValueError:
        return None


def _runs(exam: Exam, folder: Folder) -> None:
    uri = f"http://localhost:{closed_port()}"
    line = ["env", f"ROS_MASTER_URI={uri}", "ROS_HOSTNAME=localhost", "roslaunch", FILE]
    with folder.start(*line, worded=f"roslaunch {FILE}") as launched:
        there = becomes(uri, _is_complete, READY)
        printed = "" if there else launched.stop().out
    exam.hold(
        "started, the system has all its services and topics",
        there,
        expected="/detect_customer, /till/set, /frames, /mirrored_joints",
        seen=telling_line(printed),
        hints={
            says("annot locate"): "A program's name is wrong: type= is what you would give to rosrun.",
            says(""): f"Start it yourself and read what it prints: roslaunch {FILE}",
        },
    )


def _is_complete(seen: Snapshot) -> bool:
    topics = {topic.name: topic for topic in seen.topics}
    heard = all(
        name in topics and topics[name].publishers and topics[name].subscribers
        for name in ("/frames", "/joint_states")
    )
    return (
        heard and "/mirrored_joints" in topics and all(map(seen.service, ("/detect_customer", "/till/set")))
    )
