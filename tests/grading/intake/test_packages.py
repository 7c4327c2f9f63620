"""Tests of packages in submissions."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

from course_pkg.grading.grade import Package, Submission
from course_pkg.grading.intake import packages
from course_pkg.grading.intake.packages import NO_NOTEBOOK
from course_pkg.grading.intake.submissions import submission_of, submissions
from tests.grading.handing_in import folder, handed_out, raw, zipped
from tests.grading.packages import SERVER, my_geometry, write_package

SEVEN = "07_build_a_package.ipynb"


@pytest.fixture(scope="module")
def seven() -> bytes:
    """Return the students' notebook of chapter 07."""
    return raw(handed_out("07"))


def _only(root: Path, *chapters: str) -> Submission:
    [found] = submissions(root, chapters)
    return found


def _package(submission: Submission) -> Package:
    [found] = submission.packages
    return found


def test_package_next_to_a_notebook(tmp_path: Path, seven: bytes) -> None:
    """A notebook and a package in the same folder are one submission."""
    folder(tmp_path, {f"s01/{SEVEN}": seven})
    write_package(tmp_path, "s01/my_geometry", my_geometry())
    found = _only(tmp_path)
    assert (found.student, found.chapter, found.problem, found.notes) == ("s01", "07", "", ())
    package = _package(found)
    assert (package.name, package.origin) == ("my_geometry", "s01/my_geometry")
    assert {file.path: file.data for file in package.files} == my_geometry()
    assert {file.path for file in package.files if file.executable} == {SERVER, "scripts/client.py"}


def test_a_package_and_no_notebook(tmp_path: Path) -> None:
    """A package without a notebook becomes a submission for each chapter that needs the package."""
    write_package(tmp_path, "s01/my_geometry", my_geometry())
    found = _only(tmp_path)
    assert (found.student, found.chapter, found.content) == ("s01", "07", b"")
    assert found.problem == NO_NOTEBOOK
    assert _package(found).has([SERVER])
    assert submissions(tmp_path, ["05"]) == []
    empty = write_package(tmp_path / "b", "s01/my_geometry", {"package.xml": b"<name>my_geometry</name>"})
    assert _only(empty.parent.parent).chapter == "07"


def test_notebook_without_a_package(tmp_path: Path, seven: bytes) -> None:
    """Without a package, the answers come from the cells of the notebook."""
    assert _only(folder(tmp_path, {f"s01/{SEVEN}": seven})).packages == ()


@pytest.mark.parametrize("place", ["workspace/src/my_geometry", "my_geometry-main", "07/my_geometry (2)"])
def test_a_package_is_known_by_its_name(tmp_path: Path, place: str) -> None:
    """The search finds a package in a workspace, and in a folder with another name."""
    write_package(tmp_path, f"s01/{place}", my_geometry())
    found = _only(tmp_path)
    assert (_package(found).name, found.notes) == ("my_geometry", ())


def test_folders_of_catkin_are_ignored(tmp_path: Path) -> None:
    """The folders that catkin_make writes are not packages."""
    write_package(tmp_path, "s01/workspace/src/my_geometry", my_geometry())
    for place in ("build/my_geometry/x.make", "devel/setup.bash", "install/share/my_geometry/package.xml"):
        folder(tmp_path, {f"s01/workspace/{place}": b"<name>my_geometry</name>"})
    assert _package(_only(tmp_path)).origin == "s01/workspace/src/my_geometry"


def test_a_name_that_differs_from_the_folder(tmp_path: Path) -> None:
    """If no part needs a package with the name in package.xml, the folder's name is the package name."""
    manifest = my_geometry()["package.xml"].decode().replace("<name>my_geometry<", "<name>my_geometri<")
    write_package(tmp_path, "s01/my_geometry", my_geometry({"package.xml": manifest}))
    found = _only(tmp_path)
    assert _package(found).name == "my_geometry"
    assert "contains the package name my_geometri" in found.notes[0]


def test_package_that_no_part_needs(tmp_path: Path) -> None:
    """If no part needs the package, the error message lists the packages that the parts need."""
    write_package(tmp_path, "s01/robot", {"package.xml": b"<package><name>robot</name></package>"})
    found = _only(tmp_path)
    assert (found.chapter, found.packages) == ("", ())
    assert "robot" in found.problem
    assert "my_geometry" in found.problem


def test_newest_of_two_packages_with_one_name_is_used(tmp_path: Path) -> None:
    """If two packages have the same name, the program uses the newer one, and the submission gets a note."""
    write_package(tmp_path, "s01/a", my_geometry())
    for path in write_package(tmp_path, "s01/b", my_geometry()).rglob("*"):
        os.utime(path, (1, 1))
    found = _only(tmp_path)
    assert _package(found).origin == "s01/a"
    assert "s01/b" in found.notes[0]


