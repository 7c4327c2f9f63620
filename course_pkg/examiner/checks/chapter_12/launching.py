"""12.11: a launch file with two arguments: read by roslaunch, and then run."""

from __future__ import annotations

import re
import time

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
OUTPUT = "launched.txt"  # what roslaunch prints
CANNOT = says("cannot launch|RLException")
OF_CASHIER = re.compile(r"^/robot_cashier/wait: *(.+)$", re.MULTILINE)

UNDECLARED = 'An argument is not declared: <arg name="till" … />.'
UNREADABLE = {
    says("not well-formed|mismatched|XML"): "The file is no XML: each <tag> is closed, each value in quotes.",
    says("cannot override arg"): "An <arg> with value= is fixed. Give it default=, which till:=… overrides.",
    says("unused args"): UNDECLARED,
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
        for command, value, given in ((settings, 2.0, []), (waiting, wait, [f"wait:={wait}", "till:=false"])):
            printed = _read(exam, command)
            _hands_on(exam, f"{printed}\n{_given_to_node(folder, printed, given)}", value, given)
    _runs(exam, folder)


def _read(exam: Exam, command: Running) -> str:
    """Return what roslaunch printed about the file; that it could read it is a rule."""
    until(lambda: command.status is not None, READING)
    status = command.status
    printed = command.stop().out
    text = exam.source(f"file:{FILE}")
    exam.hold(
        "roslaunch can read the file",
        status == 0,
        expected="what it would start",
        seen=telling_line(printed),
        hints=[((lambda seen: _lacks_argument(str(seen), text)), UNDECLARED), *UNREADABLE.items()],
    )
    return printed


def _lacks_argument(seen: str, text: str) -> bool:
    """Say whether an argument that is required is not declared at all."""
    asked = re.search(r"requires the '(\w+)' arg", seen)
    return bool(asked) and not re.search(rf"<arg[^>]*name=.{asked[1] if asked else ''}\W", text)


def _given_to_node(folder: Folder, printed: str, given: list[str]) -> str:
    """Return a parameter that the node is given on its command line, as --dump-params words one."""
    if OF_CASHIER.search(printed):
        return ""
    done = folder.command("roslaunch", "--args", "/robot_cashier", FILE, *given, within=READING)
    found = re.search(r"(?<!\S)_wait:=(\S+)", done.out)
    return f"/robot_cashier/wait: {found[1]}" if found else ""


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


def _hands_on(exam: Exam, printed: str, wait: float, given: list[str]) -> None:
    """Look for the cashier's own parameter among those that would be set."""
    found, words = OF_CASHIER.search(printed), given[0] if given else "no argument"
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
            ((lambda _: not given), 'Without an argument it is 2 s: default="2.0".'),
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
    into = ["sh", "-c", f'exec "$@" > {OUTPUT} 2>&1', "sh"]
    with folder.start(*into, *line, worded=f"roslaunch {FILE}") as launched:
        missing, printed = _missing(folder, launched, uri)
    exam.hold(
        "started, the system has all its services and topics",
        not missing,
        expected="/detect_customer, /till/set, /frames, /mirrored_joints",
        seen=telling_line(printed) if CANNOT.search(printed) else f"no {', no '.join(missing)}",
        hints={
            says("annot locate"): "A program's name is wrong: type= is what you would give to rosrun.",
            says("annot launch"): "A name is wrong: pkg= and type= are what you would give to rosrun.",
            says(
                "^no "
            ): "Does each node have the program of its name as its type=? Start it yourself and read what "
            f"it prints: roslaunch {FILE}",
            says(""): f"Start it yourself and read what it prints: roslaunch {FILE}",
        },
    )


def _missing(folder: Folder, launched: Running, uri: str) -> tuple[list[str], str]:
    """Wait until the system is complete, or roslaunch says that it cannot be.

    Return what is missing, and what roslaunch printed.
    """
    missing = ["/detect_customer"]

    def is_complete(seen: Snapshot) -> bool:
        missing[:] = _lacks(seen)
        return not missing

    deadline = time.monotonic() + READY
    while time.monotonic() < deadline:
        if becomes(uri, is_complete, 1.0):
            return [], ""
        printed = folder.command("cat", OUTPUT, worded=f"roslaunch {FILE}").out
        if CANNOT.search(printed) or launched.status is not None:
            break
    return missing, printed


def _lacks(seen: Snapshot) -> list[str]:
    """Return the services and topics that are missing: a topic has somebody who publishes and who listens."""
    topics = {topic.name: topic for topic in seen.topics}
    lacking = [name for name in ("/detect_customer", "/till/set") if not seen.service(name)]
    for name in ("/frames", "/joint_states"):
        if name not in topics or not topics[name].publishers or not topics[name].subscribers:
            lacking.append(name)
    return lacking + [name for name in ("/mirrored_joints",) if name not in topics]
