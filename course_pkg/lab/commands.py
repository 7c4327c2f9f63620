"""The commands `course lab` and `course run`, and their options."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.errors import SetupError
from course_pkg.setup.commands import Command

if TYPE_CHECKING:
    from argparse import ArgumentParser

NEW, SHARED = "--new-graph", "--shared-graph"


def _lab(options: SimpleNamespace) -> int:
    from course_pkg.lab.jupyterlab import serve_lab

    return serve_lab(
        options.notebook,
        port=options.port,
        ip=options.ip,
        browser=options.browser,
        shared=options.shared_graph,
    )


def _lab_arguments(parser: ArgumentParser) -> None:
    parser.add_argument("notebook", nargs="?", help="the notebook to open (default: the first chapter)")
    parser.add_argument("--no-browser", dest="browser", action="store_false", help="do not open a browser")
    parser.add_argument(
        "--port", type=int, help=("the port to listen on (default: 8888, or the next free port)")
    )
    parser.add_argument("--ip", default="127.0.0.1", help="the address to listen on (default: 127.0.0.1)")
    parser.add_argument(
        SHARED,
        action="store_true",
        help="use the network of this computer, so that a robot or a second computer can connect",
    )


def _run(options: SimpleNamespace) -> int:
    from course_pkg.lab.graph.graph import Which
    from course_pkg.lab.run import run_command

    named = {NEW: Which.ALONE, SHARED: Which.SHARED}.get(options.rest[0])
    command = options.rest[1:] if named else options.rest
    if not command:
        raise SetupError(f"A command is missing after {options.rest[0]}. Example: course run {NEW} bash")
    return run_command(command, named or Which.RUNNING)


COMMANDS = {
    "lab": Command(
        "start a ROS graph and JupyterLab, and open the first chapter", _lab, add_arguments=_lab_arguments
    ),
    "run": Command(
        "run a command in the course's environment, on the running ROS graph or on a new graph",
        _run,
        rest=f"[{NEW} | {SHARED}] COMMAND [ARGUMENT …]",
    ),
}
