"""How a check compiles one program of the student's, and starts it under a name of the check's own."""

from __future__ import annotations

import re
import shlex
import time

from course_pkg.building import Fault, explain, missing_for_cpp
from course_pkg.building.cpp import compile_command
from course_pkg.errors import ExamError, ToolMissing
from course_pkg.examiner import Exam
from course_pkg.examiner.folder import Folder, Running

PACKAGE = "src/cpp_boxes"
BOX = "course_pkg/geometry"
LIMITS = "ulimit -t 30 -f 100000"  # s of a processor and KiB of a file; compiling one file takes 2 s
COMPILING = 60.0  # s; it takes 2 on a machine at rest
STARTING = 15.0  # s for a program to serve; it takes 0.1 on a machine at rest
STAYING = 0.4  # s; a program whose main ends behind advertiseService is gone after 0.1
LOOK = 0.05  # s between looks
SERVED = "it serves /{0}, and goes on"

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def require_tools() -> None:
    """Raise ToolMissing where no C++ program can be built."""
    if missing := missing_for_cpp():
        raise ToolMissing(missing)


def code_of(exam: Exam, file: str) -> str:
    """Return the text of the student's file without comments."""
    return _COMMENT.sub("", exam.source(f"file:{file}"))


def compiled(exam: Exam, file: str) -> Folder:
    """Compile the student's `file` to ./program in a new folder; that this works is a rule."""
    require_tools()
    folder = exam.folder(files=[file])
    line = f"{LIMITS}; exec {shlex.join(compile_command(file, 'program'))}"
    done = folder.command("bash", "-c", line, within=COMPILING, worded=f"the compiler, at {file}")
    if done.status is None:
        raise ExamError(
            f"The compiler was not done after {COMPILING:g} s: the machine is busy. Run this cell again."
        )
    if done.status != 0:
        fault = explain(done.err + done.out) or Fault("The compiler ended without a word.", "Try again.")
        exam.fail(
            "the compiler takes it",
            expected="a program",
            seen=f"line {fault.line}: {fault.problem}" if fault.line else fault.problem,
            hint=fault.remedy,
        )
    exam.hold("the compiler takes it", True)
    return folder


def started(exam: Exam, folder: Folder, service: str, name: str) -> Running:
    """Start ./program, with its `service` (such as "box") under `name` and a node name that is drawn."""
    line = ["./program", f"/{service}:={name}", f"__name:={exam.draw.word()}"]
    return folder.start(*line, worded=f"the program that serves /{service}")


def serves(exam: Exam, running: Running, service: str, name: str, code: str) -> None:
    """Hold that the program serves `name` and goes on; where it does not, say what it does instead."""
    rule, deadline = SERVED.format(service), time.monotonic() + STARTING
    while exam.look().service(name) is None:
        over = time.monotonic() > deadline
        if running.status is not None or over or (_is_quiet(code) and _settled(running)):
            _does_not_serve(exam, running, rule, service, code)
        time.sleep(LOOK)
    time.sleep(STAYING)
    if running.status is not None:
        _does_not_serve(exam, running, rule, service, code)
    exam.hold(rule, True)


def _is_quiet(code: str) -> bool:
    """Say whether the code drops what advertiseService returns: there is no point in waiting for it."""
    return bool(re.search(r"(?:^|[;{}])\s*\w+\.advertiseService", code))


def _settled(running: Running) -> bool:
    """Wait for a moment in which a node that starts has long started."""
    time.sleep(1.0)
    return running.status is None


def _does_not_serve(exam: Exam, running: Running, rule: str, service: str, code: str) -> None:
    done = running.stop()
    mine = [each.name for each in exam.look().services if each.name.rpartition("/")[2] == service]
    if done.status is None:
        seen = "a node that goes on, and serves nothing of that name"
    else:
        last = done.out.strip().rpartition("\n")[2]
        seen = f"a program that ends with exit status {done.status}{f', and {last}' if last else ''}"
    exam.fail(rule, expected="a server that goes on", seen=seen, hint=_why_not(done.status, code, mine))


def _why_not(status: int | None, code: str, mine: list[str]) -> str:
    if _is_quiet(code):
        return (
            "What advertiseService returns is the service: when the last copy of it goes, the service goes. "
            "Keep it in a variable: ros::ServiceServer server = …"
        )
    if mine:
        return f"It serves {mine[0]}. A name without a tilde, and with no namespace, is asked for."
    if status is None:
        return "It runs, and serves nothing of that name: is advertiseService missing, or its name another?"
    if status < 0 or status > 100:
        return "It crashed. Does ros::init stand before the first NodeHandle, and is every pointer one?"
    if "Spinner" in code:
        return "A spinner that was started works beside main: main has to wait, by ros::waitForShutdown()."
    return "main came to its end, and the service with it. ros::spin() waits, and hands out what arrives."
