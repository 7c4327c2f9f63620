"""Compiles a turtle program in C++, and puts it into a folder in which rosrun can find it."""

from __future__ import annotations

from course_pkg.chapters.ch09_drive_turtles.checks.turtle_program import (
    MANIFEST,
    TurtleProgram,
    runnable_copy,
)
from course_pkg.checking import CheckContext, matches
from course_pkg.checking.shared.catkin_package import BuiltPackage, Package
from course_pkg.checking.shared.roscpp_program import compile_roscpp
from course_pkg.errors import ToolMissing
from course_pkg.workspace import missing_for_cpp

NAME = "my_turtles_cpp"
# For the compilation, -t limits the CPU time in s, and -f limits the size of a file in KiB. One source file
# takes 4 s.
LIMITS = "ulimit -t 40 -f 100000"
NO_SPIN = (
    matches("TimesUp"),
    "The call got no response. In each round of the loop, call ros::spinOnce(), because it runs the handler. "
    "Do not wait in the handler.",
)
RETURNED_FALSE = (
    matches("responded with an error: b''"),
    "The handler returned false, so the client got an error. Return true, unless the handler has to refuse "
    "the call.",
)
POLLING = (
    "Messages get lost if many of them arrive between two calls of ros::spinOnce(). Call ros::spin(), and "
    "use longer queues, such as 100, for the subscriber and the publisher."
)
COMPILING = 90.0  # The time limit of the compilation in s; the compilation takes 4 s on an idle machine.


def cpp(name: str) -> TurtleProgram:
    """Return the C++ program `name`, such as "spawn_turtle", of the package of chapter 14."""
    package = Package(NAME, {"package.xml": MANIFEST.format(name=NAME)})
    return TurtleProgram(package, f"src/{name}.cpp", name, _compiled, (NO_SPIN, RETURNED_FALSE), POLLING)


def _compiled(context: CheckContext, program: TurtleProgram) -> BuiltPackage:
    """Compile one file with catkin's compiler options; a build with CMake would take longer."""
    if missing := missing_for_cpp():
        raise ToolMissing(missing)
    copy = runnable_copy(context, program.package, [program.path])
    path = program.package.path(program.command)
    compile_roscpp(context, copy.folder, program.path, path, limits=LIMITS, within=COMPILING)
    return copy
