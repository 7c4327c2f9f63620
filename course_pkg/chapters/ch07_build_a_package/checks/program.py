"""Assertions about the programs of chapter 07.

Linux must be able to execute a program, rosrun must find the program, and the program must offer its service.
"""

from __future__ import annotations

import re
import time
from dataclasses import dataclass

from course_pkg.checking import CheckContext
from course_pkg.checking.commands.folder import Running
from course_pkg.checking.result import Finished
from course_pkg.checking.shared.catkin_package import BuiltPackage
from course_pkg.checking.shared.script import own_line, require_shebang
from course_pkg.checking.shared.served_by import require_served_by_program
from course_pkg.errors import CheckError
from course_pkg.workspace import explain

# A program must offer its service within this time in s; it takes 1 s on an idle machine, and 3 s on a busy
# machine.
STARTING = 15.0
IMPORTING = 15.0  # An import may take up to this time in s; it needs 0.4 s of CPU time.
MUCH = 6.0  # If an import needs more CPU time than this (in s), the script is in an endless loop.
POLL = 0.1  # POLL is the time in s between two snapshots of the graph.
LOGGERS = ("/get_loggers", "/set_logger_level")  # Every rospy node has these services.

# This code imports the script as a module. If the script calls a function such as rospy.init_node during the
# import, the import ends with a message.
IMPORTS = """\
import importlib.util, pathlib, sys, rospy, rospy.client
path, sys.argv[0] = sys.argv[1], "tests.py"  # A program with this name imports the script.
def began(*args, **kwargs):
    print("it began its work")
    sys.exit(3)
for name in ("init_node", "Service", "ServiceProxy", "wait_for_service", "spin", "myargv"):
    setattr(rospy, name, began)
    setattr(rospy.client, name, began)
spec = importlib.util.spec_from_file_location(pathlib.Path(path).stem, path)
module = importlib.util.module_from_spec(spec)
sys.modules[spec.name] = module  # dataclasses looks up the module there
spec.loader.exec_module(module)
sys.exit(77)
"""
# A process that imports the script ends with this exit status, unless the script ends the process earlier.
IMPORTED = 77
ENDINGS = (  # Each entry contains a pattern for the program's output, and a hint.
    (r"rospy\.init_node\(\) first", "A service needs a node. Call rospy.init_node before rospy.Service."),
    (
        r"no attribute '_request_class'",
        "Your program passed the class of the request or of the response. Pass the class of the "
        "service type to rospy.Service.",
    ),
    (
        r"(?s)(\w+)\.srv import.*No module named '\1'",
        "Your program imports the type from a package that does not exist. Import the type "
        "from your own package: from {own}.srv.",
    ),
    (
        r"No module named 'course_pkg\.(chapters|nodes)\b",
        "Your script starts or imports a program of the course. Write the code of the node yourself.",
    ),
    (
        r"(?s)Couldn't find executable named.*/install/",
        "rosrun does not find the installed script. Install a copy of the script, not a link to the script "
        "in src.",
    ),
    (
        r"required file not found|bad interpreter",
        "The first line of the script names a program that is not installed. Write a shebang "
        "that names python3.",
    ),
)


@dataclass(frozen=True)
class Program:
    """A script of a package: its path, such as "scripts/server.py", its node and its service."""

    file: str
    node: str = ""
    service: str = ""

    @property
    def name(self) -> str:
        """The name of the program in a rosrun command."""
        return self.file.rpartition("/")[2]


def is_a_script(context: CheckContext, path: str) -> None:
    """Assert that the first line of the student's file is a shebang for Python 3."""
    require_shebang(
        context,
        path,
        missing=(
            "Without a shebang, Linux runs the script with the shell, not with Python. Write a "
            "shebang in line 1."
        ),
        elsewhere="The shebang is in the wrong place. Write the shebang in the first column of line 1.",
        another="The shebang names the wrong program. Write a shebang that names python3.",
        windows="The file has Windows line endings. Save the file with Linux line endings.",
    )


