"""points.json: how an instructor divides the points among the parts and their goals.

The entry "05.1":4 gives 4 points to the part 05.1; these points are divided among the goals in the author's
ratio. The entry "05.3":{"GOAL A":0.5,"GOAL B":1.5} sets the points of each goal; a number has at most two
decimals. The entry "05.4":"all-or-nothing" means that only a pass earns points. The entry
"05.5":{"all-or-nothing":4} also means that only a pass earns points, and sets 4 points. The entry "all
parts":"all-or-nothing" is the default for all parts that the file does not contain.

A stored result contains the goals that were reached. Therefore, points can be computed again without running
a check.
"""

from __future__ import annotations

import difflib
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from course_pkg.checking.credit import Goal, divided, earned, total, with_fulfilled
from course_pkg.checking.parts import Part, chapters, parts_of
from course_pkg.checking.report import Report, Verdict
from course_pkg.errors import GradingError
from course_pkg.files import write_atomically
from course_pkg.grading.grade import Grade

ALL_OR_NOTHING, EVERY = "all-or-nothing", "all parts"
START = "`./course points FILE` writes a file that you can change."


@dataclass(frozen=True)
class Worth:
    """The points of a part and of its goals. If no goal has points, only a pass earns the points."""

    possible: float
    goals: tuple[Goal, ...]


@dataclass(frozen=True)
class PointsTable:
    """The points of each part; the keys are the ids of the parts.

    If an instructor has not set the points of a part, the author's points are used.
    """

    parts: Mapping[str, Worth] = field(default_factory=dict)

    def weighed(self, grade: Grade) -> Grade:
        """Return the grade with the points of this table; parts that are not in the table do not change."""
        return replace(grade, reports=tuple(map(self._weighed, grade.reports)))

    def _weighed(self, report: Report) -> Report:
        worth = self.parts.get(report.check)
        if worth is None:
            return report
        passed = report.verdict is Verdict.PASSED
        known = worth.goals if passed else tuple(goal for goal in report.goals if goal.fulfilled)
        goals = with_fulfilled(worth.goals, (goal.text for goal in known))
        points = worth.possible if passed else earned(goals)
        return replace(report, points=points, possible=worth.possible, goals=goals)


def read_points(path: Path | None) -> PointsTable:
    """Return the points of all parts; points in the file at the path `path` replace the author's points.

    Call read_extras() before this function if there are private parts. Raises GradingError if the file is not
    valid; the message contains the position in the file and a correction.
    """
    known = {part.check: part for chapter in chapters() for part in parts_of(chapter)}
    given = _read(path) if path else {}
    if unknown := sorted(given.keys() - known.keys() - {EVERY}):
        near = difflib.get_close_matches(unknown[0], known, n=1)
        like = f" Did you mean {near[0]!r}?" if near else ""
        raise _wrong(path, f"there is no part {unknown[0]!r}.{like} {START}")
    if EVERY in given and given[EVERY] != ALL_OR_NOTHING:
        raise _wrong(
            path,
            (
                f'the value of {EVERY!r} can only be "{ALL_OR_NOTHING}". To change the points, write a '
                "number for each part."
            ),
        )
    worth = {
        check: _worth(part, given[check], path)
        if check in given
        else _all_or_nothing(part, part.points)
        if EVERY in given
        else Worth(part.points, part.goals)
        for check, part in known.items()
    }
    return PointsTable(worth)


def write_points(path: Path, asked: Sequence[str] = ()) -> None:
    """Write a new file with the author's points for the chapters `asked`, or for all chapters.

    Raises GradingError if the file exists or cannot be written, or if there is no such chapter.
    """
    if unknown := sorted(set(asked) - set(chapters())):
        raise GradingError(f"There is no chapter {unknown[0]}. The chapters are {', '.join(chapters())}.")
    if path.exists():
        raise GradingError(f"{path} already exists. Give another file, or delete the old file first.")
    table = {
        part.check: {goal.text: goal.points for goal in part.goals} or part.points
        for chapter in asked or chapters()
        for part in parts_of(chapter)
    }
    try:
        write_atomically(path, json.dumps(table, indent=1, ensure_ascii=False) + "\n")
    except OSError as error:
        raise GradingError(
            f"{path} cannot be written ({error.strerror or error}). Give another file."
        ) from error


