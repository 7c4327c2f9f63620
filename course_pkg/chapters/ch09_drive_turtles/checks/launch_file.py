"""09.6: a launch file with an argument."""

from __future__ import annotations

import re
from dataclasses import dataclass

from course_pkg.chapters.ch09_drive_turtles.checks.turtle_program import (
    MANIFEST,
    SETUP,
    TurtleProgram,
    script,
)
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.commands.folder import becomes, telling_line
from course_pkg.checking.peers.node import closed_port
from course_pkg.checking.shared.catkin_package import BuiltPackage, Package
from course_pkg.ros import Snapshot

DRIVER, SECOND = "improved_pubvel_toggle", "spawn_turtle_plus"
# The check starts these programs of the course in place of missing programs of the student.
COURSE_PROGRAMS = (DRIVER, SECOND, "spawn_turtle", "driver_node", "driving")
ALWAYS = {"/turtlesim", f"/{DRIVER}"}
READY = 20.0  # On a busy machine, a launch file must start its nodes within this time in s.
# This script replaces a program that the student wrote in an earlier exercise, and starts the course's
# program.
STAND_IN = '#!/bin/bash\nexec rosrun course_pkg {name} "$@"\n'


@dataclass(frozen=True)
class LaunchFile:
    """A launch file of a package, and the two programs of this package that the launch file starts."""

    driver: TurtleProgram
    second: TurtleProgram
    file: str = "launch/exercise3.launch"

    @property
    def path(self) -> str:
        """The path of the student's file in the workspace."""
        return self.driver.package.path(self.file)

    @property
    def package(self) -> str:
        """The name of the package."""
        return self.driver.package.name


FILE = LaunchFile(script(DRIVER), script(SECOND))

START = f"""%%writefile {FILE.path}
<launch>
  <arg name="addturtle" default="true" />
  <node pkg="turtlesim" type="turtlesim" name="turtlesim" />
  <node pkg="{FILE.package}" type="{SECOND}" name="{SECOND}" />
</launch>
"""


@part(
    "09.6",
    points=2,
    goal=(
        "Repair exercise3.launch: always start the simulator and the driver, but start "
        "spawn_turtle_plus only with addturtle:=true."
    ),
    needs=[f"file:{FILE.path}"],
    deadline=60.0,
    start=START,
    runs=COURSE_PROGRAMS,
)
def two_turtles_or_one(context: CheckContext) -> None:
    """Examine the list of nodes in the launch file; then start these nodes with a separate master."""
    launches(context, FILE)


def launches(context: CheckContext, file: LaunchFile) -> None:
    """Assert that a launch file meets the requirements of the exercise about exercise3.launch."""
    copy = _copy(context, file)
    for argument, wanted in (("addturtle:=false", False), ("", False), ("addturtle:=true", True)):
        listed = copy.run(f"roslaunch --nodes {file.path} {argument}", within=20.0)
        context.require(
            "roslaunch can read the file",
            holds=listed.status == 0,
            expected="a list of nodes",
            actual=telling_line(listed.err or listed.out),
            hints=_UNREADABLE,
        )
        _lists(context, set(listed.out.split()), argument, wanted)
    _finds_the_programs(context, copy, file)
    _runs(context, copy, file)


def _copy(context: CheckContext, file: LaunchFile) -> BuiltPackage:
    """Return a package with a copy of the student's launch file and with the course's programs."""
    package = Package(file.package, {"package.xml": MANIFEST.format(name=file.package)})
    programs = {
        package.path(f"scripts/{program.command}"): STAND_IN.format(name=program.command.removesuffix(".py"))
        for program in (file.driver, file.second)
    }
    texts = {package.path(name): text for name, text in package.files.items()}
    folder = context.folder(files=[file.path], texts={**texts, **programs, "devel/setup.bash": SETUP})
    folder.command("chmod", "+x", *programs)
    return BuiltPackage(folder, package)


_UNREADABLE: Hints = [
    (
        matches("Invalid roslaunch XML|not well-formed|mismatched"),
        "The file is not valid XML. Close each tag, and write each value in quotes.",
    ),
    (
        matches("requires the 'addturtle'"),
        'The argument addturtle has no default value. Add default="false" to its <arg> tag.',
    ),
    (
        matches("cannot override arg"),
        "The <arg> tag gives the argument a fixed value, so the command cannot change this value. In "
        "the <arg> tag, write default= instead of value=.",
    ),
    (
        matches("not a 'bool' type"),
        'The value of the attribute "if" has to be true or false. Write if="$(arg addturtle)".',
    ),
    (
        ANYTHING,
        (
            "roslaunch cannot read the file. The message above names the line or the tag with the error: "
            "correct this line or tag."
        ),
    ),
]


