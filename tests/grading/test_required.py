"""`course grade` does not start if a needed solution is missing."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.command import Options, grade, grade_one
from course_pkg.grading.required import require_references
from course_pkg.setup import Places

CHECKOUT = Places.of().checkout


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """Copy the solutions and fixtures into a new checkout."""
    for path in [*CHECKOUT.glob("solutions/*.ipynb"), *CHECKOUT.glob("course_pkg/chapters/*/fixtures.py")]:
        copy = tmp_path / path.relative_to(CHECKOUT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, copy)
    return tmp_path


def test_everything_is_there(checkout: Path) -> None:
    """If all files exist, grading can start."""
    require_references(root=checkout)


@pytest.mark.parametrize(
    "missing", ["solutions/05_write_a_server.ipynb", "course_pkg/chapters/ch05_write_a_server/fixtures.py"]
)
def test_a_missing_file_is_named(checkout: Path, missing: str) -> None:
    """If a file is missing, the error message contains its path, and other chapters can be graded."""
    (checkout / missing).unlink()
    with pytest.raises(GradingError, match=f"Nothing was graded.*missing: {missing}\\. .*--chapters"):
        require_references(root=checkout)
    with pytest.raises(GradingError, match=missing):
        require_references(["05"], checkout)
    require_references(["06"], checkout)


def test_many_missing_files_are_one_message(tmp_path: Path) -> None:
    """If many solutions are missing, the error message lists three files and counts the other files."""
    with pytest.raises(GradingError, match=r"00_start_the_graph\.ipynb.* and 31 more\. "):
        require_references(root=tmp_path)


def test_no_submission_is_read_without_solutions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without solutions, `course grade` and `course grade-one` raise an error and write no grades."""
    monkeypatch.setattr("course_pkg.__file__", str(tmp_path / "course_pkg" / "__init__.py"))
    with pytest.raises(GradingError, match="Nothing was graded"):
        grade(Options(tmp_path, tmp_path / "out"))
    with pytest.raises(GradingError, match="Nothing was graded"):
        grade_one(tmp_path / "05.ipynb", tmp_path / "out")
    assert not (tmp_path / "out").exists()
