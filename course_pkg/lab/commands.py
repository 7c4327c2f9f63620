"""The commands `course lab` and `course run`, and their options."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.setup.commands import Command

if TYPE_CHECKING:
    from argparse import ArgumentParser


def _lab(options: SimpleNamespace) -> int:
    from course_pkg.lab.jupyterlab import serve_lab

    return serve_lab(options.notebook, port=options.port, ip=options.ip, browser=options.browser)


def _lab_arguments(parser: ArgumentParser) -> None:
    parser.add_argument("notebook", nargs="?", help="the notebook to open (the first chapter)")
    parser.add_argument("--no-browser", dest="browser", action="store_false", help="do not open a browser")
    parser.add_argument("--port", type=int, help="the port to listen on (8888, or the next free one)")
    parser.add_argument("--ip", default="127.0.0.1", help="the address to listen on (127.0.0.1)")


def _run(options: SimpleNamespace) -> int:
    from course_pkg.lab.run import run_command

    return run_command(options.rest)


COMMANDS = {
    "lab": Command(
        "start a ROS master, and JupyterLab with the first chapter", _lab, add_arguments=_lab_arguments
    ),
    "run": Command(
        "run a command in the environment, with its own ROS master", _run, rest="COMMAND [ARGUMENT …]"
    ),
}
