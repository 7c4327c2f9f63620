"""The server as a program in the package: rosrun finds it, it serves the new type, and it goes on."""

from __future__ import annotations

import re
import time

from course_pkg.building import explain
from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.checks.chapter_04.lamp import PACKAGE, built, lamp_class
from course_pkg.examiner.folder import Folder, Running
from course_pkg.interfaces import message_type

NAME = "lamp_server.py"
FILE = f"{PACKAGE}/scripts/{NAME}"
STARTING = 20.0  # s for the program to serve; it takes one on a machine at rest
LOOK = 0.1  # s between looks

MARK = "\ufeff"
ENDINGS = (  # the words that it printed when it ended, and what to do
    (r"rospy\.init_node\(\) first", "A service belongs to a node: call rospy.init_node first."),
    (r"no attribute '_request_class'", "That is one half of the type. rospy.Service takes the whole: Lamp."),
    (r"(?s)(\w+)\.srv import.*No module named '\1'", "The type is here: import from lamp_services.srv."),
    (r"required file not found|bad interpreter", "Its first line names a program that is not here."),
    (r"No module named '(?!lamp_services)(\w+)'", "Python has no module {0} here."),
    (r"cannot import name '\w+' from 'lamp_services' ", "The types are in lamp_services.srv."),
)

FAULTS = {
    says("expected 3 items|exactly 3|rgb must be"): "rgb takes three numbers in a list: r, g and b.",
    says(
        "process request: (?!service handler)"
    ): "It is not refused: the answer to a mode that there is not has success=False.",
}

START = f"""%%writefile {FILE}
..."""


@part(
    "04.5",
    points=3,
    goal="Write lamp_server.py, which rosrun finds, and which serves /lamp as lamp_services/Lamp.",
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
)
def the_program(exam: Exam) -> None:
    """Build a copy, run the program there under names of the check's own, and call it."""
    _first_line(exam, exam.source(f"file:{FILE}"))
    folder = built(exam, given=[f"{PACKAGE}/scripts"])
    _run_bit(exam, folder)
    name, node = f"/{exam.draw.word()}", exam.draw.word()
    line = f"rosrun lamp_services {NAME} /lamp:={name} __name:={node}"
    with folder.start("bash", "-c", f". devel/setup.bash && exec {line}", worded=line) as running:
        _serves(exam, running, name, f"/{node}")
        lamp = exam.service(name, lamp_class(), hints=FAULTS, timeout=5.0)
        for mode in (1, 2, 0, exam.draw.integer(3, 255), 1):
            _answers(exam, lamp, mode)


def _first_line(exam: Exam, text: str) -> None:
    first = text.partition("\n")[0]
    exam.hold(
        "its first line is a shebang that asks for Python 3",
        first.startswith("#!") and "python" in first and "\r" not in first and "python2" not in first,
        expected="#!/usr/bin/env python3",
        seen=first.replace("\r", "\\r") or "an empty line",
        hints=_about_first_line(text, first),
    )


def _about_first_line(text: str, first: str) -> str:
    if "\r" in first:
        return "The lines end as on Windows. Save the file with the line ends of Linux."
    if first.startswith(MARK):
        return "In front of it stands an invisible mark of Windows. Save the file as UTF-8 without BOM."
    if first.startswith("#!"):
        return "This one asks for another program: write python3."
    if "\n#!" in text or first.lstrip().startswith("#!"):
        return "The shebang counts only as the very first line, from its first column."
    return "Without one, Linux gives the script to the shell, which takes import for a command of its own."


def _run_bit(exam: Exam, folder: Folder) -> None:
    exam.hold(
        "it has its run bit",
        folder.command("test", "-x", FILE).status == 0,
        expected="a file that may be run",
        seen="a file that may only be read",
        hints=f"Without it rosrun says: Couldn't find executable named {NAME}. Type: chmod +x {FILE}",
    )


