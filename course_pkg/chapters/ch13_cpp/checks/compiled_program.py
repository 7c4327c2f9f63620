"""Functions that compile a C++ program of the student, and start it with random names."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from contextlib import contextmanager

from course_pkg.checking import CheckContext
from course_pkg.checking.commands.folder import Folder, Running
from course_pkg.checking.shared.roscpp_program import compile_roscpp, require_no_other_program
from course_pkg.errors import ToolMissing
from course_pkg.waiting import at_this_load
from course_pkg.workspace import missing_for_cpp

PACKAGE = "src/cpp_boxes"
BOX = "course_pkg/geometry"
# For the compilation, -t limits the CPU time in s, and -f limits the size of a file in KiB. One source file
# takes 2 s.
LIMITS = "ulimit -t 30 -f 100000"
COMPILING = 60.0  # The compilation may take up to this time in s; it takes 2 s on an idle machine.
# The program's node must be on the graph within this time in s; it takes 0.1 s on an idle machine.
STARTING = 6.0
REGISTERING = 1.5  # After its node is on the graph, the program must offer its service within this time in s.
STAYING = 0.4  # The program must still run after this time in s; without ros::spin(), it ends within 0.1 s.
POLL = 0.05  # POLL is the time in s between two snapshots of the graph.
SERVED = "the program offers /{0} and continues to run"

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def require_tools() -> None:
    """Raise ToolMissing if no C++ program can be built on this machine."""
    if missing := missing_for_cpp():
        raise ToolMissing(missing)


def code_of(context: CheckContext, file: str) -> str:
    """Return the text of the student's file without comments."""
    return _COMMENT.sub("", context.source(f"file:{file}"))


def compiled(context: CheckContext, file: str, text: str = "") -> Folder:
    """Compile the student's `file` to ./program in a new folder; assert that the compilation succeeds.

    If `text` is given, it replaces the text of the file.
    """
    require_tools()
    folder = context.folder(texts={file: text}) if text else context.folder(files=[file])
    compile_roscpp(context, folder, file, "program", limits=LIMITS, within=COMPILING)
    return folder


@contextmanager
def started(context: CheckContext, folder: Folder, service: str, name: str) -> Iterator[Running]:
    """Run ./program as a node with a random name; it must not execute another program.

    The program's service `service`, such as "box", is remapped to the name `name`.
    """
    line = ["./program", f"/{service}:={name}", f"__name:={context.random.word()}"]
    with folder.start(*line, worded=f"the program that serves /{service}") as running:
        yield running
        require_no_other_program(context, running)


def serves(context: CheckContext, running: Running, service: str, name: str, code: str) -> None:
    """Assert that the program offers the service `name` and continues to run; if not, report the reason."""
    assertion, deadline = SERVED.format(service), time.monotonic() + at_this_load(STARTING)
    while context.look().service(name) is None:
        if running.status is not None or time.monotonic() > deadline:
            _does_not_serve(context, running, assertion, code)
        if any(map(context.random.made, (node.name for node in context.look().nodes))):
            deadline = min(deadline, time.monotonic() + at_this_load(REGISTERING))
        time.sleep(POLL)
    time.sleep(STAYING)
    if running.status is not None:
        _does_not_serve(context, running, assertion, code)
    context.require(assertion, holds=True)
    require_no_other_program(context, running)


def _drops_the_service(code: str) -> bool:
    """Return whether the code does not store the result of advertiseService, so that the service ends."""
    return bool(re.search(r"(?:^|[;{}])\s*\w+\.advertiseService", code))


def _does_not_serve(context: CheckContext, running: Running, assertion: str, code: str) -> None:
    finished = running.stop()
    if finished.status is None:
        seen = "a node that runs, but does not offer this service"
    else:
        last = finished.out.strip().rpartition("\n")[2]
        seen = f"a program that ends with exit status {finished.status}{f', and {last}' if last else ''}"
    context.fail(
        assertion,
        expected="a server that continues to run",
        actual=seen,
        hint=_why_not(finished.status, code),
    )


def _why_not(status: int | None, code: str) -> str:
    if _drops_the_service(code):
        return (
            "advertiseService returns an object, and the service ends when this object is "
            "deleted. Store the object in a variable: ros::ServiceServer server = …"
        )
    if status is None:
        return (
            "The node does not offer a service with the right name. Compare the name in your program "
            "with the name in the exercise, and create the NodeHandle without an argument."
        )
    if status < 0 or status > 100:
        return "The program crashed. Call ros::init before you create the first NodeHandle."
    if "Spinner" in code:
        return (
            "The program ends, because main starts the spinner and then returns. Call "
            "ros::waitForShutdown() at the end of main."
        )
    return "The program ends, so its service also ends. Call ros::spin() at the end of main."
