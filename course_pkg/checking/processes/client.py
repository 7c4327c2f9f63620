"""`check("05.1")`: the check client in the kernel.

The client calls the check runner, and shows the report.
"""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import replace
from pathlib import Path
from typing import IO

import course_pkg
from course_pkg.checking.channel import PROTOCOL, Channel, connect
from course_pkg.checking.kernel.agent import KernelAgent, PrintedText
from course_pkg.checking.plain_values import Value
from course_pkg.checking.report import Report, Verdict, report_from
from course_pkg.errors import ChannelClosed, ChannelError, CheckError
from course_pkg.ros.notebook.cells import Cells
from course_pkg.sharing.notice import notice

# The check runner has to send its next message within this time in s. The limit is long because a check can
# take up to 600 s in grading, on a busy machine, without a message.
TIMEOUT = 900.0
RUNNER = "import sys; sys.path.pop(0); from course_pkg.checking.processes.runner_process import main; main()"


def check(check_id: str, namespace: Mapping[str, Value] | None = None) -> Report:
    """Let a separate node examine the part `check_id`, such as "05.1", and return the report.

    `namespace` contains the names that the student has defined. If `namespace` is None, the names of the
    notebook are used. Errors of the check appear in the report. The only exception is KeyboardInterrupt; it
    is raised after the check runner has ended.
    """
    check_id = str(check_id)
    if threading.current_thread() is not threading.main_thread():
        return _undecided(
            check_id, "check() was called from another thread. Call check() in a separate cell."
        )
    printed = PrintedText()
    names = _notebook() if namespace is None else namespace
    cells = _cells()
    agent = KernelAgent(names, later_run=cells.later_run)
    try:
        with cells.check(), redirect_stdout(printed), redirect_stderr(printed), _runner() as channel:
            report = _serve(channel, check_id, agent)
    except (CheckError, ChannelError) as error:
        return _undecided(check_id, str(error))
    finally:
        agent.close()
    note = " ".join(filter(None, (report.note, notice())))
    return replace(report, printed=printed.text, note=note)


def _serve(channel: Channel, check_id: str, agent: KernelAgent) -> Report:
    """Respond to requests of the check runner until the check runner sends its report."""
    channel.send({"protocol": PROTOCOL, "check": check_id})
    while True:
        message = channel.receive(TIMEOUT)
        if isinstance(report := message.get("report"), dict):
            return report_from(report)
        channel.send(agent.reply(message))


@contextmanager
def _runner() -> Iterator[Channel]:
    """Connect to the check runner at COURSE_CHECK_RUNNER, or start one if the variable is not set."""
    if address := os.environ.get("COURSE_CHECK_RUNNER"):
        channel = connect(address)
        try:
            yield channel
        finally:
            channel.close()
        return
    with _started_runner() as channel:
        yield channel


@contextmanager
def _started_runner() -> Iterator[Channel]:
    """Start a check runner.

    The check runner ends after the `with` block or with this process, even after SIGKILL.
    """
    if "ROS_MASTER_URI" not in os.environ:
        raise CheckError("The node does not exist yet. First run the set-up cell, which calls join().")
    ours, theirs = socket.socketpair()
    with tempfile.TemporaryFile() as log:
        process = _spawn(theirs, log)
        theirs.close()
        channel = Channel(ours)
        try:
            yield channel
        except ChannelError as error:
            raise ChannelClosed(_how_it_ended(process, log)) from error
        finally:
            # When the channel is closed, the check runner unregisters its node.
            channel.close()
            _end(process)


def _spawn(theirs: socket.socket, log: IO[bytes]) -> subprocess.Popen[bytes]:
    """Start the check runner in a separate session, so an interrupt of the kernel does not reach it.

    The check runner imports the course and the workspace from the same folders as this process. The
    notebook's folder is searched last, or not at all, so a student's file rospy.py cannot replace the module
    rospy.
    """
    here = os.getcwd()
    course = str(Path(course_pkg.__file__).resolve().parent.parent)
    path = [entry for entry in sys.path if entry and os.path.abspath(entry) != here] + [course]
    return subprocess.Popen(
        [sys.executable, "-c", RUNNER, str(theirs.fileno())],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(path)},
        pass_fds=[theirs.fileno()],
        stdin=subprocess.DEVNULL,
        stdout=log,
        stderr=log,
        start_new_session=True,
    )


def _end(process: subprocess.Popen[bytes]) -> None:
    try:
        process.wait(2.0)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _how_it_ended(process: subprocess.Popen[bytes], log: IO[bytes]) -> str:
    """Return an error message with the last lines that the check runner printed."""
    _end(process)
    log.seek(0)
    last = log.read()[-2000:].decode("utf-8", errors="replace").strip().splitlines()[-3:]
    return "\n".join(["The check ended without a result. Run this cell again.", *last])


def _notebook() -> Mapping[str, Value]:
    """Return the global names of the notebook, or of the program that calls check()."""
    if "IPython" in sys.modules:
        from IPython.core.getipython import get_ipython

        if shell := get_ipython():
            names: Mapping[str, Value] = shell.user_ns
            return names
    return vars(sys.modules["__main__"])


def _cells() -> Cells:
    """Return the record of cell runs; the record is empty if rospy has not been imported yet."""
    if "rospy" not in sys.modules:
        return Cells(lambda _closes: None)
    from course_pkg.ros.node.join import cells

    return cells()


def _undecided(check_id: str, note: str) -> Report:
    return Report(check_id, Verdict.UNDECIDED, note=note)
