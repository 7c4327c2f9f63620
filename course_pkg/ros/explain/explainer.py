"""Explaining an exception, or a text of any length with an error in it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from course_pkg.errors import CourseError
from course_pkg.ros.explain.explanation import Explanation, known
from course_pkg.workspace import explain as explain_build

LONGEST = 50_000  # characters at the end of a text that are searched
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_TRACEBACK = "Traceback (most recent call last)"
_BUILD = re.compile(r"^(?:CMake Error|-- |Base path:|Invoking \"|\[rospack\])", re.MULTILINE)

NOTHING = Explanation(
    "There are no words to go by. A call that only waits says nothing: rospy sets no time limit on a call.",
    "Ask who serves the name with `rosservice info`, and whether that node answers with `rosnode ping`.",
    "12",
    known=False,
)
UNKNOWN = Explanation(
    "These words are in none of the course's tables, so here is no guess at the cause.",
    "Read the last line first: it names the error. In a traceback, the lowest line that names your own file "
    "is where to begin.",
    known=False,
)


def explain(error: object) -> Explanation:
    """Return what an error means: cause, remedy, and the chapter that teaches it. It never raises.

    `error` is an exception, or text: its message, a traceback, lines of rospy's log, or what catkin_make,
    rosrun, roslaunch or roscore printed. For an error that is in no table, the result's `known` is False.
    """
    if isinstance(error, BaseException):
        return _of_exception(error)
    text = _COLOUR.sub("", "" if error is None else _string(error))[-LONGEST:].replace("\r\n", "\n")
    if not text.strip():
        return NOTHING
    return _of_text(text) or UNKNOWN


def _of_exception(error: BaseException) -> Explanation:
    """Return the explanation of an exception or of its cause; for the course's errors, their message."""
    for each in _chain(error):
        message = f"{type(each).__name__}: {_string(each)}"
        if found := known(message) or _of_build(message):
            return found
    if isinstance(error, CourseError):
        return Explanation(_string(error), "The message says it: what happened, where, and what to do next.")
    return UNKNOWN


def _string(thing: object) -> str:
    """Return an object as a string; empty if its __str__ raises an error."""
    try:
        return thing.decode("utf-8", "replace") if isinstance(thing, bytes) else str(thing)
    except Exception:  # noqa: BLE001 -- whatever a student's own class does when it is shown
        return ""


def _chain(error: BaseException) -> Iterator[BaseException]:
    """Yield the exception and its causes; a chain of causes may be a ring."""
    seen: set[int] = set()
    each: BaseException | None = error
    while each is not None and id(each) not in seen:
        seen.add(id(each))
        yield each
        each = each.__cause__ or each.__context__


def _of_text(text: str) -> Explanation | None:
    """Return the explanation of a text: of the output of a build, else of its last known error."""
    if _BUILD.search(text) and (found := _of_build(text)):
        return found
    for message in _candidates(text):
        if found := known(message):
            return found
    return _of_build(text)


def _candidates(text: str) -> Iterator[str]:
    """Yield possible error messages: those below tracebacks, the last first; then the whole text."""
    if _TRACEBACK in text:
        for part in reversed(text.split(_TRACEBACK)[1:]):
            yield from _below_frames(part)
    yield text


def _below_frames(part: str) -> Iterator[str]:
    """Yield the lines of a traceback that are neither frames nor code, such as `ValueError: boom`."""
    for line in reversed(part.splitlines()[1:]):
        if re.match(r"[\w.]+(?:: |$)", line) and not line.startswith(("During", "The above")):
            yield line


def _of_build(text: str) -> Explanation | None:
    fault = explain_build(text)
    if fault is None:
        return None
    place = f"{fault.place}: " if fault.place else ""
    return Explanation(f"{place}{fault.problem}", fault.remedy, "04")
