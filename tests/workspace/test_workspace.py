"""Tests of the student's workspace."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import SetupError
from course_pkg.workspace import make_own_workspace
from tests.workspace.packages import GOOD, build, shell, write


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a new workspace in tmp_path."""
    monkeypatch.setenv("COURSE_WORKSPACE", str(tmp_path / "ws"))
    return make_own_workspace()


def test_a_workspace_is_made_once_and_then_left_as_it_is(root: Path) -> None:
    """Creating the workspace again does not change the student's files."""
    (root / "src" / "mine.txt").write_text("mine")
    assert make_own_workspace() == root
    assert (root / "src" / "mine.txt").read_text() == "mine"


@pytest.mark.parametrize(
    ("folder", "words"),
    [
        ("{tmp}/my ws", "the path contains a space"),
        ("{tmp}/photos", "no folder src"),
        ("/proc/ws", "cannot be created"),
    ],
)
def test_unsuitable_folder_is_refused(
    folder: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The function refuses an unsuitable folder, and the error message suggests another folder."""
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "cat.jpg").write_text("")
    place = folder.format(tmp=tmp_path)
    monkeypatch.setenv("COURSE_WORKSPACE", place)
    with pytest.raises(SetupError, match=words) as error:
        make_own_workspace()
    assert str(error.value).startswith(f"{place} cannot be your catkin workspace: ")
    assert "Move the course" in str(error.value)
    assert not Path(place, "src").exists()


def test_the_workspace_overlays_the_course(root: Path) -> None:
    """After `source devel/setup.bash`, rossrv finds the student's types and the course's types."""
    write(root, GOOD)
    build(root)
    found = shell(root, "rossrv md5 my_services/Box && rossrv md5 course_pkg/geometry").split()
    assert [len(word) for word in found] == [32, 32]
