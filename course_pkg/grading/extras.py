"""An instructor's private parts and points, in a separate folder that students never see.

private_05.py   further parts for exercises of chapter 05, declared like the chapter's own checks, with ids
                such as "05.1.1": they are examined after the student's cell of exercise 05.1
points.json     other points, by part: {"05.1": 4, "05.1.1": 2}; 0 leaves a part out of the sum
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from course_pkg.checking.parts import add_private, chapters, parts_of
from course_pkg.checking.report import Report
from course_pkg.errors import GradingError
from course_pkg.grading.run.private_folder import require_names, require_parts
from course_pkg.setup.stamps import digest


@dataclass(frozen=True)
class Extras:
    """The private folder, if there is one, and the points that it contains."""

    folder: Path | None = None
    points: Mapping[str, int] = field(default_factory=dict)

    @property
    def digest(self) -> str:
        """Return a digest of all files in the folder."""
        files = sorted(self.folder.glob("*.py")) if self.folder else []
        texts = [part for path in files for part in (path.name, path.read_bytes())]
        return digest([*texts, json.dumps(dict(self.points))])

    def weighed(self, report: Report) -> Report:
        """Return `report` with the points that the instructor gives to its part."""
        if report.check not in self.points:
            return report
        possible = self.points[report.check]
        return replace(report, points=possible if report.points else 0, possible=possible)


def read_extras(folder: Path | None) -> Extras:
    """Read `folder` and declare the parts in it; raise GradingError if its contents are not valid."""
    if folder is None:
        return Extras()
    if not folder.is_dir():
        raise GradingError(
            f"{folder} is not a folder: give the folder that contains private_NN.py and points.json."
        )
    folder = folder.resolve()
    require_names(folder, chapters())
    add_private(str(folder))
    try:
        known = {part.check for chapter in chapters() for part in parts_of(chapter)}
    except Exception as error:
        raise GradingError(
            f"The private parts in {folder} cannot be read: {type(error).__name__}: {error}"
        ) from error
    require_parts(folder)
    return Extras(folder, _points(folder / "points.json", known))


def _points(path: Path, known: set[str]) -> dict[str, int]:
    if not path.exists():
        return {}
    try:
        points = json.loads(path.read_text("utf-8"))
        assert all(type(value) is int and value >= 0 for value in points.values())
    except (ValueError, AttributeError, AssertionError) as error:
        raise GradingError(
            f'{path} is not a table of points: it should be like {{"05.1": 4}}, a whole number for each part.'
        ) from error
    if unknown := sorted(set(points) - known):
        raise GradingError(f"{path} gives points to {', '.join(unknown)}, but there is no such part.")
    return {str(check): int(value) for check, value in points.items()}
