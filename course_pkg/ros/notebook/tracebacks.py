"""Show a traceback in at most 12 lines: the message and the student's own code, without libraries."""

from __future__ import annotations

import re
import sysconfig
import textwrap
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from types import TracebackType

import course_pkg

LINES = 12  # A traceback has at most this number of lines.
WIDTH = 100  # A front end breaks a line that is longer than this number of characters.
MESSAGE_LINES = 6  # A message has at most this number of lines; two calls still fit.
MORE = " … (%tb shows the rest)"
# Folders with these names contain installed libraries, including the libraries of ROS.
INSTALLED = ("site-packages", "dist-packages")
HEADER = "Traceback (most recent call last; %tb shows all of it):"
HANDLER_HEADER = "Traceback of a handler or callback (most recent call last):"
MAGIC = re.compile(r"get_ipython\(\)\.run_line_magic\('(\w+)', '(.*)'\)")

# A function of this type returns the name that an error message shows for a file.
PlaceOf = Callable[[str], str]


def readable_traceback(error: BaseException, place_of: PlaceOf = str, header: str = HEADER) -> list[str]:
    """Return at most 12 lines about `error`: its message and the function calls in the student's own code."""
    before = [f"  {line}" for line in _before(error, place_of)]
    message = _message(error)
    calls = [_call(frame, place_of) for frame in students_frames(error.__traceback__)]
    if not calls:
        calls = [["  This error occurred outside of your code."]]
    room = LINES - 1 - len(before) - _rows(message)
    return [header, *before, *_shortened(calls, room), *message]


def students_frames(trace: TracebackType | None) -> Iterator[traceback.FrameSummary]:
    """Yield the frames in the student's code, the outermost frame first."""
    return (frame for frame in traceback.extract_tb(trace) if is_students(frame.filename))


def is_students(filename: str) -> bool:
    """Return whether a file contains the student's code."""
    if filename.startswith("<frozen"):
        return False
    path = Path(filename)
    ours = any(path.is_relative_to(folder) for folder in (*course_pkg.__path__, *_standard_library()))
    return not ours and not any(part in INSTALLED for part in path.parts)


def _standard_library() -> set[str]:
    paths = sysconfig.get_paths()
    return {paths["stdlib"], paths["platstdlib"]}


def _call(frame: traceback.FrameSummary, place_of: PlaceOf) -> list[str]:
    """Return two lines for a frame: its file and line number, and its line of code."""
    inside = "" if frame.name == "<module>" else f", in {frame.name}"
    code = MAGIC.sub(r"%\1 \2", frame.line or "")
    place = f"  {place_of(frame.filename)}, line {frame.lineno}{inside}"
    return [place, "    " + textwrap.shorten(code, WIDTH, placeholder=" …")] if code else [place]


def _shortened(calls: list[list[str]], room: int) -> list[str]:
    """Return the lines of all calls; if there are more than `room` lines, return only the first and last."""
    if sum(map(len, calls)) <= room:
        return [line for call in calls for line in call]
    last = max((room - 3) // 2, 1)
    gap = f"  … {len(calls) - 1 - last} more calls …"
    return [*calls[0], gap, *(line for call in calls[-last:] for line in call)]


def _before(error: BaseException, place_of: PlaceOf) -> list[str]:
    """Return a line about the exception that led to `error`, or [] if there is none."""
    former = error.__cause__ or (None if error.__suppress_context__ else error.__context__)
    frames = list(students_frames(former.__traceback__)) if former is not None else []
    if former is None or not frames:
        return []
    place = f"{place_of(frames[-1].filename)}, line {frames[-1].lineno}"
    text = textwrap.shorten(" ".join(_message(former)), WIDTH - len(place) - 25, placeholder=" …")
    return [f"({place}, had raised {text})"]


def _message(error: BaseException) -> list[str]:
    """Return the class and the message of an error, shortened to at most MESSAGE_LINES lines."""
    try:
        text = str(error)
    except Exception:  # noqa: BLE001 -- a student's __str__ may raise anything
        text = "<its message cannot be shown>"
    whole = f"{type(error).__name__}: {text}" if text else type(error).__name__
    kept: list[str] = []
    for line in whole.splitlines():
        room = (MESSAGE_LINES - _rows(kept)) * WIDTH
        if len(line) > room or not room:
            return [*kept, line[: room - len(MORE)] + MORE] if room else [*kept[:-1], kept[-1] + MORE]
        kept.append(line)
    return kept


def _rows(lines: list[str]) -> int:
    """Return the number of rows that a front end needs for these lines."""
    return sum(-(-len(line) // WIDTH) or 1 for line in lines)
