"""Tests that a kernel finds the student's built packages."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

from course_pkg.errors import UnknownExecutable
from course_pkg.ros.process.executables import find_executable
from course_pkg.setup import Places
from course_pkg.workspace import OwnPackages, make_own_workspace, own_workspace
from tests.support import program, terminal
from tests.workspace.packages import BOX, GOOD, build, write

SEARCHED = ("CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PYTHONPATH", "ROS_PACKAGE_PATH")
SERVER = '#!/bin/sh\necho "of the student"\n'


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Return a workspace in tmp_path, and restore the environment and modules after the test."""
    monkeypatch.setenv("COURSE_STATE", str(tmp_path))
    for name in SEARCHED:
        monkeypatch.setenv(name, os.environ.get(name, ""))
    path, modules = list(sys.path), set(sys.modules)
    yield make_own_workspace()
    sys.path[:] = path
    for name in set(sys.modules) - modules:
        del sys.modules[name]


def package(root: Path, name: str, **files: str) -> None:
    """Write a package that contains only scripts, so it does not have to be built."""
    folder = root / "src" / name
    (folder / "scripts").mkdir(parents=True)
    (folder / "package.xml").write_text(
        f"<package format='2'><name>{name}</name><version>0.0.1</version></package>"
    )
    for script, text in files.items():
        (folder / "scripts" / script).write_text(text)
        (folder / "scripts" / script).chmod(0o755)


