"""`course run`: runs a command in the course's environment, on the running graph or on a new graph."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from course_pkg.lab.graph import network
from course_pkg.lab.graph.graph import Which, graph_of_this_command
from course_pkg.lab.graph.notes import notes
from course_pkg.lab.shell import SHELL
from course_pkg.ros.process.supervised import SupervisedProcess

# The first plug-in gives each notebook its own master and folder. The second plug-in ignores pictures. The
# third plug-in makes pytest fail if a check in a notebook did not pass.
NBVAL_PLUGINS = (
    "course_pkg.authoring.private_notebook",
    "course_pkg.authoring.nbval_figures",
    "course_pkg.grading.nbval.plugin",
)
SANITIZE = Path(__file__).parents[1] / "authoring" / "nbval_sanitize.cfg"
AWAITED = {signal.SIGCHLD, signal.SIGINT, signal.SIGTERM, signal.SIGHUP}


def run_command(command: Sequence[str], which: Which = Which.RUNNING) -> int:
    """Run the command on a graph, end its background processes, and return its exit status.

    The exit status is 128 + n if signal n ended the command. Raises GraphError if the graph or the command
    cannot be started.
    """
    if list(command) == ["bash"]:
        command = SHELL
    command = _with_plugins(command)
    with graph_of_this_command(which) as graph, _signals_held_back():
        if graph:
            graph.wait_for_master()
            network.enter(graph.files)
            if sys.stderr.isatty():
                sys.stderr.write(notes(graph, which))
        process = SupervisedProcess(command, foreground=True)
        status = _wait(process)
    return 128 - status if status < 0 else status


def _with_plugins(command: Sequence[str]) -> list[str]:
    """Return the command; if it runs notebooks with nbval, add the course's pytest plug-ins."""
    given = list(command)
    runs_pytest = Path(given[0]).name in ("pytest", "py.test") or given[1:3] == ["-m", "pytest"]
    if not runs_pytest or not any(word.startswith("--nbval") for word in given):
        return given
    plugins = [option for plugin in NBVAL_PLUGINS for option in ("-p", plugin)]
    sanitized = any(word.startswith("--nbval-sanitize-with") for word in given)
    return [*given, *plugins, *([] if sanitized else ["--nbval-sanitize-with", str(SANITIZE)])]


@contextmanager
def _signals_held_back() -> Iterator[None]:
    """Block signals; only sigwaitinfo() then receives them.

    The command starts while the signals are blocked, so no signal is lost.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, AWAITED)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _wait(process: SupervisedProcess) -> int:
    """Wait for the end of the process, and forward signals to the process.

    The function does not forward a signal that the terminal has already sent to the process.
    """
    while (status := process.returncode) is None:
        received = signal.sigwaitinfo(AWAITED)
        # If a signal comes from the terminal, the pid of its sender is 0. The terminal also sends the signal
        # to the command, so this process must not forward it.
        if received.si_signo != signal.SIGCHLD and received.si_pid:
            process.signal(received.si_signo)
    return status
