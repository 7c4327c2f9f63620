"""Tests of reports that contain an instructor's points and comments."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path

from course_pkg.grading.grade import Grade
from course_pkg.grading.reports import read_grades, write_reports
from course_pkg.grading.reports.gradebook import needs_look
from course_pkg.grading.review.applying import about_reviews, answer_of, reviewed
from course_pkg.grading.review.overrides import Override, Overrides
from course_pkg.grading.run.changes import changes
from tests.grading.review.classes import class_of_four, graded

COMMENT = "A good <b>reason</b>."


def _overrides(*rows: Override) -> Overrides:
    return Overrides(Path("overrides.csv"), {row.key: row for row in rows})


def _reports(out: Path, grades: list[Grade]) -> None:
    write_reports(grades, out)


def test_every_report_has_the_points_and_the_comment(tmp_path: Path) -> None:
    """All reports show the reviewed points and the comment."""
    row = Override("s01", "05.1", 1.5, COMMENT)
    _reports(tmp_path, reviewed(class_of_four(), _overrides(row)))
    with (tmp_path / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
        (first,) = [row for row in csv.DictReader(file) if row["student"] == "s01"]
    assert (first["05.1"], first["earned"]) == ("1.5", "1.5")
    for name in ("canvas.csv", "moodle.csv", "gradescope.csv"):
        assert "1.5" in (tmp_path / name).read_text()
    results = json.loads((tmp_path / "gradescope/s01/results.json").read_text())
    assert results["score"] == 1.5
    shown = "A good &lt;b&gt;reason&lt;/b&gt;."
    texts = [
        results["tests"][0]["output"].replace("<", "&lt;").replace(">", "&gt;"),
        *((tmp_path / name).read_text() for name in ("moodle.csv", "feedback/s01.html", "class.html")),
    ]
    for text in texts:
        assert shown in text
        assert "The instructor changed the points from 0 to 1.5." in text


def test_a_review_can_be_applied_again_and_taken_back(tmp_path: Path) -> None:
    """A review can be applied twice, and the original points can be restored afterwards."""
    before = class_of_four()
    once = reviewed(before, _overrides(Override("s01", "05.1", 1.5, COMMENT)))
    _reports(tmp_path, once)
    stored = [grade.unreviewed() for grade in read_grades(tmp_path)]
    assert reviewed(stored, _overrides(Override("s01", "05.1", 1))) != stored
    again = reviewed(stored, _overrides())
    assert [each.reports for each in again if each.student == "s01"] == [before[0].reports]
    assert [(each.part, each.before, each.after) for each in changes(once, again)] == [("05.1", "1.5", "0")]


def test_a_changed_answer_is_reported() -> None:
    """If an answer has changed after the review, the reports contain a message."""
    row = Override("s01", "05.1", 2, "", answer_of(graded("s01"), "05.1"))
    same, other = graded("s01"), graded("s01", "a = 2")
    assert "changed" not in " ".join(about_reviews(reviewed([same], _overrides(row))))
    (changed,) = reviewed([other], _overrides(row))
    assert changed.reports[0].points == 2
    assert "has changed since its review: s01 05.1." in about_reviews([changed])[1]
    assert needs_look(changed)


def test_a_reviewed_part_needs_no_look() -> None:
    """A reviewed part needs no more work, even if the check of the part did not finish."""
    grade = graded("s01")
    assert needs_look(grade)
    assert not needs_look(reviewed([grade], _overrides(Override("s01", "05.2", 0)))[0])


def test_long_code_is_the_same_in_the_record(tmp_path: Path) -> None:
    """If an answer is long, answer_of() returns the same text before and after the grade is stored."""
    grade = replace(graded("s01"), code={"05.1": "line = 1\r\n" * 1500})
    _reports(tmp_path, [grade])
    assert answer_of(read_grades(tmp_path)[0], "05.1") == answer_of(grade, "05.1")
