"""The check runner: it runs one check as a separate node, and sends the report."""

from __future__ import annotations

import os
import secrets
import time
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from importlib.metadata import PackageNotFoundError, version
from typing import TypeAlias

from course_pkg.checking.assertions import AssertionFailed
from course_pkg.checking.channel import PROTOCOL, Channel, require_current
from course_pkg.checking.context import CheckContext
from course_pkg.checking.credit import earned, with_fulfilled
from course_pkg.checking.parts import Part, find
from course_pkg.checking.peers.node import on_the_graph
from course_pkg.checking.report import Assertion, Report, Verdict
from course_pkg.errors import ChannelError, CheckError, CourseError, ToolMissing
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.waiting import at_this_load, interrupt_after

FIRST_MESSAGE = 10.0  # The client has to send its first message within this time in s.
LOOK = 5.0  # The client has to describe a name within this time in s.
Store: TypeAlias = "Callable[[str, Mapping[str, Json]], str]"


class DeadlinePassed(BaseException):
    """Raised after the time limit of the check; `except Exception` does not catch this error."""


def run_check(
    channel: Channel,
    store: Store | None = None,
    only: str = "",
    kernel: Callable[[], int] | None = None,
) -> Report:
    """Run the check that the client requests; return the report, and send it to the client.

    `store` is a function that gets the id of the check and its result. `store` returns a message for the
    report, or "". Without `store`, nothing is stored. If `only` is not empty, only the check with this id is
    run. `kernel` is a function that returns the process id of the kernel, or None if this id is not known.
    Raises ChannelError if the client does not request a check.
    """
    seed = int(os.environ.get("COURSE_SEED") or secrets.randbits(32))
    hello = channel.receive(FIRST_MESSAGE)
    check = str(hello.get("check"))
    try:
        if hello.get("protocol") != PROTOCOL:
            raise CourseError("The kernel runs a different release of the course. Restart the kernel.")
        if only and check != only:
            raise CourseError(f"The kernel requested the check {check[:20]!r} instead of {only!r}.")
        report = _run(find(check), channel, seed, kernel)
        message = store(check, record(report, seed)) if store else ""
        report = replace(report, note=" ".join(filter(None, (report.note, message))))
    except CourseError as error:
        report = Report(check, Verdict.UNDECIDED, note=str(error))
    with suppress(ChannelError):
        channel.send({"report": report.as_dict()})
    return report


def record(report: Report, seed: int) -> dict[str, Json]:
    """Return the data for grading, and the seed, which can repeat the check with COURSE_SEED."""
    return {**report.as_dict(), "seed": seed, "time": time.time(), "course": _course_version()}


def _run(part: Part, channel: Channel, seed: int, kernel: Callable[[], int] | None) -> Report:
    if note := _not_attempted(part, channel):
        return _report(part, Verdict.NOT_ATTEMPTED, note=note)
    with on_the_graph() as node:
        return _reported(part, CheckContext(part.check, channel, node, seed, kernel))


def _reported(part: Part, context: CheckContext) -> Report:
    results = context.results
    try:
        with context, interrupt_after(at_this_load(part.deadline), DeadlinePassed):
            part(context)
    except AssertionFailed:
        return _report(part, Verdict.FAILED, results.assertions, goals=results.kept_goals)
    except ToolMissing as error:
        return _report(part, Verdict.NOT_ATTEMPTED, note=str(error))
    except DeadlinePassed:
        shown = (*results.assertions, _too_slow(part, context))
        return _report(part, Verdict.FAILED, shown, goals=results.kept_goals)
    except ChannelError as error:
        note = f"The kernel sent an invalid reply: {error}."
        return _report(part, Verdict.FAILED, results.assertions, note)
    _require_marks(part, results.fulfilled_goals | results.failed_goals)
    if results.failed_goals:
        return _report(part, Verdict.FAILED, results.assertions, goals=results.fulfilled_goals)
    return _report(part, Verdict.PASSED, results.assertions, goals=[goal.text for goal in part.goals])


def _require_marks(part: Part, marked: set[str]) -> None:
    """Raise CheckError if the marked goals are not exactly the goals of the part.

    The last goal of the part need not be marked.
    """
    texts = {goal.text for goal in part.goals}
    if wrong := (marked - texts) | (texts - marked - {goal.text for goal in part.goals[-1:]}):
        raise CheckError(f"The check itself has a bug (goals: {', '.join(sorted(wrong))}).")


def _not_attempted(part: Part, channel: Channel) -> str:
    """Return an instruction for the student if a needed name is missing or blank, or "".

    A name is blank if its exercise is unchanged.

    For alternative names, such as `left|right`, the student has to define only one name.
    """
    for need in part.needs:
        replies = {name: channel.ask("look", timeout=LOOK, name=name) for name in need.split("|")}
        kinds = [reply.get("kind") for reply in replies.values()]
        blank = next((name for name, kind in zip(replies, kinds, strict=True) if kind == "blank"), "")
        if blank and {*kinds} <= {"blank", "missing"}:
            return (
                f"In {blank.removeprefix('file:')}, replace the three dots (`...`) with your "
                "answer, run that cell, and then run this cell again."
            )
        there = [reply for reply in replies.values() if reply.get("kind") != "missing"]
        if not there:
            name, reply = next(iter(replies.items()))
            shown = name.removeprefix("file:")
            alike = reply.get("alike")
            names = " and ".join(map(str, alike)) if isinstance(alike, list) else ""
            found = f" A similar name exists: {names}. Is this the name in the exercise?" if names else ""
            return f"{shown} is not defined. First run the cell above.{found}"
        for reply in there:
            require_current(reply)
    return _unchanged(part, channel)


def _unchanged(part: Part, channel: Channel) -> str:
    """Return an instruction for the student if the student has not changed the file to repair, or ""."""
    first, _, text = part.start.partition("\n")
    path = first.removeprefix("%%writefile").strip()
    now = channel.ask("source", timeout=LOOK, name=f"file:{path}").get("text") if path else None
    if now is None or str(now).strip() != text.strip():
        return ""
    return (
        f"The file {path} was not changed. Repair this file in the cell above, run that cell, "
        "and then run this cell again."
    )


def _too_slow(part: Part, context: CheckContext) -> Assertion:
    return Assertion(
        f"the check ends within {part.deadline:g} s",
        holds=False,
        actual=f"still {context.doing}" if context.doing else "",
        hint=(
            "Your code is in an endless loop, or it waits without a time limit. End the loop, or set "
            "a time limit for the wait."
        ),
    )


def _report(
    part: Part,
    verdict: Verdict,
    assertions: tuple[Assertion, ...] = (),
    note: str = "",
    goals: Iterable[str] = (),
) -> Report:
    """Return the report of the part `part`; `goals` are the texts of the fulfilled goals."""
    found = with_fulfilled(part.goals, goals)
    points = part.points if verdict is Verdict.PASSED else earned(found)
    return Report(part.check, verdict, part.goal, points, part.points, assertions, note, goals=found)


def _course_version() -> str:
    try:
        return version("course_pkg")
    except PackageNotFoundError:
        return "unknown"
