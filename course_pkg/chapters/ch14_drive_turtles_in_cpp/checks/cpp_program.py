"""Compiles a turtle program in C++, and puts it into a folder in which rosrun can find it."""

from __future__ import annotations

import shlex

from course_pkg.chapters.ch09_drive_turtles.checks.turtle_program import (
    MANIFEST,
    TurtleProgram,
    runnable_copy,
)
from course_pkg.checking import CheckContext
from course_pkg.checking.shared.catkin_package import BuiltPackage, Package
from course_pkg.checking.shared.roscpp_program import require_roscpp
from course_pkg.errors import CheckError, ToolMissing
from course_pkg.workspace import Fault, explain, missing_for_cpp
from course_pkg.workspace.cpp_support import compile_command

NAME = "my_turtles_cpp"
# The compilation may use this CPU time in s and write files of this size in KiB; one file takes 4 s.
LIMITS = "ulimit -t 40 -f 100000"
COMPILING = 90.0  # The compilation may take this many s; it takes 4 s on an idle machine.
COMPILES = "the compiler accepts the file"


def cpp(name: str) -> TurtleProgram:
    """Return the C++ program `name`, such as "spawn_turtle", of the package of chapter 14."""
    package = Package(NAME, {"package.xml": MANIFEST.format(name=NAME)})
    return TurtleProgram(package, f"src/{name}.cpp", name, _compiled)


def _compiled(context: CheckContext, program: TurtleProgram) -> BuiltPackage:
    """Compile one file with catkin's options, because CMake would take some seconds longer."""
    if missing := missing_for_cpp():
        raise ToolMissing(missing)
    copy = runnable_copy(context, program.package, [program.path])
    command = compile_command(program.path, program.package.path(program.command))
    done = copy.folder.command(
        "bash", "-c", f"{LIMITS}; exec {shlex.join(command)}", within=COMPILING, worded="the compiler"
    )
    if done.status is None:
        raise CheckError(
            f"The compiler had not finished after {done.took:.0f} s, because the machine is busy. "
            "Run this cell again."
        )
    if done.status != 0:
        fault = explain(done.err + done.out) or Fault("the compiler ended without a message", "")
        context.fail(
            COMPILES,
            expected="a program",
            actual=f"line {fault.line}: {fault.problem}" if fault.line else fault.problem,
            hint=fault.remedy,
        )
    context.require(COMPILES, holds=True)
    require_roscpp(context, copy.folder, program.package.path(program.command))
    return copy
