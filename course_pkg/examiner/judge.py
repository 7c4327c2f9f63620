"""The judge: carries out one check as a node of its own, writes the record, tells the desk."""

from __future__ import annotations

import os
import secrets
import select
import signal
import socket
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from course_pkg.errors import CourseError, LinkError, ToolMissing
from course_pkg.examiner.exam import Exam
from course_pkg.examiner.ledger import RuleBroken
from course_pkg.examiner.link import PROTOCOL, Link
from course_pkg.examiner.node import on_the_graph
from course_pkg.examiner.parts import Part, find
from course_pkg.examiner.report import Report, Rule, Verdict
from course_pkg.state import state_folder, write_json

GREETING = 10.0  # s to wait for the desk's first word


class Ended(BaseException):
    """The kernel is gone, or somebody asked this process to end."""


class DeadlinePassed(BaseException):
    """The check has had its time; no `except Exception` in a check keeps this."""


def main() -> None:
    """Judge one check over the socket whose descriptor is the first argument, then end at once."""
    link = Link(socket.socket(fileno=int(sys.argv[1])))
    with suppress(Ended), ended_by(link):
        judge(link, state_folder() / "results")
    sys.stderr.flush()
    os._exit(0)  # rospy's own ending sleeps for 0.6 s; what was registered is unregistered by now


def judge(link: Link, results: Path, only: str = "") -> Report:
    """Carry out the check that the desk asks for; write its record into `results`, then tell the desk.

    With `only`, no other check than that is carried out.
    """
    seed = int(os.environ.get("COURSE_SEED") or secrets.randbits(32))
    hello = link.receive(GREETING)
    check = str(hello.get("check"))
    try:
        if hello.get("protocol") != PROTOCOL:
            raise CourseError("The kernel runs another release of the course: restart the kernel.")
        if only and check != only:
            raise CourseError(f"The kernel asked for the check {check[:20]!r} where {only!r} is due.")
        report = _examined(find(check), link, seed)
        write_json(results / f"{check}.json", record(report, seed))
    except CourseError as error:
        report = Report(check, Verdict.UNDECIDED, note=str(error))
    with suppress(LinkError):
        link.send({"report": report.as_dict()})
    return report


def record(report: Report, seed: int) -> dict[str, Any]:
    """Return what is kept of a report: enough to grade by, and to see it again with COURSE_SEED."""
    return {**report.as_dict(), "seed": seed, "time": time.time(), "course": _course_version()}


def _examined(part: Part, link: Link, seed: int) -> Report:
    if note := _not_attempted(part, link):
        return _report(part, Verdict.NOT_ATTEMPTED, note=note)
    with on_the_graph(part.check) as node:
        return _verdict(part, Exam(part, link, node, seed))


def _verdict(part: Part, exam: Exam) -> Report:
    try:
        with exam, _deadline(part.deadline):
            part(exam)
    except RuleBroken:
        return _report(part, Verdict.FAILED, exam.rules)
    except ToolMissing as error:
        return _report(part, Verdict.NOT_ATTEMPTED, note=str(error))
    except DeadlinePassed:
        return _report(part, Verdict.FAILED, (*exam.rules, _too_slow(part, exam)))
    except LinkError as error:
        return _report(part, Verdict.FAILED, exam.rules, f"The kernel gave no answer that counts: {error}.")
    return _report(part, Verdict.PASSED, exam.rules)


def _not_attempted(part: Part, link: Link) -> str:
    """Return what to do first, when something that the check needs is not there yet."""
    for name in part.needs:
        answer = link.ask("look", timeout=5.0, name=name)
        shown = name.removeprefix("file:")
        if answer.get("kind") == "stub":
            return f"Replace the ... in {shown}, run that cell, then this one."
        if answer.get("kind") == "missing":
            alike = [str(other) for other in answer.get("alike", [])]
            found = f" There is {' and '.join(alike)}: is it spelt as the exercise asks?" if alike else ""
            return f"{shown} is not there: run the cell above first.{found}"
    return _untouched(part, link)


def _untouched(part: Part, link: Link) -> str:
    """Return what to do, when a file that is to be repaired is still as it was handed out."""
    first, _, text = part.start.partition("\n")
    path = first.removeprefix("%%writefile").strip()
    now = link.ask("source", timeout=5.0, name=f"file:{path}").get("text") if path else None
    if now is None or str(now).strip() != text.strip():
        return ""
    return f"{path} is as it was handed out. Repair it in the cell above, run that cell, then this one."


def _too_slow(part: Part, exam: Exam) -> Rule:
    return Rule(
        f"it is done within {part.deadline:g} s",
        holds=False,
        seen=f"still {exam.doing}" if exam.doing else "",
        hint="Something waits without end: look for a loop or a wait that has no way out.",
    )


def _report(part: Part, verdict: Verdict, rules: tuple[Rule, ...] = (), note: str = "") -> Report:
    earned = part.points if verdict is Verdict.PASSED else 0
    return Report(part.check, verdict, part.goal, earned, part.points, rules, note)


@contextmanager
def _deadline(seconds: float) -> Iterator[None]:
    def ring(*_: object) -> None:
        raise DeadlinePassed

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@contextmanager
def ended_by(link: Link) -> Iterator[None]:
    """Raise Ended in the main thread when the other end of `link` goes away, or on SIGTERM."""

    def end(*_: object) -> None:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # once is enough: clearing up must not be broken off
        raise Ended

    signal.signal(signal.SIGTERM, end)
    over = threading.Event()
    threading.Thread(target=_watch, args=(link.fileno(), over), daemon=True).start()
    try:
        yield
    finally:
        over.set()


def _watch(descriptor: int, over: threading.Event) -> None:
    poll = select.poll()
    poll.register(descriptor, getattr(select, "POLLRDHUP", 0))
    while not over.is_set():
        if poll.poll(200):
            if not over.is_set():
                os.kill(os.getpid(), signal.SIGTERM)
            return


def _course_version() -> str:
    try:
        return version("course_pkg")
    except PackageNotFoundError:
        return "unknown"
