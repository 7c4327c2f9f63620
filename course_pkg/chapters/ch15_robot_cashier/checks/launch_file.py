"""15.10: a launch file with two arguments; roslaunch reads it for the check."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import ExitStack

from course_pkg.chapters.ch15_robot_cashier.checks.packages import LAUNCH, MY_CASHIER, NODES
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.commands.folder import Running, telling_line
from course_pkg.checking.shared.catkin_package import BuiltPackage, copied
from course_pkg.waiting import wait_until

FILE = MY_CASHIER.path(LAUNCH)
START = f"%%writefile {FILE}\n..."
HARDWARE = ("counter_camera", "robot", "receipt_printer")
READING = 20.0  # READING is the time limit in s for roslaunch to read the file on a busy machine.
# This code lets roslaunch read a launch file with the given arguments, and prints its nodes and parameters.
READER = """
import re, sys
from roslaunch.config import load_config_default
config = load_config_default([(sys.argv[1], sys.argv[2:])], None)
for node in config.nodes:
    print("node", node.namespace + node.name, node.package, node.type, node.launch_prefix or "")
    remapped = [*node.remap_args, *re.findall(r"(?<!\\S)([^_\\s:]\\S*):=(\\S+)", node.args or "")]
    for old, new in remapped:
        if new.strip("/") != old.strip("/"):
            print("remapped", node.namespace + node.name, old, new)
    for key, value in node.env_args:
        print("environment", node.namespace + node.name, key, value)
    print("respawn_delay", node.namespace + node.name, node.respawn_delay)
    for key, value in re.findall(r"(?<!\\S)_(\\w+):=(\\S+)", node.args or ""):
        print(f"{node.namespace}{node.name}/{key}: {value}")
for parameter in config.params.values():
    print(f"{parameter.key}: {parameter.value!r}")
