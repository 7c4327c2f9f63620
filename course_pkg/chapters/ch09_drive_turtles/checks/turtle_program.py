"""A turtle program in the student's package, in Python or in C++, and the copy that a check runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from course_pkg.chapters.ch07_build_a_package.checks.program import (
    Program,
    can_be_imported,
    is_a_script,
    is_executable,
)
from course_pkg.checking import CheckContext
from course_pkg.checking.assertions import Condition
from course_pkg.checking.shared.catkin_package import BuiltPackage, Package

# Pairs of a condition on the error message of a call, and a hint.
Pairs: TypeAlias = "Sequence[tuple[Condition, str]]"
NAME = "my_turtles"
MANIFEST = """\
<?xml version="1.0"?>
<package format="2">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>Programs that drive turtles.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
</package>
"""
# With this path, ROS finds the package without a build.
SETUP = 'export ROS_PACKAGE_PATH="$PWD/src:$ROS_PACKAGE_PATH"\n'


@dataclass(frozen=True)
class TurtleProgram:
    """A program that the student writes in an exercise.

    `file` is the path of the program in the package. `command` is the argument of rosrun that names the
    program. The function `prepare` asserts that the file is a program, and returns a copy of the package.
    rosrun can start the program from this copy. `errors` contains hints for calls of the program's services
    that fail. `polling` is the hint for a program that loses messages because it calls ros::spinOnce().
    """

    package: Package
    file: str
    command: str
    prepare: Callable[[CheckContext, TurtleProgram], BuiltPackage]
    errors: Pairs = ()
    polling: str = ""

    @property
    def path(self) -> str:
        """The path of the student's file in the workspace."""
        return self.package.path(self.file)

    @property
    def line(self) -> str:
        """The command that starts the program."""
        return f"rosrun {self.package.name} {self.command}"


def runnable_copy(context: CheckContext, package: Package, files: list[str]) -> BuiltPackage:
    """Copy some files of the student's package; rosrun finds the programs in the copy without a build."""
    texts = {package.path(file): text for file, text in package.files.items()}
    return BuiltPackage(context.folder(files=files, texts={**texts, "devel/setup.bash": SETUP}), package)


def script(name: str) -> TurtleProgram:
    """Return the script `name`, such as "spawn_turtle", of the package of chapter 09."""
    package = Package(NAME, {"package.xml": MANIFEST.format(name=NAME)})
    return TurtleProgram(package, f"scripts/{name}.py", f"{name}.py", _copied_script)


def _copied_script(context: CheckContext, program: TurtleProgram) -> BuiltPackage:
    is_a_script(context, program.path)
    is_executable(context, program.path)
    copy = runnable_copy(context, program.package, [program.path])
    can_be_imported(context, copy, Program(program.file))
    return copy
