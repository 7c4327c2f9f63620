"""Explain an exception, or a text that contains an error message."""

from __future__ import annotations

import re
from collections.abc import Iterator

from course_pkg.errors import CourseError
from course_pkg.ros.explain.explanation import Explanation, known
from course_pkg.workspace import explain as explain_build

# Only the last `LONGEST` characters of a text are searched.
LONGEST = 50_000
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_TRACEBACK = "Traceback (most recent call last)"
_BUILD = re.compile(r"^(?:CMake Error|-- |Base path:|Invoking \"|\[rospack\])", re.MULTILINE)

NOTHING = Explanation(
    "There is no error message. A call in rospy has no time limit, and prints nothing while it waits.",
    (
        "Find the node of the server with `rosservice info`. Then check with `rosnode ping` "
        "whether this node answers."
    ),
    "12",
    known=False,
)
UNKNOWN = Explanation(
    "The course has no explanation for this error message.",
    "Read the last line first, because this line contains the error. In a traceback, look for "
    "the last line that contains the name of your own file.",
    known=False,
)


def explain(error: object) -> Explanation:
    """Return the explanation of an error: cause, remedy, and chapter. This function raises no exception.

    `error` is an exception, or a text: an error message, a traceback, lines of rospy's log, or the output of
    catkin_make, rosrun, roslaunch or roscore. If no table contains the error, `known` is False in the result.
    """
    if isinstance(error, BaseException):
        return _of_exception(error)
    text = _COLOUR.sub("", "" if error is None else _string(error))[-LONGEST:].replace("\r\n", "\n")
    if not text.strip():
        return NOTHING
    return _of_text(text) or UNKNOWN


def _of_exception(error: BaseException) -> Explanation:
    """Return the explanation of an exception, or else of another exception that caused it.

    If no table contains the message of a CourseError, this message is the explanation.
    """
    for each in _chain(error):
        message = f"{type(each).__name__}: {_string(each)}"
        if found := known(message) or _of_build(message):
            return found
    if isinstance(error, CourseError):
        return Explanation(_string(error), "Read the message: it contains the cause and the next step.")
    return UNKNOWN


def _string(thing: object) -> str:
    """Return an object as a string, or an empty string if its __str__ raises an error."""
    try:
        return thing.decode("utf-8", "replace") if isinstance(thing, bytes) else str(thing)
    except Exception:  # noqa: BLE001 -- a student's __str__ may raise any exception
        return ""


def _chain(error: BaseException) -> Iterator[BaseException]:
    """Yield the exception and its causes; each exception is yielded only once."""
    seen: set[int] = set()
    each: BaseException | None = error
    while each is not None and id(each) not in seen:
        seen.add(id(each))
        yield each
        each = each.__cause__ or each.__context__


def _of_text(text: str) -> Explanation | None:
    """Return the explanation of a build's output, or of the last known error in any other text."""
    if _BUILD.search(text) and (found := _of_build(text)):
        return found
    for message in _candidates(text):
        if found := known(message):
            return found
    return _of_build(text)


def _candidates(text: str) -> Iterator[str]:
    """Yield possible error messages.

    Possible messages are the error lines of each traceback, from the last traceback to the first, and then
    the whole text.
    """
    if _TRACEBACK in text:
        for part in reversed(text.split(_TRACEBACK)[1:]):
            yield from _below_frames(part)
    yield text


def _below_frames(part: str) -> Iterator[str]:
    """Yield the error lines of a traceback, such as `ValueError: boom`, from last to first."""
    for line in reversed(part.splitlines()[1:]):
        if re.match(r"[\w.]+(?:: |$)", line) and not line.startswith(("During", "The above")):
            yield line


def _of_build(text: str) -> Explanation | None:
    fault = explain_build(text)
    if fault is None:
        return None
    place = f"{fault.place}: " if fault.place else ""
    return Explanation(f"{place}{fault.problem}", fault.remedy, "04")