def _read(path: Path) -> dict[str, Any]:
    try:
        data = json.loads(path.read_text("utf-8-sig"), object_pairs_hook=_without_doubles)
    except OSError as error:
        raise _wrong(
            path, f"the file cannot be read ({error.strerror or error}). Correct the path."
        ) from error
    except json.JSONDecodeError as error:
        place = f"line {error.lineno}, column {error.colno}: {error.msg}"
        raise _wrong(path, f"the file is not valid JSON ({place}). Correct this place. {START}") from error
    except (ValueError, RecursionError) as error:
        raise _wrong(path, f"the file cannot be read ({error}). {START}") from error
    if not isinstance(data, dict):
        raise _wrong(
            path, f'the file contains a {_kind(data)}. Write an object, such as {{"05.1": 4}}. {START}'
        )
    return data


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    names = [name for name, _ in pairs]
    if doubles := [name for name in names if names.count(name) > 1]:
        raise ValueError(f"{doubles[0]!r} occurs more than once; keep only one of these entries")
    return dict(pairs)


def _worth(part: Part, given: Any, path: Path | None) -> Worth:  # noqa: ANN401 -- any JSON value
    """Convert the value `given` of a part in the file into the points of the part and of its goals."""
    if given == ALL_OR_NOTHING:
        return _all_or_nothing(part, part.points)
    if isinstance(given, dict):
        return _by_goal(part, given, path)
    points = _points(given, f"{part.check!r}", path)
    shares = divided(points, [goal.points for goal in part.goals]) if part.goals else []
    return Worth(points, _with_points(part, shares))


def _by_goal(part: Part, given: dict[str, Any], path: Path | None) -> Worth:
    if list(given) == [ALL_OR_NOTHING]:
        return _all_or_nothing(part, _points(given[ALL_OR_NOTHING], f"{part.check!r}", path))
    texts = [goal.text for goal in part.goals]
    listed = ", ".join(map(repr, texts))
    if not texts:
        raise _wrong(
            path,
            (
                f"{part.check!r} has only one goal. Write one number of points for this part, such as "
                f"{part.points}."
            ),
        )
    if unknown := [text for text in given if text not in texts]:
        raise _wrong(path, f"{part.check!r} has no goal {unknown[0]!r}. Its goals are {listed}.")
    if missing := [text for text in texts if text not in given]:
        raise _wrong(
            path,
            (
                f"{part.check!r} has no points for the goal {missing[0]!r}. Add this goal, with 0 or more "
                "points."
            ),
        )
    shares = [_points(given[text], f"the goal {text!r} of {part.check!r}", path) for text in texts]
    goals = _with_points(part, shares)
    if not total(goals):
        raise _wrong(
            path,
            f"the goals of {part.check!r} have 0 points in total. Give points to one of these goals, or "
            f'write "{part.check}": 0 to leave the part out of the sum.',
        )
    return Worth(total(goals), goals)


def _all_or_nothing(part: Part, points: float) -> Worth:
    return Worth(points, _with_points(part, [0] * len(part.goals)))


def _with_points(part: Part, shares: Sequence[float]) -> tuple[Goal, ...]:
    return tuple(replace(goal, points=share) for goal, share in zip(part.goals, shares, strict=True))


def _points(value: Any, where: str, path: Path | None) -> float:  # noqa: ANN401 -- any JSON value
    """Return the value as a number of points.

    Raises GradingError if the value is not valid. The error message contains `where`, the place of the value
    in the file.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        form = f'"{ALL_OR_NOTHING}", or an object with the points of each goal'
        raise _wrong(path, f"the value of {where} is a {_kind(value)}. Write a number, {form}.")
    if not math.isfinite(value) or not 0 <= value <= 1_000_000:
        raise _wrong(path, f"{where} has {value} points. Write a number from 0 to 1000000.")
    if abs(round(value, 2) - value) > 1e-9:
        raise _wrong(path, f"{where} has {value} points. Write at most two decimals, such as {value:.2f}.")
    return round(value, 2)


def _kind(value: object) -> str:
    """Return the name of the type of a JSON value."""
    names = {dict: "object", list: "list", str: f"text ({str(value)[:40]!r})", bool: "truth value"}
    return names.get(type(value), "number" if isinstance(value, (int, float)) else "null value")


def _wrong(path: Path | None, text: str) -> GradingError:
    return GradingError(f"{path}: {text}")
