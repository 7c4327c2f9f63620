"""Tests of points.json, which changes the points of the parts."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import pytest

from course_pkg.authoring.notebook_store import NotebookStore
from course_pkg.checking.credit import earned, with_fulfilled
from course_pkg.checking.parts import chapters, find, notebook_of, parts_of
from course_pkg.checking.report import Report, Verdict
from course_pkg.errors import GradingError
from course_pkg.grading.grade import Grade, Submission
from course_pkg.grading.marking import mark
from course_pkg.grading.plan import plan
from course_pkg.grading.points import read_points, write_points
from course_pkg.grading.run.changes import worth_changes
from course_pkg.sandbox.job import PartJob

MEASURED, REFUSED, NAMED = (goal.text for goal in find("05.3").goals)


def _read(folder: Path, text: str) -> Path:
    path = folder / "points.json"
    path.write_text(text)
    return path


def _graded(*fulfilled: str, verdict: Verdict = Verdict.FAILED) -> Grade:
    part = find("05.3")
    goals = with_fulfilled(part.goals, fulfilled)
    points = part.points if verdict is Verdict.PASSED else earned(goals)
    return Grade("s01", "05", (Report("05.3", verdict, part.goal, points, part.points, goals=goals),))


@pytest.mark.parametrize(
    ("table", "partly", "possible"),
    [
        ({}, 0.5, 2),
        ({"05.3": 8}, 2, 8),
        ({"05.3": 0}, 0, 0),
        ({"05.3": {MEASURED: 0.25, REFUSED: 1.5, NAMED: 2}}, 0.25, 3.75),
        ({"05.3": "all-or-nothing"}, 0, 2),
        ({"05.3": {"all-or-nothing": 4}}, 0, 4),
        ({"all parts": "all-or-nothing"}, 0, 2),
        ({"all parts": "all-or-nothing", "05.3": 4}, 1, 4),
    ],
)
def test_points_follow_the_table(
    tmp_path: Path, table: dict[str, object], partly: float, possible: float
) -> None:
    """A pass earns all points. If a part does not pass, each fulfilled goal earns its points."""
    points = read_points(_read(tmp_path, json.dumps(table)))
    assert points.weighed(_graded(MEASURED)).earned == partly
    passed = points.weighed(_graded(MEASURED, REFUSED, NAMED, verdict=Verdict.PASSED))
    assert passed.earned == passed.possible == possible
    assert points.weighed(_graded()).earned == 0


def test_the_outcomes_survive_another_table(tmp_path: Path) -> None:
    """If the points are changed and then restored, the grades are the same as before."""
    strict = read_points(_read(tmp_path, '{"all parts": "all-or-nothing"}'))
    before = _graded(MEASURED, REFUSED)
    changed = strict.weighed(before)
    assert read_points(None).weighed(changed) == before
    assert worth_changes([before], [changed])[1:] == [
        "  05.3: the points of this part are now divided differently among its goals"
    ]
    doubled = read_points(_read(tmp_path, '{"05.3": 4}')).weighed(before)
    assert worth_changes([before], [doubled])[1:] == ["  05.3: 2 before, 4 now"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"05.1": 2', "not valid JSON .line 1, column 11"),
        ('["05.1"]', "contains a list. Write an object"),
        ('{"05.33": 2}', "no part '05.33'. Did you mean '05.3'"),
        ('{"05.3": {"Fly.": 2}}', "'05.3' has no goal 'Fly.'. Its goals are"),
        (
            json.dumps({"05.3": {MEASURED: 1, REFUSED: 1}}),
            "'05.3' has no points for the goal 'Write the name",
        ),
        ('{"05.3": -1}', "'05.3' has -1 points. Write a number from 0"),
        ('{"05.3": NaN}', "'05.3' has nan points"),
        ('{"05.3": 1e999}', "'05.3' has inf points"),
        ('{"05.3": 0.333}', "at most two decimals, such as 0.33"),
        (json.dumps({"05.3": {MEASURED: 0, REFUSED: 0, NAMED: 0}}), "have 0 points in total"),
        ('{"05.3": "half"}', "a text ..half... Write a number"),
        ('{"05.3": [1]}', "is a list. Write a number"),
        ('{"05.3": true}', "is a truth value"),
        ('{"05.3": null}', "is a null value"),
        ('{"03.3": {"a": 1}}', "has only one goal. Write one number of points for this part, such as 2"),
        ('{"all parts": 2}', "can only be"),
        ('{"05.3": 1, "05.3": 2}', "'05.3' occurs more than once"),
    ],
)
def test_a_wrong_file_is_explained(tmp_path: Path, text: str, message: str) -> None:
    """If points.json is wrong, the error message contains the file, the position and advice."""
    with pytest.raises(GradingError, match=message) as raised:
        read_points(_read(tmp_path, text))
    assert str(tmp_path / "points.json") in str(raised.value)


def test_the_written_file_changes_nothing(tmp_path: Path) -> None:
    """`course points` writes the default points of all parts, and does not overwrite an existing file."""
    path = tmp_path / "points.json"
    write_points(path)
    assert read_points(path) == read_points(None)
    with pytest.raises(GradingError, match="already exists"):
        write_points(path)
    write_points(tmp_path / "05.json", ["05"])
    assert list(json.loads((tmp_path / "05.json").read_text())) == [part.check for part in parts_of("05")]
    with pytest.raises(GradingError, match="no chapter 99"):
        write_points(tmp_path / "99.json", ["99"])


@pytest.mark.parametrize("chapter", chapters())
def test_the_notebook_that_was_handed_out_earns_nothing(chapter: str) -> None:
    """An unchanged notebook earns no points."""

    def run(job: PartJob) -> NoReturn:
        raise AssertionError(job.check)

    path = NotebookStore().root / "notebooks" / notebook_of(chapter)
    submission = Submission("s01", chapter, path.read_bytes(), path.name)
    grade = mark(submission, plan(chapter), run, "secret", "key", sandboxed=True)
    assert {report.verdict for report in grade.reports} == {Verdict.NOT_ATTEMPTED}
    assert grade.earned == 0 < grade.possible
    weighed = read_points(None).weighed(grade)
    assert (weighed.earned, weighed.possible) == (0, grade.possible)
    assert replace(weighed, reports=()) == replace(grade, reports=())
