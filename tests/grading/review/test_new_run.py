"""`course grade` applies overrides.csv in each run."""

from __future__ import annotations

import csv
import json
import subprocess
from pathlib import Path

import pytest

from course_pkg.setup import Places
from tests.grading.submitted import hand_in

pytestmark = pytest.mark.usefixtures("sandbox")
COURSE = Places.of().checkout / "course"
HEAD = "student,chapter,part,points,comment,answer\n"


def _grade(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    command = [COURSE, "grade", folder, "--out", folder / "grades", "--validate", "none", *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=100, check=False)


def _points(folder: Path) -> str:
    with (folder / "grades" / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
        return {row["student"]: row["00.1"] for row in csv.DictReader(file)}["s01"]


def test_points_survive_each_run(tmp_path: Path) -> None:
    """Each run uses the points and the comment in a row of overrides.csv until the row is removed."""
    hand_in(tmp_path, "s01", "00", {"00.1": ""})
    assert _grade(tmp_path).returncode in (0, 3)
    before = _points(tmp_path)
    assert before == "0"
    table = tmp_path / "grades" / "overrides.csv"
    table.write_text(f"{HEAD}s01,00,00.1,0.5,Well tried.,\n")
    second = _grade(tmp_path)
    assert "The grades of 1 of 1 notebooks come from an earlier run" in second.stderr
    assert "  s01, 00.1: 0 before, 0.5 now" in second.stdout
    assert "1 part has points or a comment from overrides.csv." in second.stdout
    assert "Well tried." in (tmp_path / "grades/feedback/s01.html").read_text()
    for words in ((), ("--part", "00.1"), ("--fresh",)):
        again = _grade(tmp_path, *words)
        assert "No points have changed since the last run." in again.stdout, again
        assert _points(tmp_path) == "0.5"
    record = json.loads((tmp_path / "grades/results/s01/00.json").read_text())
    assert record["reports"][0]["review"]["computed"] == 0
    table.write_text(f"{HEAD}s09,00,00.1,0.5,,\n")
    wrong = _grade(tmp_path)
    assert wrong.returncode == 1
    assert "overrides.csv, line 2: there is no submission of the student s09." in wrong.stderr
    assert _points(tmp_path) == "0.5"
    table.write_text(HEAD)
    assert "  s01, 00.1: 0.5 before, 0 now" in _grade(tmp_path).stdout