def is_executable(context: CheckContext, path: str) -> None:
    """Assert that the student's script is executable."""
    context.require(
        "the script is executable",
        holds=context.command("test", "-x", path, files=[path]).status == 0,
        expected="an executable file",
        actual="a file without the permission to execute it",
        hints=(
            "The script is not executable. In a terminal, go to the folder of your workspace, "
            f"and type: chmod +x {path}"
        ),
    )


def can_be_imported(context: CheckContext, package: BuiltPackage, program: Program) -> None:
    """Assert that the script can be imported, and that the import starts no node."""
    path = package.package.path(program.file)
    line = f". devel/setup.bash && exec python3 -c '{IMPORTS}' {path}"
    done = package.folder.command("bash", "-c", line, within=IMPORTING, worded=f"import {program.name}")
    if done.status is None and not _never_ends(done):
        raise CheckError(
            f"The import of {program.name} had not finished after {done.took:.0f} s: the "
            "machine is busy. Run this cell again."
        )
    printed = done.out + done.err
    began = done.status in (None, 0) or "it began its work" in printed
    context.require(
        "an import of the script starts no node",
        holds=done.status == IMPORTED,
        expected="a script that only defines functions and classes",
        actual="a script that starts its work" if began else printed.strip().rpartition("\n")[2],
        hints=(
            "An import of the script starts the node. Move rospy.init_node and all lines after "
            'it below the line `if __name__ == "__main__":`.'
        )
        if began
        else why_not(package, program, done.status, printed, []),
    )


def _never_ends(done: Finished) -> bool:
    """Return True if an import that reached its time limit would never end.

    An import that never ends waits for ever, or is in an endless loop. An import that is only slow on a busy
    machine waits for a CPU most of the time.
    """
    return done.ran + done.queued < done.took / 2 or done.ran > MUCH


def serves(
    context: CheckContext, running: Running, package: BuiltPackage, program: Program, name: str, node: str
) -> None:
    """Wait until the node `node` offers the service `name`; if this takes too long, report the reason."""
    assertion = f"rosrun starts the program, and the program serves {program.service}"
    deadline = time.monotonic() + STARTING
    while (found := context.look().service(name)) is None:
        if running.status is not None or time.monotonic() > deadline:
            namespace = name.rpartition("/")[0]
            others = [
                each.name.removeprefix(namespace)
                for each in context.look().services
                if each.node.startswith(f"{namespace}/") and not each.name.endswith(LOGGERS)
            ]
            done = running.stop()
            context.fail(
                assertion,
                expected="a server that keeps running",
                actual=_seen(program, done.status, done.out),
                hint=why_not(package, program, done.status, done.out, others),
            )
        time.sleep(POLL)
    context.require(assertion, holds=True)
    context.require(
        f"the name of the node is {program.node}",
        holds=found.node == node,
        expected=program.node,
        actual=found.node.rpartition("/")[2],
        hints=(
            f'The name of the node is wrong. Pass "{program.node}" to rospy.init_node, without '
            "anonymous=True."
        ),
    )
    require_served_by_program(context, running, name)


def _seen(program: Program, status: int | None, printed: str) -> str:
    if status is None:
        return f"a program that runs, but does not serve {program.service}"
    last = printed.strip().rpartition("\n")[2]
    return f"exit status {status}{f', and {last}' if last else ', and no output'}"


def why_not(
    package: BuiltPackage, program: Program, status: int | None, printed: str, others: list[str]
) -> str:
    """Return the hint for a program that has ended, or that does not serve the right service."""
    if others:
        return (
            f"The program serves {', '.join(others)}, but not {program.service}. Change the name "
            "of the service."
        )
    if status is None:
        return (
            "The program runs, but it offers no service. Call rospy.Service with "
            f"{program.service} before rospy.spin()."
        )
    for pattern, hint in ENDINGS:
        if re.search(pattern, printed):
            return hint.format(own=package.package.name)
    if "Traceback" in printed or "Error" in printed:
        fault = explain(printed)
        return f"{fault.problem} {fault.remedy}" if fault else own_line(program.name, printed)
    return (
        "The program ended, so its service does not exist any more. Write rospy.spin() at the end: "
        "this function waits until the node is stopped."
    )
