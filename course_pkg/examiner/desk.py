"""`check("05.1")`: the kernel's side of a check. It calls the judge, and shows what the judge says."""

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
from typing import IO, Any

import course_pkg
from course_pkg.errors import ExamError, LinkClosed, LinkError
from course_pkg.examiner.hands import Hands, Printed
from course_pkg.examiner.link import PROTOCOL, Link, connect
from course_pkg.examiner.report import Report, Verdict, report_from

PATIENCE = 90.0  # s without a word from the judge; a check's own deadline is far below
JUDGE = "import sys; sys.path.pop(0); from course_pkg.examiner.judge import main; main()"


def check(check_id: str, namespace: Mapping[str, Any] | None = None) -> Report:
    """Have part `check_id`, such as "05.1", examined by a node of its own, and return the report.

    The names that it needs are looked up in `namespace`: the notebook's, unless one is given. Whatever
    goes wrong stands in the report; only an interrupt is passed on, when the judge has ended.
    """
    check_id = str(check_id)
    if threading.current_thread() is not threading.main_thread():
        return _undecided(check_id, "Call check() in a cell of its own, not from another thread.")
    printed = Printed()
    hands = Hands(_notebook() if namespace is None else namespace)
    try:
        with redirect_stdout(printed), redirect_stderr(printed), _judge() as link:
            report = _attend(link, check_id, hands)
    except ExamError as error:
        return _undecided(check_id, str(error))
    finally:
        hands.close()
    return replace(report, printed=printed.text)


def _attend(link: Link, check_id: str, hands: Hands) -> Report:
    """Answer the judge's questions until it reports."""
    link.send({"protocol": PROTOCOL, "check": check_id})
    while True:
        message = link.receive(PATIENCE)
        if "report" in message:
            return report_from(message["report"])
        link.send(hands.answer(message))


@contextmanager
def _judge() -> Iterator[Link]:
    """Connect to the judge that waits outside (`COURSE_EXAMINER`), or start one."""
    if address := os.environ.get("COURSE_EXAMINER"):
        link = connect(address)
        try:
            yield link
        finally:
            link.close()
        return
    with _started_judge() as link:
        yield link


@contextmanager
def _started_judge() -> Iterator[Link]:
    """Start a judge; it ends with this block, and with this process, also a killed one."""
    if "ROS_MASTER_URI" not in os.environ:
        raise ExamError("There is no graph yet: run the set-up cell, the one with join(), first.")
    ours, theirs = socket.socketpair()
    with tempfile.TemporaryFile() as log:
        process = _spawn(theirs, log)
        theirs.close()
        link = Link(ours)
        try:
            yield link
        except LinkError as error:
            raise LinkClosed(_obituary(process, log)) from error
        finally:
            link.close()  # the judge notices, and clears up after itself
            _end(process)


def _spawn(theirs: socket.socket, log: IO[bytes]) -> subprocess.Popen[bytes]:
    """Start the judge in a session of its own, so that an interrupt of the kernel is not one of the judge.

    It finds the course and the workspace where this process found them, and looks into the notebook's folder
    after everything else if at all: a student's rospy.py there is not the judge's.
    """
    here = os.getcwd()
    course = str(Path(course_pkg.__file__).resolve().parent.parent)
    path = [entry for entry in sys.path if entry and os.path.abspath(entry) != here] + [course]
    return subprocess.Popen(
        [sys.executable, "-c", JUDGE, str(theirs.fileno())],
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


def _obituary(process: subprocess.Popen[bytes], log: IO[bytes]) -> str:
    """Say how the judge ended, with the last lines of what it wrote."""
    _end(process)
    log.seek(0)
    last = log.read()[-2000:].decode("utf-8", errors="replace").strip().splitlines()[-3:]
    return "\n".join(["The judge ended without a verdict; run this cell again.", *last])


def _notebook() -> Mapping[str, Any]:
    """Return the names of the notebook, or of the program, that this runs in."""
    if "IPython" in sys.modules:
        from IPython.core.getipython import get_ipython

        if shell := get_ipython():
            names: Mapping[str, Any] = shell.user_ns
            return names
    return vars(sys.modules["__main__"])


def _undecided(check_id: str, note: str) -> Report:
    return Report(check_id, Verdict.UNDECIDED, note=note)