"""

UNDECLARED = 'An argument is not declared. Write an <arg> tag for "wait" and an <arg> tag for "hardware".'
NO_XML = "The file is not valid XML. Close each tag, and write each value in quotes."
FIXED = (
    'An <arg> tag has the attribute "value", so a user cannot change the argument. Use the attribute '
    '"default" instead.'
)
REQUIRED = 'The file does not work without arguments. Add the attribute "default" to each <arg> tag.'
NO_BOOLEAN = 'The value of the attribute "if" has to be true or false. Write if="$(arg hardware)".'
OTHER = (
    "roslaunch cannot read the file. Type `roslaunch --nodes my_cashier cashier.launch` in the "
    "terminal, and read the output of this command."
)
UNREADABLE: Hints = [
    (matches("Invalid roslaunch XML|not well-formed|mismatched"), NO_XML),
    (matches("cannot override arg"), FIXED),
    (matches("unused args"), UNDECLARED),
    (matches("requires the|requires.*arg"), REQUIRED),
    (matches("is not a valid|invalid boolean|not a .?bool"), NO_BOOLEAN),
    (ANYTHING, OTHER),
]
NO_HARDWARE = (
    "With hardware:=false, counter_camera, robot and receipt_printer must not start. Put these "
    'nodes into a <group> tag with the attribute "if".'
)
DEFAULT_HARDWARE = (
    'If the user sets no argument, the nodes of the hardware have to start. Write default="true", '
    "and use the attribute "
    '"if", not "unless".'
)
PROGRAMS = (
    'A <node> tag starts the wrong program. Check the attributes "pkg" and "type" of each <node> tag. '
    "In the package my_cashier, the type is the node's name with .py at its end."
)
NO_PARAMETER = (
    'The node robot_cashier has no parameter "wait". Add a <param> tag with name="wait" and '
    'value="$(arg wait)".'
)
PLACE = (
    'The parameter "wait" does not belong to robot_cashier. Write the <param> tag inside the '
    "<node> tag of robot_cashier."
)
TEXT = (
    'The value of the parameter "wait" is a string. Remove the attribute "type" of the <param> '
    "tag, so that roslaunch stores a number."
)
DEFAULT_WAIT = (
    'If the user sets no argument, the value of "wait" has to be 2 s. Write default="2.0" in the '
    '<arg> tag of "wait".'
)
NOT_PASSED = (
    "The parameter always has the same value, even if the user passes another value. Write "
    'value="$(arg wait)".'
)
IN_NAMESPACE = (
    "In a namespace, the node robot_cashier does not get the parameter, because its name in the file begins "
    "with a slash. Write the <param> tag inside the <node> tag of robot_cashier."
)
SIMULATED = (
    "The parameter /use_sim_time is true, so the nodes use the time of a clock that does not exist, and each "
    "rospy.sleep() waits without end. Remove this parameter."
)
OTHER_MASTER = (
    "The file sets ROS_MASTER_URI for a node, so the other nodes cannot find this node. Remove the <env> "
    "tag: all nodes use the same master."
)
LISTED = "Start the nodes of the hardware only with hardware:=true. Always start all other nodes."


@part(
    "15.10",
    points=2,
    goal=('Write cashier.launch: it starts the whole system, and has the arguments "wait" and "hardware".'),
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
    goals=[LISTED, 'Pass the argument "wait" to the node robot_cashier, and start the right programs.'],
)
def the_launch_file(context: CheckContext) -> None:
    """Examine the nodes, programs and parameters that roslaunch would start and set."""
    package = copied(context, MY_CASHIER, examined=LAUNCH, alone=True)
    wait = context.random.number(2.5, 9.0)
    given = [f"wait:={wait}", "hardware:=false"]
    with ExitStack() as ending:
        listed = [ending.enter_context(_roslaunch(package, words)) for words in ([], given)]
        for command, words, wanted in zip(listed, ([], given), ((*HARDWARE, *NODES), NODES), strict=True):
            _lists(context, _read(context, command), " ".join(words) or "no argument", wanted)
    context.fulfilled(LISTED)
    for words, value in (([], 2.0), (given, wait)):
        given_words = " ".join(words)
        line = reader_line(*words)
        worded = f"the nodes and the parameters of {FILE} {given_words}"
        printed = package.run(line, within=READING, worded=worded.strip()).out
        passes_the_argument(context, printed, value, words)
        starts_programs(context, printed)
        _remaps_nothing(context, printed)
        _keeps_clock_and_master(context, printed)
    space = f"/{context.random.word()}"
    line = f"env ROS_NAMESPACE={space} {reader_line(*given)}"
    worded = f"the parameters of {FILE} in the namespace {space}"
    printed = package.run(line, within=READING, worded=worded).out
    passes_the_argument(context, printed, wait, given, space)


def reader_line(*given: str) -> str:
    """Return the command line that runs READER for the launch file with the arguments `given`."""
    return " ".join(["python3 -c", f"'{READER}'", FILE, *given])


def _remaps_nothing(context: CheckContext, printed: str) -> None:
    """Report a failure if the launch file remaps a name of a node."""
    for node, old, new in re.findall(r"^remapped (\S+) (\S+) (\S+)", printed, re.MULTILINE):
        context.fail(
            "each node starts the right program with the right names",
            expected=f"the node {node} with the name {old}",
            actual=f"the name {new}",
            hint=(
                "The file gives another name to a topic or service of a node, so other nodes do not find it. "
                'Remove the <remap> tag, or the part with := in the attribute "args".'
            ),
        )


def _keeps_clock_and_master(context: CheckContext, printed: str) -> None:
    """Assert that the nodes use the clock of the computer, and the same master."""
    for pattern, hint in (
        (r"^/use_sim_time: '?true.*", SIMULATED),
        (r"^environment \S+ ROS_MASTER_URI .*", OTHER_MASTER),
    ):
        found = re.search(pattern, printed, re.MULTILINE | re.IGNORECASE)
        context.require(
            "each node uses the clock of the computer and the same master",
            holds=found is None,
            expected="no other clock, and no other master",
            actual=found[0] if found else "",
            hints=hint,
        )


def _roslaunch(package: BuiltPackage, words: list[str]) -> Running:
    return package.start(" ".join(["roslaunch --nodes my_cashier cashier.launch", *words]))


def _printed(command: Running) -> tuple[int | None, str]:
    wait_until(lambda: command.status is not None, READING, 0.05)
    status = command.status
    return status, command.stop().out


def _read(context: CheckContext, command: Running) -> str:
    """Assert that roslaunch can read the launch file; return roslaunch's output."""
    status, printed = _printed(command)
    text = context.source(f"file:{FILE}")
    asked = re.search(r"requires the '(\w+)' arg", printed)
    undeclared = bool(asked) and not re.search(rf"<arg[^>]*name=.{asked[1] if asked else ''}\W", text)
    context.require(
        "roslaunch can read the file",
        holds=status == 0,
        expected="a list of the nodes in the file",
        actual=telling_line(printed),
        hints=[(lambda _: undeclared, UNDECLARED), *UNREADABLE],
    )
    return printed


