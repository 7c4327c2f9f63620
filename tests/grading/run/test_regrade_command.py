"""Tests of repeated runs of `course grade` with other options or submissions."""

from __future__ import annotations

import csv
import re
import shutil
import subprocess
from pathlib import Path
from types import SimpleNamespace

import pytest

from course_pkg.cli import COMMANDS, parse
from course_pkg.errors import CourseError
from course_pkg.grading.run.summary import GRADED, NEED_A_LOOK
from course_pkg.setup import Places
from tests.grading.submitted import hand_in

pytestmark = pytest.mark.usefixtures("sandbox")
COURSE = Places.of().checkout / "course"


def _grade(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    command = [COURSE, "grade", folder, "--out", folder / "grades", "--validate", "none", *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=100, check=False)


def _points(folder: Path) -> dict[str, str]:
    with (folder / "grades" / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
        return {row["student"]: row["earned"] for row in csv.DictReader(file)}


def test_a_class_over_several_runs(tmp_path: Path) -> None:
    """Each run prints the changes, and does not change the results that were not selected."""
    for student in ("s01", "s02", "s03"):
        hand_in(tmp_path, student, "00", {"00.1": ""})
    hand_in(tmp_path, "s01", "00")
    (tmp_path / "s04").mkdir()

    first = _grade(tmp_path, "--chapters", "0")
    assert first.returncode == NEED_A_LOOK, first.stderr
    assert first.stdout.splitlines()[-1] == "3 graded, 1 needs a look"
    assert "changed" not in first.stdout
    before = _points(tmp_path)
    assert list(before) == ["s01", "s02", "s03", "s04"]

    hand_in(tmp_path, "s02", "00")
    hand_in(tmp_path, "s03", "00")
    one = _grade(tmp_path, "--student", "S02", "--part", "0.1")
    assert one.returncode == GRADED, one.stderr
    assert one.stdout.splitlines()[0] == "Points that have changed since the last run:"
    assert one.stdout.splitlines()[1].startswith("  s02, 00.1: 0 before, ")
    assert one.stdout.splitlines()[-1] == "1 graded, 0 need a look"
    assert _points(tmp_path) == {**before, "s02": before["s01"]}

    shutil.rmtree(tmp_path / "s03")
    times = tmp_path / "grades" / "times.csv"
    times.write_text("student,submitted\ns01,2026-11-02T10:00Z\ns02,2026-11-01T10:00Z\n")
    due = ["--deadline", "2026-11-01T23:59+01:00", "--late-per-day", "50", "--times", str(times)]
    last = _grade(tmp_path, *due)
    assert last.returncode == NEED_A_LOOK, last.stderr
    assert f"s01, chapter 00: {before['s01']} before, {float(before['s01']) / 2:g} now" in last.stdout
    assert "nothing was handed in this time: s03 (chapter 00)" in last.stdout
    assert _points(tmp_path)["s03"] == before["s03"]
    assert "s03" not in (tmp_path / "grades" / "moodle.csv").read_text()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--deadline", "2026-11-01T23:59+01:00"], "--deadline needs a policy"),
        (
            ["--deadline", "2026-11-01T23:59+01:00", "--late-per-day", "10"],
            "--deadline needs the submission times",
        ),
        (["--time-zone", "Mars/Base"], "not a time zone"),
        (["--grace-minutes", "5"], "--grace-minutes needs a deadline"),
        (["--student", "nobody"], "--student nobody"),
        (["--part", "05.99"], "05.99"),
    ],
)
def test_an_option_that_makes_no_sense(tmp_path: Path, words: list[str], said: str) -> None:
    """If an option is wrong, the error message contains the option, and `course grade` grades nothing."""
    hand_in(tmp_path, "s01", "00")
    options = vars(parse(["grade", str(tmp_path), "--out", str(tmp_path / "grades"), *words]))
    with pytest.raises(CourseError, match=re.escape(said)):
        COMMANDS["grade"].run(SimpleNamespace(**options))


def test_a_private_part_without_an_exercise(tmp_path: Path) -> None:
    """If a file of private checks declares no part, the command refuses the file before grading."""
    hand_in(tmp_path / "in", "s01", "00")
    private = tmp_path / "private"
    private.mkdir()
    (private / "private_02.py").write_text("import math\n")
    done = _grade(tmp_path / "in", "--private", str(private))
    assert done.returncode == 1
    assert "declares no part" in done.stderr


def test_the_help_explains_the_exit_status(capsys: pytest.CaptureFixture[str]) -> None:
    """The help text lists each exit status."""
    with pytest.raises(SystemExit):
        parse(["grade", "--help"])
    shown = capsys.readouterr().out
    assert all(f"  {status}  " in shown for status in (0, 1, 2, 3, 130))


def test_the_number_of_a_chapter_may_have_one_digit() -> None:
    """--chapters 5 selects chapter 05."""
    assert parse(["grade", "here", "--chapters", "5, 06"]).chapters == ("05", "06")
