"""Tests of empty student folders, and of report folders among the submissions."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.intake.folders import require_other_folder
from course_pkg.grading.intake.submissions import submissions
from tests.grading.handing_in import NAMES, folder, handed_out, raw, zipped

NOTEBOOK = raw(handed_out())
FILE = NAMES["05"]


def _found(source: Path, without: Path | None = None) -> dict[str, str]:
    return {each.student: each.problem[:30] for each in submissions(source, without=without)}


def _with_folders(root: Path, files: dict[str, bytes], *names: str) -> Path:
    for name in names:
        (root / name).mkdir(parents=True)
    return folder(root, files)


def test_an_empty_folder_is_listed(tmp_path: Path) -> None:
    """If a student's folder contains no work, the program lists this student."""
    files = {f"s01/{FILE}": NOTEBOOK, "s02/.DS_Store": b"x"}
    found = _found(_with_folders(tmp_path, files, "s03", "s04/chapter 05/more"))
    assert found == {"s01": "", **dict.fromkeys(("s02", "s03", "s04"), "The student handed in nothing:")}


def test_a_folder_of_a_platform_is_no_student(tmp_path: Path) -> None:
    """If one folder contains all student folders, this outer folder is not a student's folder."""
    found = _found(_with_folders(tmp_path, {f"submitted/s01/ps1/{FILE}": NOTEBOOK}, "submitted/s02/ps1"))
    assert list(found) == ["s01", "s02"]


def test_the_folders_of_moodle(tmp_path: Path) -> None:
    """If only one of a student's two folders contains work, the program reports no problem."""
    files = {f"A One_17_assignsubmission_file_/{FILE}": NOTEBOOK}
    names = ["A One_17_assignsubmission_onlinetext_", "A Two_18_assignsubmission_file_"]
    assert [*_found(_with_folders(tmp_path, files, *names))] == ["A One_17", "A Two_18"]
    assert _found(tmp_path)["A One_17"] == ""


def test_a_zip(tmp_path: Path) -> None:
    """If the name of a zip member ends with a slash, this member is an empty folder."""
    path = zipped(tmp_path / "class.zip", {f"class/s01/{FILE}": NOTEBOOK, "class/s02/": b"", "../s03/": b""})
    assert list(_found(path)) == ["s01", "s02"]


def test_a_link_to_a_folder_is_not_followed(tmp_path: Path) -> None:
    """A folder that contains a link is not empty."""
    source = _with_folders(tmp_path / "in", {f"s01/{FILE}": NOTEBOOK})
    (tmp_path / "empty").mkdir()
    (source / "s02").symlink_to(tmp_path / "empty")
    assert not any("handed in nothing" in each.problem for each in submissions(source))


def test_the_reports_are_not_submissions(tmp_path: Path) -> None:
    """If the folder of `--out` is among the submissions, `course grade` ignores this folder."""
    source = _with_folders(tmp_path, {f"s01/{FILE}": NOTEBOOK, "grades/feedback/s01.html": b"x"}, "s02/out")
    assert list(_found(source, source / "grades")) == ["s01", "s02"]
    assert list(_found(source)) == ["grades", "s01", "s02"]
    assert list(_found(tmp_path, Path(tmp_path / "s01" / ".." / "grades"))) == ["s01", "s02"]


def test_the_reports_of_another_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`course grade` ignores a folder with reports of an earlier run, and a message contains its name."""
    reports = dict.fromkeys(("old/.grading/secret", "old/class.html", "old/grades.csv"), b"x")
    source = _with_folders(tmp_path, {f"s01/{FILE}": NOTEBOOK, **reports})
    assert list(_found(source, tmp_path / "new")) == ["s01"]
    assert capsys.readouterr().err.endswith("an earlier run: old\n")
    assert list(_found(source, source / "old")) == ["s01"]
    assert not capsys.readouterr().err


def test_reports_do_not_go_into_a_students_folder(tmp_path: Path) -> None:
    """A folder that contains submissions cannot be the folder for `--out`."""
    source = _with_folders(tmp_path, {f"s01/{FILE}": NOTEBOOK, "old/.grading/secret": b"x"}, "new")
    for wrong in (source, source / "s01"):
        with pytest.raises(GradingError, match=r"--out .* already contains files of the submissions"):
            require_other_folder(source, wrong)
    for right in (source / "old", source / "new", source / "none", tmp_path.parent):
        require_other_folder(source, right)
