"""The cells that run before and after an answer if it is examined without its notebook.

`fixtures.py`, next to the checks of a chapter, contains them in percent format:

    # %% before          run first, for every part of the chapter: imports, joining the graph
    # %% 05.1 before     run next, for this part; a header can name several parts
    # %% 05.1 after      run after the answer: the rest of the exercise cell
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from course_pkg.checking.parts import folder_of
from course_pkg.errors import CheckError

HEADER = re.compile(r"# %% (?P<checks>(?:\d\d\.\d+ )*)(?P<place>before|after)\s*$")


@dataclass(frozen=True)
class Fixture:
    """The cells of one place ("before" or "after"); if `checks` is empty, they run for every part."""

    checks: frozenset[str]
    place: str
    source: str


def around(check: str) -> tuple[str, str]:
    """Return the source to run before and after an answer to the part `check`, such as "05.1".

    Raises CheckError if the chapter's fixtures.py contains an invalid header.
    """
    path = folder_of(check.partition(".")[0]) / "fixtures.py"
    found = list(read_fixtures(path)) if path.exists() else []
    return _joined(found, check, "before"), _joined(found, check, "after")


def read_fixtures(path: Path) -> Iterator[Fixture]:
    """Yield the cells of the file; the lines above the first header are its docstring.

    Raises CheckError for an invalid header.
    """
    for header, source, line in percent_cells(path.read_text("utf-8")):
        if not (found := HEADER.match(header)):
            raise CheckError(f"{path}, line {line}: {header!r} is not a header of a fixture")
        yield Fixture(frozenset(found["checks"].split()), found["place"], source)


def percent_cells(text: str) -> Iterator[tuple[str, str, int]]:
    """Yield the header, the source and the line number of each cell in percent format."""
    lines = text.splitlines()
    starts = [number for number, line in enumerate(lines) if line.startswith("# %%")]
    for start, end in zip(starts, [*starts[1:], len(lines)], strict=True):
        yield lines[start], "\n".join(lines[start + 1 : end]).strip("\n") + "\n", start + 1


def _joined(fixtures: list[Fixture], check: str, place: str) -> str:
    return "\n".join(
        each.source for each in fixtures if each.place == place and (not each.checks or check in each.checks)
    )
