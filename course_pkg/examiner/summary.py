"""`results("05")`: what the records say about a chapter so far."""

from __future__ import annotations

import json
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from course_pkg.examiner.parts import parts_of
from course_pkg.state import state_folder


@dataclass(frozen=True)
class Line:
    """One part of a chapter, and how its last check ended."""

    check: str
    goal: str
    verdict: str
    points: int
    possible: int


@dataclass(frozen=True)
class Summary:
    """The parts of a chapter, with the points so far."""

    chapter: str
    lines: tuple[Line, ...]

    def __str__(self) -> str:
        earned, possible = sum(line.points for line in self.lines), sum(line.possible for line in self.lines)
        head = f"Chapter {self.chapter}: {earned} of {possible} points"
        rows = [
            f"  {line.check:<6}{line.verdict:<17}{line.points}/{line.possible}  {line.goal}"
            for line in self.lines
        ]
        return "\n".join([head, *rows])

    __repr__ = __str__

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        cells = "".join(
            f"<tr><td>{line.check}</td><td>{escape(line.verdict)}</td>"
            f"<td>{line.points} of {line.possible}</td>"
            f"<td style='text-align:left'>{escape(line.goal)}</td></tr>"
            for line in self.lines
        )
        head = f"<caption>{escape(str(self).splitlines()[0])}</caption>"
        names = "".join(f'<th scope="col">{name}</th>' for name in ("Part", "So far", "Points", "Goal"))
        table = f"<table>{head}<thead><tr>{names}</tr></thead><tbody>{cells}</tbody></table>"
        return {"text/plain": str(self), "text/html": table}


def results(chapter: str, folder: Path | None = None) -> Summary:
    """Return how the checks of a chapter, such as "05", ended when they were last run."""
    folder = folder or state_folder() / "results"
    lines = []
    for part in parts_of(str(chapter)):
        kept = read_record(folder / f"{part.check}.json") or {}
        verdict, points = str(kept.get("verdict", "not checked yet")), int(kept.get("points", 0))
        lines.append(Line(part.check, part.goal, verdict, points, part.points))
    return Summary(str(chapter), tuple(lines))


def read_record(path: Path) -> dict[str, Any] | None:
    """Return the record at `path`, or None when there is none that can be read."""
    try:
        data = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError):
        return None
    return data if isinstance(data, dict) else None
