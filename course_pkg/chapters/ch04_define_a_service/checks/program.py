"""Checks of the package's server program: rosrun must find it, and it must serve the new type."""

from __future__ import annotations

import re
import time

from course_pkg.chapters.ch04_define_a_service.checks.lamp import PACKAGE, built, lamp_class
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.commands.folder import Folder, Running
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.shared.script import own_line, require_shebang
from course_pkg.checking.shared.served_by import require_served_by_program
from course_pkg.types import message_type
from course_pkg.workspace import explain

NAME = "lamp_server.py"
FILE = f"{PACKAGE}/scripts/{NAME}"
# The program must offer /lamp within this time in s; it takes 1 s on an idle machine.
STARTING = 20.0
LOOK = 0.1  # LOOK is the time in s between two snapshots of the graph.

ENDINGS = (  # Each entry contains a pattern for the program's output, and a hint.
    (
        r"rospy\.init_node\(\) first",
        "A service needs a node. Call rospy.init_node before you create the service.",
    ),
    (
        r"no attribute '_request_class'",
        "Your program passed the class of the request or of the response to rospy.Service. Pass the "
        "class of the service type instead, which is Lamp.",
    ),
    (
        r"(?s)(\w+)\.srv import.*No module named '\1'",
        "Your program imports the type from a package that does not exist. Import the type "
        "from lamp_services.srv.",
    ),
    (
        r"required file not found|bad interpreter",
        "The first line of the script names a program that is not installed. Write a shebang "
        "that names python3.",
    ),
    (
        r"cannot import name '\w+' from 'lamp_services' ",
        "Your program imports the type from the wrong module. Import the type from "
        "lamp_services.srv, not from lamp_services.",
    ),
)

FAULTS = [
    (
        matches("empty|out of range"),
        "The handler failed for a request without values in `seconds`. The sum of an empty list is 0.",
    ),
    (
        matches("expected 3 items|exactly 3|rgb must be"),
        "The field `rgb` needs a list of three numbers. Set `rgb` to a list of r, g and b.",
    ),
    (
        matches("process request: (?!service handler)"),
        "The handler refused a request with an unknown mode. For an unknown mode, return a "
        "response with success=False.",
    ),
]

START = f"""%%writefile {FILE}
..."""
STARTED = "Write a program that rosrun can start, and that serves /lamp with the right type."


@part(
    "04.5",
    points=3,
    goal=(
        "Write lamp_server.py, a program that rosrun can start. The program serves /lamp with the "
        "type lamp_services/Lamp."
    ),
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
    goals=[STARTED, "For each mode, return the response that the exercise describes."],
)
def the_program(context: CheckContext) -> None:
    """Build a copy of the package, run its program with new node and service names, and call the service."""
    require_shebang(
        context,
        FILE,
        missing=(
            "Without a shebang, Linux runs the script with the shell, not with Python. Write a "
            "shebang in line 1."
        ),
        elsewhere="The shebang is in the wrong place. Write the shebang in the first column of line 1.",
        another="The shebang names the wrong program. Write a shebang that names python3.",
        windows="The file has Windows line endings (CRLF). Save the file with Linux line endings (LF).",
        mark=(
            "The file begins with an invisible character, the byte order mark (BOM). Save the "
            "file as UTF-8 without BOM."
        ),
        assertion="the first line of the script is a shebang with python3",
        program="python",
    )
    folder = built(context, given=[f"{PACKAGE}/scripts"])
    _run_bit(context, folder)
    name, node = f"/{context.random.word()}", context.random.word()
    line = f"rosrun lamp_services {NAME} /lamp:={name} __name:={node}"
    with folder.start("bash", "-c", f". devel/setup.bash && exec {line}", worded=line) as running:
        _serves(context, running, name, f"/{node}")
        lamp = context.service(name, lamp_class(), hints=FAULTS, timeout=5.0)
        context.fulfilled(STARTED)
        modes = [1, 2, 0, *context.random.integers(context.random.integer(7, 12), 3, 255), 1, 2]
        for mode in (1, 2, 0, *context.random.shuffled(modes)):
            _answers(context, lamp, mode, context.random.choice([2, 30, 90]))
        _answers(context, lamp, 1, 0)
        require_served_by_program(context, running, name)


def _run_bit(context: CheckContext, folder: Folder) -> None:
    context.require(
        "the script is executable",
        holds=folder.command("test", "-x", FILE).status == 0,
        expected="an executable file",
        actual="a file without the permission to execute it",
        hints=(
            "The script is not executable, so rosrun prints: Couldn't find executable named "
            f"{NAME}. Type `chmod +x {FILE}` in a terminal."
        ),
    )