def _lists(context: CheckContext, printed: str, given: str, wanted: Sequence[str]) -> None:
    nodes = {line.strip().removeprefix("/") for line in printed.splitlines() if line.startswith("/")}
    missing, others = sorted(set(wanted) - nodes), sorted(nodes - set(wanted))
    missing_hint = (
        DEFAULT_HARDWARE
        if set(missing) == set(HARDWARE)
        else (
            f"The file does not start {', '.join(missing)}. Compare the names of the nodes with the "
            "names in the exercise."
        )
    )
    context.require(
        "the file starts the nodes of the exercise",
        holds=not missing,
        expected=f"{', '.join(wanted)} for {given}",
        actual=", ".join(sorted(nodes)) or "no node",
        hints=missing_hint,
    )
    context.require(
        "the file does not start other nodes",
        holds=not others,
        expected=f"{', '.join(wanted)} for {given}",
        actual=", ".join(sorted(nodes)),
        hints=NO_HARDWARE
        if set(others) <= set(HARDWARE)
        else (
            f"The file starts a node {others[0]}, which is not in the exercise. Remove this node from "
            "the file."
        ),
    )


def passes_the_argument(
    context: CheckContext, printed: str, wait: float, given: list[str], space: str = ""
) -> None:
    """Assert that the private parameter of the cashier has the value of the argument `wait`.

    `space` is the namespace of all nodes, such as "/shop".
    """
    found = re.search(rf"^{space}/robot_cashier/wait: *(.+)$", printed, re.MULTILINE)
    every = re.findall(r"^(\S*wait): *(.+)$", printed, re.MULTILINE)
    context.require(
        "the parameter /robot_cashier/wait has the value of the argument wait",
        holds=bool(found) and _number(found[1] if found else "") == wait,
        expected=f"{space}/robot_cashier/wait: {wait:g} for {' '.join(given) or 'no argument'}",
        actual=", ".join(f"{name}: {value}" for name, value in every) or "no parameter wait",
        hints=[
            (lambda _: bool(space), IN_NAMESPACE),
            (matches("no parameter"), NO_PARAMETER),
            (lambda _: not found, PLACE),
            (matches("wait: '"), TEXT),
            (lambda _: not given, DEFAULT_WAIT),
            (ANYTHING, NOT_PASSED),
        ],
    )


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def starts_the_hardware(context: CheckContext, printed: str, assertion: str) -> None:
    """Assert that the nodes of the hardware start; `printed` is the output of READER without arguments."""
    nodes = _nodes(printed)
    context.require(
        assertion,
        holds=set(HARDWARE) <= set(nodes),
        expected=f"a file that starts {', '.join(HARDWARE)} if no argument is given",
        actual=", ".join(nodes),
        hints=(
            "Without an argument, the file does not start all nodes of the hardware. Copy your file of "
            'exercise 15.10, and add only respawn="true".'
        ),
    )


def starts_no_hardware(context: CheckContext, printed: str, assertion: str) -> None:
    """Assert that no node of the hardware starts; `printed` is READER's output with hardware:=false."""
    nodes = _nodes(printed)
    context.require(
        assertion,
        holds=not set(HARDWARE) & set(nodes),
        expected=f"only {', '.join(NODES)} for hardware:=false",
        actual=", ".join(nodes),
        hints=NO_HARDWARE,
    )


def _nodes(printed: str) -> list[str]:
    """Return the names of the nodes in READER's output."""
    return re.findall(r"^node /(\S+) ", printed, re.MULTILINE)


def longest_delay(printed: str) -> float:
    """Return the longest `respawn_delay` (s) in READER's output."""
    return max(map(float, re.findall(r"^respawn_delay \S+ (\S+)", printed, re.MULTILINE)), default=0.0)


def starts_programs(
    context: CheckContext,
    printed: str,
    assertion: str = ("each node starts the right program with the right names"),
) -> None:
    """Assert that each node runs the program with the same name; `printed` is the output of READER."""
    for node, started in re.findall(r"^node /(\S+) (.*\S)", printed, re.MULTILINE):
        wanted = f"my_cashier {node}.py" if node in NODES else f"course_pkg {node}"
        context.require(
            assertion,
            holds=started == wanted,
            expected=wanted,
            actual=started,
            hints=PROGRAMS,
        )
