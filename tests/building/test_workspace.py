"""The student's workspace: where it lies, that it begins anew, and that nothing of theirs is lost."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

import course_pkg
from course_pkg.building import Workspace, my_workspace
from course_pkg.errors import SetupError
from tests.building.packages import BOX, GOOD, build, shell, write


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Workspace]:
    """A workspace in tmp_path; environment and search path are as before afterwards."""
    monkeypatch.setenv("COURSE_WORKSPACE", str(tmp_path / "ws"))
    for name in ("CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PKG_CONFIG_PATH", "PYTHONPATH", "ROS_PACKAGE_PATH"):
        monkeypatch.setenv(name, os.environ.get(name, ""))
    path = list(sys.path)
    yield my_workspace()
    sys.path[:] = path


def test_a_workspace_is_made_once_and_then_left_as_it_is(workspace: Workspace) -> None:
    """The set-up cell may be run at any time, in the middle of the work too."""
    (workspace.root / "src" / "mine.txt").write_text("mine")
    assert str(my_workspace()) == str(workspace) == os.fspath(workspace)
    assert (workspace.root / "src" / "mine.txt").read_text() == "mine"


def test_its_repr_is_the_same_on_every_machine(workspace: Workspace) -> None:
    """Notebooks store it, and nbval compares it."""
    assert repr(workspace) == "Workspace()"


def test_it_lies_in_the_home_folder_or_with_the_state(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Easy to find for a student; fresh for each notebook that is validated."""
    monkeypatch.delenv("COURSE_WORKSPACE", raising=False)
    monkeypatch.delenv("COURSE_STATE", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    assert my_workspace().root == tmp_path / "home" / "course_ws"
    monkeypatch.setenv("COURSE_STATE", str(tmp_path / "state"))
    assert my_workspace().root == tmp_path / "state" / "course_ws"


@pytest.mark.parametrize(
    ("folder", "words"),
    [
        ("{tmp}/my ws", "there is a blank in its name"),
        ("{checkout}/ws", "the course's own folder"),
        ("{tmp}/photos", "something else is in it"),
        ("/proc/ws", "cannot be made"),
    ],
)
def test_a_folder_that_does_not_do_is_refused(
    folder: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Before anything is written there, and with what to do instead."""
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "cat.jpg").write_text("")
    checkout = Path(course_pkg.__file__).parents[1]
    monkeypatch.setenv("COURSE_WORKSPACE", folder.format(tmp=tmp_path, checkout=checkout))
    with pytest.raises(SetupError, match=words) as error:
        my_workspace()
    assert "COURSE_WORKSPACE" in str(error.value)
    assert not (checkout / "ws").exists()


def test_starting_over_puts_aside_and_never_deletes(workspace: Workspace) -> None:
    """What a student wrote is kept, each version once; other packages are not touched."""
    workspace.start_over("my_services")
    (workspace.root / "src" / "other").mkdir()
    for text in (BOX, BOX, BOX + "bool round\n", BOX):
        write(workspace.root, {"srv/Box.srv": text})
        workspace.start_over("my_services")
        assert list((workspace.root / "src" / "my_services").iterdir()) == []
    kept = sorted((workspace.root / "earlier").iterdir())
    assert [path.name for path in kept] == ["my_services-1", "my_services-2"]
    assert [(path / "srv" / "Box.srv").read_text() for path in kept] == [BOX, BOX + "bool round\n"]
    assert (workspace.root / "src" / "other").exists()


def test_sourcing_is_what_a_shell_does(workspace: Workspace) -> None:
    """The kernel finds the types, and so do the programs that it starts; starting over takes it all back."""
    workspace.start_over("my_services")
    before, path = dict(os.environ), list(sys.path)
    with pytest.raises(SetupError, match="catkin_make"):
        workspace.source()
    write(workspace.root, GOOD)
    assert build(workspace.root)[0] == 0
    with pytest.raises(ModuleNotFoundError):
        import_module("my_services.srv")
    changed = workspace.source()
    assert {"CMAKE_PREFIX_PATH", "PYTHONPATH", "ROS_PACKAGE_PATH"} <= set(changed)
    assert workspace.source() == changed
    assert import_module("my_services.srv").Box._type == "my_services/Box"
    for name in changed:
        assert os.environ[name].startswith(str(workspace))
    workspace.start_over("my_services")
    for name in changed:  # a shell that sources may put what was there in another order
        assert set(os.environ[name].split(":")) == set(before[name].split(":"))
    assert sys.path == path
    with pytest.raises(ModuleNotFoundError):
        import_module("my_services.srv")


def test_sourcing_leaves_master_and_host_alone(workspace: Workspace, monkeypatch: pytest.MonkeyPatch) -> None:
    """setup.bash names a master where nobody has: then a notebook would not start one of its own."""
    monkeypatch.delenv("ROS_MASTER_URI", raising=False)
    workspace.start_over("my_services")
    write(workspace.root, GOOD)
    build(workspace.root)
    workspace.source()
    assert "ROS_MASTER_URI" not in os.environ


def test_the_workspace_overlays_the_course(workspace: Workspace) -> None:
    """In a terminal, too: after `source devel/setup.bash` both packages are found."""
    workspace.start_over("my_services")
    write(workspace.root, GOOD)
    build(workspace.root)
    found = shell(workspace.root, "rossrv md5 my_services/Box && rossrv md5 course_pkg/geometry").split()
    assert [len(word) for word in found] == [32, 32]