def _serves(context: CheckContext, running: Running, name: str, node: str) -> None:
    """Wait until the program offers the service `name`; if this takes too long, report the reason."""
    deadline = time.monotonic() + STARTING
    while context.look().service(name) is None:
        if running.status is not None or time.monotonic() > deadline:
            others = [service.name for service in context.look().services if service.node == node]
            done = running.stop()
            context.fail(
                "rosrun starts the program, and the program serves /lamp",
                expected="a server that keeps running",
                actual=_seen(done.status, done.out),
                hint=_why_not(done.status, done.out, others),
            )
        time.sleep(LOOK)
    context.require("rosrun starts the program, and the program serves /lamp", holds=True)


def _seen(status: int | None, printed: str) -> str:
    if status is None:
        return "a program that runs, but does not serve /lamp"
    last = printed.strip().rpartition("\n")[2]
    return f"exit status {status}{f', and {last}' if last else ', and no output'}"


def _why_not(status: int | None, printed: str, others: list[str]) -> str:
    mine = [other for other in others if not other.endswith(("/get_loggers", "/set_logger_level"))]
    if mine:
        return (
            f"The program serves {', '.join(mine)}, but not /lamp. Change the name of the service to /lamp."
        )
    if status is None:
        return (
            "The program runs, but it offers no service. Check that the program reaches the "
            'line rospy.Service("/lamp", Lamp, …).'
        )
    for pattern, hint in ENDINGS:
        if found := re.search(pattern, printed):
            return hint.format(*found.groups())
    if "Traceback" in printed or "Error" in printed:
        fault = explain(printed)
        return f"{fault.problem} {fault.remedy}" if fault else own_line(NAME, printed)
    return (
        "The program ended, so its service does not exist any more. Check that the program "
        "reaches rospy.spin(), which waits until the node is stopped."
    )


def _answers(context: CheckContext, lamp: Service, mode: int, count: int) -> None:
    """Make a call with a random colour and `count` random times; compare the three fields of the response."""
    red, green, blue = context.random.numbers(3, 0.1, context.random.choice([1.0, 255.0]))
    least = context.random.choice([0.5, -9.0])
    seconds = context.random.numbers(count, least, 99.0, digits=context.random.integer(0, 2))
    colour = message_type("std_msgs/ColorRGBA").to_message({"r": red, "g": green, "b": blue, "a": 1.0})
    response = lamp(mode=mode, colour=colour, seconds=seconds)
    known = mode in (0, 1, 2)
    context.expect(
        "success is True only for the three modes",
        expected=known,
        actual=response.success,
        hints=[
            (
                True,
                "The mode is unknown, so success has to be False. Compare the mode with the three constants.",
            ),
            (
                False,
                "This mode is one of the three constants, so success has to be True. Note that "
                "OFF is 0, and that a Python condition treats 0 as false.",
            ),
        ],
    )
    context.expect(
        "rgb contains the colour of the request for ON and BLINK, and three zeros for all other modes",
        expected=[red, green, blue] if mode in (1, 2) else [0.0, 0.0, 0.0],
        actual=list(response.rgb),
        near=1e-4,
        hints=[
            (
                lambda actual: mode == 2 and not any(actual),
                (
                    "The mode is BLINK, but rgb contains only zeros. For this mode, too, set rgb to the "
                    "colour in the request."
                ),
            ),
            (
                [0.0, 0.0, 0.0],
                "rgb contains only zeros, because ROS sends zeros for an array that you do not set. "
                "Set rgb to the values r, g and b of request.colour.",
            ),
            (
                [red, green, blue],
                "For OFF and for an unknown mode, the lamp is dark. Set rgb to three zeros.",
            ),
            (
                ANYTHING,
                "The values in rgb are wrong. Return the values r, g and b of request.colour in this order.",
            ),
        ],
    )
    context.expect(
        "total is the sum of all values in the field seconds",
        expected=sum(seconds),
        actual=response.total,
        near=1e-3,
        hints=[
            (
                lambda actual: mode != 1 and not actual,
                "For this mode, your program returned the total 0. For every mode, set total to the sum of "
                "request.seconds.",
            ),
            (
                0.0,
                "The total is 0, because ROS sends 0 for a number that you do not set. Set total to "
                "the sum of all values in request.seconds.",
            ),
            (float(len(seconds)), "The total is the number of the values. Add up the values instead."),
            (ANYTHING, "The total is wrong. Add up all values in request.seconds."),
        ],
    )