def test_links_and_devices_are_left_out(tmp_path: Path) -> None:
    """The program ignores links and devices in a package."""
    secret = folder(tmp_path / "secret", {"file": b"secret", "folder/file": b"secret"})
    root = tmp_path / "in"
    package = write_package(root, "s01/my_geometry", my_geometry())
    (package / "link").symlink_to(secret / "file")
    (package / "linked").symlink_to(secret / "folder")
    os.mkfifo(package / "pipe")
    found = _only(root)
    assert {file.path for file in _package(found).files} == set(my_geometry())
    assert [note.partition(" ")[0] for note in found.notes] == [
        f"my_geometry/{name}" for name in ("link", "linked", "pipe")
    ]


def test_a_package_xml_that_is_a_link(tmp_path: Path) -> None:
    """If package.xml is a link, the program does not examine the package, and the error names the link."""
    package = write_package(tmp_path, "s01/my_geometry", my_geometry())
    (package / "package.xml").unlink()
    (package / "package.xml").symlink_to("/etc/passwd")
    found = _only(tmp_path)
    assert found.packages == ()
    assert "link" in " ".join(found.notes)


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({"bag": b"x" * (packages.LARGEST + 1)}, "more than 2 MiB"),
        ({f"data/{n}": b"" for n in range(packages.FILES)}, "more than 300 files"),
    ],
    ids=["bytes", "files"],
)
def test_a_huge_package(tmp_path: Path, seven: bytes, files: dict[str, bytes], words: str) -> None:
    """The program skips a package that is too large, but examines the notebook in the same folder."""
    folder(tmp_path, {f"s01/{SEVEN}": seven, f"s02/{SEVEN}": seven})
    write_package(tmp_path, "s01/my_geometry", my_geometry() | files)
    huge, other = submissions(tmp_path)
    assert (huge.packages, huge.problem) == ((), "")
    assert words in huge.notes[0]
    assert other.notes == ()


def test_permissions_that_were_lost(tmp_path: Path) -> None:
    """If no file in the package is executable, each file with a shebang counts as executable."""
    files = {f"s01/my_geometry/{path}": content for path, content in my_geometry().items()}
    executable = {SERVER, "scripts/client.py"}
    for source in (folder(tmp_path / "a", files), zipped(tmp_path / "a.zip", files)):
        found = _package(_only(source))
        assert {file.path for file in found.files if file.executable} == executable
    (tmp_path / "a" / "s01" / "my_geometry" / SERVER).chmod(0o755)
    assert {file.path for file in _package(_only(tmp_path / "a")).files if file.executable} == {SERVER}


def test_packages_in_a_zip(tmp_path: Path, seven: bytes) -> None:
    """A zip can contain packages of several students; the program ignores paths that lead out of the zip."""
    one = {f"s01/my_geometry/{path}": content for path, content in my_geometry().items()}
    second = {"s01/service_example/package.xml": b"<name>service_example</name>"}
    source = zipped(tmp_path / "a.zip", {f"s01/{SEVEN}": seven, **one, **second})
    assert [each.name for each in _only(source).packages] == ["my_geometry", "service_example"]
    out = {"s02/my_geometry/../../s01/my_geometry/README.md": b"forged"}
    found = {each.student: each for each in submissions(zipped(tmp_path / "b.zip", {**one, **out}))}
    assert _package(found["s01"]).has(my_geometry())
    assert b"forged" not in [file.data for file in _package(found["s01"]).files]
    link = (stat.S_IFLNK | 0o777) << 16
    [linked] = submissions(zipped(tmp_path / "c.zip", one, external_attr=link))
    assert linked.packages == ()


def test_grade_one_uses_the_package_next_to_the_notebook(tmp_path: Path, seven: bytes) -> None:
    """`course grade-one` uses the packages in the notebook's folder."""
    folder(tmp_path, {f"s01/{SEVEN}": seven})
    write_package(tmp_path, "s01/my_geometry", my_geometry())
    assert _package(submission_of(tmp_path / "s01" / SEVEN)).has([SERVER])


def test_a_package_without_a_folder_of_its_own(tmp_path: Path) -> None:
    """If package.xml is in the student's folder, the error message says where package.xml has to be."""
    folder(tmp_path, {"s01/package.xml": b"<name>my_geometry</name>"})
    assert "STUDENT/PACKAGE/package.xml" in _only(tmp_path).problem
