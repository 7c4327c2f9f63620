"""Tests of `course grade` after the review of a large class."""

from __future__ import annotations

import csv
import json
import random
from pathlib import Path

import pytest

from course_pkg.grading.reports import read_grades
from tests.grading.review.classes import TOKEN, serving
from tests.grading.review.test_new_run import _grade
from tests.grading.submitted import hand_in
from tests.web_pages.servers import ask

pytestmark = [pytest.mark.usefixtures("sandbox"), pytest.mark.slow, pytest.mark.timeout(900)]
STUDENTS = 300
BLANK = dict.fromkeys(["00.1", "00.2", "00.3"], "")


def test_three_hundred_reviewed_submissions(tmp_path: Path) -> None:
    """All points and comments of a review are in the reports of each later run."""
    numbers = random.Random(1)  # noqa: S311 -- not a secret
    names = [f"s{number:03}" for number in range(STUDENTS)]
    for name in names:
        hand_in(tmp_path, name, "00", BLANK)
    out = tmp_path / "grades"
    assert _grade(tmp_path).returncode in (0, 3)
    expected = {}
    with serving(out) as url:
        own = {"Authorization": f"token {TOKEN}"}
        for number, item in enumerate(json.loads(ask(f"{url}/items", **own)[1])["items"]):
            points = numbers.randint(0, 100 * item["possible"]) / 100
            comment = f"Comment {number}, für {item['name']}: {'x' * numbers.randint(1, 400)}"
            sent = {"number": number, "points": str(points), "comment": comment}
            assert ask(f"{url}/save", sent, **own)[0] == 200
            expected[item["name"], item["part"]] = points, comment
    assert len(expected) == 3 * STUDENTS
    for words in ((), ("--fresh",)):
        done = _grade(tmp_path, *words)
        assert done.returncode in (0, 3), done.stderr
        assert f"{3 * STUDENTS} parts have points or a comment from overrides.csv." in done.stdout
        found = {
            (grade.student, report.check): (report.points, report.review.comment if report.review else "")
            for grade in read_grades(out)
            for report in grade.reports
        }
        assert found == expected
        with (out / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
            for row in csv.DictReader(file):
                assert float(row["00.1"]) == expected[row["student"], "00.1"][0]
        for name in names:
            page = (out / "feedback" / f"{name}.html").read_text("utf-8")
            assert all(expected[name, part][1] in page for part in BLANK)