def _serves(exam: Exam, running: Running, name: str, node: str) -> None:
    """Wait until the program serves `name`; when it does not, say what it does instead."""
    deadline = time.monotonic() + STARTING
    while exam.look().service(name) is None:
        if running.status is not None or time.monotonic() > deadline:
            others = [service.name for service in exam.look().services if service.node == node]
            done = running.stop()
            exam.fail(
                "rosrun starts it, and it serves /lamp",
                expected="a server that goes on",
                seen=_seen(done.status, done.out),
                hint=_why_not(done.status, done.out, others),
            )
        time.sleep(LOOK)
    exam.hold("rosrun starts it, and it serves /lamp", True)


def _seen(status: int | None, printed: str) -> str:
    if status is None:
        return "a program that goes on, and serves no /lamp"
    last = printed.strip().rpartition("\n")[2]
    return f"exit status {status}{f', and {last}' if last else ', and not a word'}"


def _why_not(status: int | None, printed: str, others: list[str]) -> str:
    mine = [other for other in others if not other.endswith(("/get_loggers", "/set_logger_level"))]
    if "/lamp" in mine:
        return (
            "It takes its name before rospy.init_node, and so no other can be given to it. Call that first."
        )
    if mine:
        return f"It serves {', '.join(mine)}. The name that is asked for is /lamp."
    if status is None and others:
        return 'It is a node, and serves nothing: rospy.Service("/lamp", Lamp, …) is missing.'
    if status is None:
        return "It runs, and has not become a node: something before rospy.init_node never ends."
    for pattern, hint in ENDINGS:
        if found := re.search(pattern, printed):
            return hint.format(*found.groups())
    if "Traceback" in printed or "Error" in printed:
        fault = explain(printed)
        return f"{fault.problem} {fault.remedy}" if fault else _own_line(printed)
    return "It came to its end, and its service with it. Does it come to rospy.spin(), which waits?"


def _own_line(printed: str) -> str:
    """Return the line of the student's script that an error came from."""
    mine = [line for line in printed.splitlines() if f'{NAME}"' in line]
    if not mine:
        return "Read the last line that it printed."
    number = mine[-1].rpartition("line ")[2].partition(",")[0]
    return f"The error comes from line {number} of {NAME}."


def _answers(exam: Exam, lamp: Service, mode: int) -> None:
    """Ask once, with a colour and times drawn anew, and hold the three fields of the answer to that."""
    red, green, blue = exam.draw.numbers(3, 0.1, 1.0)
    seconds = exam.draw.numbers(exam.draw.integer(2, 5), 0.5, 9.0)
    colour = message_type("std_msgs/ColorRGBA").to_message({"r": red, "g": green, "b": blue, "a": 1.0})
    response = lamp(mode=mode, colour=colour, seconds=seconds)
    known = mode in (0, 1, 2)
    exam.expect(
        "success says whether there is such a mode",
        expected=known,
        seen=response.success,
        hints={
            True: "There is no such mode: the three constants are all there are.",
            False: "That is one of the three modes. (OFF is 0, and 0 counts as False in Python.)",
        },
    )
    exam.expect(
        "rgb is red, green and blue for ON and BLINK, and otherwise three zeros",
        expected=[red, green, blue] if mode in (1, 2) else [0.0, 0.0, 0.0],
        seen=list(response.rgb),
        near=1e-4,
        hints=[
            ([0.0, 0.0, 0.0], "A field that nobody fills is 0. Take r, g and b out of request.colour."),
            ([red, green, blue], "The lamp is dark when it is OFF, and when there is no such mode."),
            (says(""), "Red, green, blue, in this order, as the request has them."),
        ],
    )
    exam.expect(
        "total is the sum of the seconds",
        expected=sum(seconds),
        seen=response.total,
        near=1e-3,
        hints={
            0.0: "A field that nobody fills is 0. Add up request.seconds.",
            float(len(seconds)): "That is how many there are. Add them up.",
            says(""): "Add up all of them: sum(request.seconds).",
        },
    )