def _lists(context: CheckContext, nodes: set[str], argument: str, wanted: bool) -> None:
    context.require(
        "roslaunch always starts the nodes turtlesim and improved_pubvel_toggle",
        holds=nodes >= ALWAYS,
        expected=", ".join(sorted(ALWAYS)),
        actual=", ".join(sorted(nodes)),
        hints='A node is missing or has a wrong name. Check the attribute "name" of each <node> tag.'
        if nodes - ALWAYS - {f"/{SECOND}"}
        else (
            "A node did not start. Write its <node> tag outside of every <group>, and without the "
            'attribute "if".'
        ),
    )
    others = nodes - ALWAYS - {f"/{SECOND}"}
    context.require(
        "roslaunch starts spawn_turtle_plus only if addturtle is true",
        holds=(f"/{SECOND}" in nodes) == wanted and not others,
        expected=(
            f"a list {'with' if wanted else 'without'} /{SECOND}, if the command has "
            f"{argument or 'no argument'}"
        ),
        actual=", ".join(sorted(nodes)),
        hints=[
            (
                (lambda _: others and wanted and f"/{SECOND}" not in nodes),
                "The node of spawn_turtle_plus has another name. Each of your nodes needs the name of its "
                'program: write name="spawn_turtle_plus".',
            ),
            (
                (lambda _: others),
                "The file starts an additional node. Remove its <node> tag, so that only the nodes in the "
                "exercise start.",
            ),
            (
                (lambda _: wanted),
                "With addturtle:=true, a node is missing. Compare the name of the argument in your "
                "condition with the name in the <arg> tag.",
            ),
            (
                (lambda _: not argument),
                (
                    "Without an argument, spawn_turtle_plus must not start. Set the default value of "
                    "addturtle to false."
                ),
            ),
            (
                ANYTHING,
                (
                    "spawn_turtle_plus also starts with addturtle:=false. Add a condition to its <node> "
                    'tag: use the attribute "if".'
                ),
            ),
        ],
    )


def _finds_the_programs(context: CheckContext, copy: BuiltPackage, file: LaunchFile) -> None:
    """Before any node is started, assert that roslaunch finds each program."""
    both = [f"{name},addturtle:=true" for name in ("turtlesim", DRIVER, SECOND)]
    each = (
        f"for n in {' '.join(both)} turtlesim, {DRIVER},; do roslaunch --args /${{n%,*}} {file.path}"
        ' ${n#*,} 2>&1 | sed "s|^|$n: |" & done; wait'
    )
    worded = f"roslaunch --args /NODE {file.path} addturtle:=true, for each node"
    done = copy.run(each, within=20.0, worded=worded)
    # roslaunch prints a traceback; its last line contains the name of the exception and the message.
    missing = re.findall(r"^(\w+),\S*: [\w.]+\.(\w+(?:Exception|NotFound): .*)", done.out, re.MULTILINE)
    context.require(
        "roslaunch finds the program of each node",
        holds=not missing,
        expected=f"three programs, two of them in {file.package}",
        actual=": ".join(missing[0]) if missing else "",
        hints=(
            'roslaunch does not find a program. In the <node> tag, set "pkg" to the package and '
            '"type" to the file name of the program.'
        ),
    )
    for name, program in zip(both[1:], (file.driver, file.second), strict=True):
        started = _started_as(done.out, name)
        own = rf"(\w+=\S* )*/\S*{file.package}/scripts/{program.command}( |$)"
        context.require(
            "roslaunch finds the program of each node",
            holds=any(re.match(own, line) for line in started),
            expected=f"{program.command} of {file.package} for /{name.partition(',')[0]}",
            actual=started[0] if started else telling_line(done.out),
            hints=(
                'A node starts a wrong program. In its <node> tag, set "pkg" to the name of your package '
                'and "type" to the file name of your own program, and do not include another launch file.'
            ),
        )
    for name in ("turtlesim", DRIVER):
        one = _started_as(done.out, f"{name},")
        if one != _started_as(done.out, f"{name},addturtle:=true"):
            _drives_both(context, "\n".join(one), holds=False)


def _started_as(printed: str, name: str) -> list[str]:
    """Return the lines after the node's name: the command with which roslaunch starts the node."""
    return re.findall(rf"^{name}: (.*)", printed, re.MULTILINE)


def _runs(context: CheckContext, copy: BuiltPackage, file: LaunchFile) -> None:
    uri = f"http://localhost:{closed_port()}"
    line = f"env ROS_MASTER_URI={uri} ROS_HOSTNAME=localhost roslaunch {file.path} addturtle:=true"
    with copy.start(line, worded="roslaunch") as launched:
        alike = becomes(uri, _both_are_driven, READY)
        printed = "" if alike else launched.stop().out
    _drives_both(context, printed, holds=alike)


def _drives_both(context: CheckContext, printed: str, *, holds: bool) -> None:
    context.require(
        "after the start, both turtle1 and MyTurtle receive velocities",
        holds=holds,
        expected="two turtles, each with a driver",
        actual=telling_line(printed),
        hints=(
            "The three programs start, but they use different names for the same topics or "
            'services. Remove the attributes "ns" and "args" and all <remap> tags.'
        ),
    )


def _both_are_driven(seen: Snapshot) -> bool:
    found = {topic.name: topic for topic in seen.topics}
    names = ("/turtle1/cmd_vel", "/MyTurtle/cmd_vel")
    return all(
        name in found and found[name].publishers and "/turtlesim" in found[name].subscribers for name in names
    )