def test_workspace_is_next_to_the_notebooks(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The workspace is next to the notebooks in the checkout."""
    for name in ("COURSE_STATE", "COURSE_WORKSPACE"):
        monkeypatch.delenv(name, raising=False)
    checkout = Places.of().checkout
    assert own_workspace() == checkout / "workspace"
    assert "/workspace/" in (checkout / ".gitignore").read_text().splitlines()
    monkeypatch.setenv("COURSE_STATE", str(tmp_path))
    assert make_own_workspace() == own_workspace() == tmp_path / "workspace"
    assert [path.name for path in own_workspace().iterdir()] == ["src"]
    monkeypatch.setenv("COURSE_WORKSPACE", str(tmp_path / "ws"))
    assert own_workspace() == tmp_path / "ws"


def test_what_is_built_can_be_imported_and_a_changed_type_is_reported_once(root: Path) -> None:
    """A kernel imports a new type without a restart, and reports once that a built type has changed."""
    packages = OwnPackages(root)
    assert packages.refresh() == ""
    with pytest.raises(ModuleNotFoundError):
        import_module("my_services.srv")
    write(root, GOOD)
    assert build(root)[0] == 0
    assert packages.refresh() == ""
    assert import_module("my_services.srv").Box._type == "my_services/Box"
    assert terminal("rossrv", "md5", "my_services/Box").returncode == 0
    more = GOOD["CMakeLists.txt"].replace("Box.srv", "Box.srv Lid.srv")
    write(root, {"CMakeLists.txt": more, "srv/Lid.srv": "---\nbool open\n"})
    assert build(root)[0] == 0
    assert packages.refresh() == ""
    assert import_module("my_services.srv").Lid._type == "my_services/Lid"
    write(root, {"srv/Box.srv": f"{BOX}bool round\n"})
    assert build(root)[0] == 0
    message = packages.refresh()
    assert message.startswith("The definition of my_services/Box has changed")
    assert "Restart Kernel" in message
    assert "Lid" not in message
    assert packages.refresh() == ""


def test_kernel_finds_the_packages_after_join(root: Path) -> None:
    """After join(), a cell can import new types, and stderr contains a message about a changed type."""
    write(root, GOOD)
    change = f"open({str(root / 'src/my_services/srv/Box.srv')!r}, 'a').write('bool round\\n')"
    cells = [
        "from course_pkg import join\nnode = join('own')",
        f"!catkin_make -C {root} > {root}/log 2>&1",
        "from my_services.srv import Box\nBox._md5sum",
        f"{change}\n!catkin_make -C {root} > {root}/log 2>&1",
        "Box._md5sum",
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    environment = {**os.environ, "ROS_LOG_DIR": str(root)}
    environment.pop("ROS_MASTER_URI", None)
    NotebookClient(notebook, timeout=120, kernel_name="python3").execute(env=environment)
    outputs = [cell.outputs for cell in notebook.cells]
    assert [len(each) for each in outputs] == [0, 0, 1, 0, 2]
    assert outputs[4][0].name == "stderr"
    assert "The definition of my_services/Box has changed" in outputs[4][0].text
    assert outputs[4][1].data == outputs[2][0].data


def test_the_courses_programs_are_never_the_students(root: Path) -> None:
    """If a student's package is called course_pkg, rosrun never starts the programs of this package."""
    package(root, "course_pkg", client=SERVER, mine=SERVER)
    package(root, "lab_sheet", client=SERVER)
    OwnPackages(root).refresh()
    course = Places.of().workspace / "devel" / "lib" / "course_pkg" / "client"
    assert find_executable("course_pkg", "client") == course
    assert find_executable("lab_sheet", "client") == root / "src" / "lab_sheet" / "scripts" / "client"
    assert "of the student" not in program("client", "--help").stdout
    assert program("mine").returncode == 3  # rosrun's exit status 3 means that the program does not exist.
    assert terminal("rosrun", "lab_sheet", "client").stdout == "of the student\n"
    found = terminal("rospack", "find", "course_pkg").stdout.strip()
    assert found == str(Places.of().workspace / "src" / "course_pkg")


@pytest.mark.parametrize(
    "text", ["", "<package><name>my_arm</name>", "<package><version>1</version></package>"]
)
def test_a_broken_manifest_hides_one_package_and_no_other(root: Path, text: str) -> None:
    """If a package.xml is not valid XML, a kernel ignores only this package."""
    package(root, "my_arm", client=SERVER)
    package(root, "my_hand", client=SERVER)
    manifest = root / "src" / "my_arm" / "package.xml"
    whole = manifest.read_text()
    manifest.write_text(text)
    packages = OwnPackages(root)
    message = packages.refresh()
    assert message.startswith("src/my_arm/package.xml cannot be read (")
    assert "my_hand" not in message
    assert packages.refresh() == ""  # The kernel reports the unreadable package.xml only once.
    assert terminal("rosrun", "my_hand", "client").stdout == "of the student\n"
    assert terminal("rossrv", "md5", "course_pkg/geometry").returncode == 0
    assert find_executable("my_hand", "client").is_file()
    with pytest.raises(UnknownExecutable):
        find_executable("my_arm", "client")
    manifest.write_text(whole)
    assert packages.refresh() == ""
    assert terminal("rosrun", "my_arm", "client").stdout == "of the student\n"


def test_a_removed_package_is_not_found_any_more(root: Path) -> None:
    """After a file CATKIN_IGNORE is added to a package, a kernel does not find the package."""
    package(root, "my_arm", client=SERVER)
    packages = OwnPackages(root)
    packages.refresh()
    assert find_executable("my_arm", "client").is_file()
    (root / "src" / "my_arm" / "CATKIN_IGNORE").touch()
    packages.refresh()
    with pytest.raises(UnknownExecutable):
        find_executable("my_arm", "client")


def test_a_link_to_a_package_is_followed_and_a_loop_is_not(root: Path, tmp_path: Path) -> None:
    """The kernel follows a link to a package, but not a link to a parent folder."""
    package(tmp_path / "elsewhere", "my_arm", client=SERVER)
    (root / "src" / "linked").symlink_to(tmp_path / "elsewhere" / "src" / "my_arm")
    (root / "src" / "loop").symlink_to(root / "src")
    OwnPackages(root).refresh()
    assert find_executable("my_arm", "client").is_file()


def test_rosrun_searches_nothing_of_the_checkout_but_the_package() -> None:
    """The folder that rosrun searches contains the course's package, and no other part of the checkout."""
    checkout = Places.of().checkout
    shown = Places.of().workspace / "src" / "course_pkg"
    assert shown.is_dir()
    assert not shown.is_symlink()
    names = {path.name for path in shown.iterdir()}
    assert {"package.xml", "CMakeLists.txt", "srv", "launch"} <= names
    assert not names & {"workspace", "notebooks", "solutions", "tests", ".git"}
    assert (shown / "launch").resolve() == checkout / "launch"
