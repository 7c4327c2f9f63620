"""Tests of the folder, the repository and the zip of a student edition."""

from __future__ import annotations

import json
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest

from course_pkg.checking.packed import pack
from course_pkg.errors import HandoutError, SetupError
from course_pkg.handout.edition.contents import File, edition_files, is_released
from course_pkg.handout.edition.folder import Release, ReleaseFolder, refuse_inside
from course_pkg.handout.edition.zipped import write_zip, zip_path
from course_pkg.handout.release import pull_link
from course_pkg.handout.selection import chosen_chapters
from course_pkg.setup.edition import RECORD, released_chapters, require_solutions
from tests.handout.releases import ROOT, git

HUB, REPOSITORY = "https://hub.example.edu/", "https://git.example.edu/ros/course.git"


def files(**texts: str) -> dict[str, File]:
    """Return the files of a small edition that contains a program called `course`."""
    found = {name: File(text.encode()) for name, text in texts.items()}
    found["course"] = File(b"#!/bin/sh\n", executable=True)
    record = {"chapters": ["05"], "files": [*found, RECORD]}
    return {**found, RECORD: File(json.dumps(record).encode())}


def write(folder: Path, **texts: str) -> Release:
    """Release a small edition."""
    return ReleaseFolder(folder).write(files(**texts), "Release")


def test_a_second_release_makes_a_commit_only_if_something_changed(tmp_path: Path) -> None:
    """A second release makes a commit only if a file has changed or was removed."""
    folder = tmp_path / "out"
    assert write(folder, a="1", b="1").commit
    assert write(folder, a="1", b="1") == Release("", 0)
    assert write(folder, a="2").commit == git(folder, "rev-parse", "--short", "HEAD")
    assert git(folder, "rev-list", "--count", "HEAD") == "2"
    assert sorted(path.name for path in folder.iterdir()) == [RECORD, ".git", "a", "course"]
    assert git(folder, "ls-files", "-s", "course").startswith("100755")


def test_an_interrupted_release_is_completed(tmp_path: Path) -> None:
    """The next release commits the files of an interrupted release."""
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / RECORD).write_bytes(files(a="1")[RECORD].content)
    (folder / "a").write_text("half")
    assert write(folder, a="1").commit
    (folder / "a").write_text("2")
    assert write(folder, a="2").commit


def test_other_files_of_the_folder_stay(tmp_path: Path) -> None:
    """A release does not remove or commit an instructor's own files."""
    folder = tmp_path / "out"
    write(folder, a="1")
    (folder / "syllabus.md").write_text("Week 1")
    write(folder, a="2")
    assert (folder / "syllabus.md").read_text() == "Week 1"
    assert git(folder, "status", "--porcelain") == "?? syllabus.md"


def test_a_folder_that_no_release_made_is_refused(tmp_path: Path) -> None:
    """A release refuses a folder with other files, and does not change this folder."""
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("")
    with pytest.raises(HandoutError, match=r"did not create it\. Give a new or an empty"):
        write(tmp_path / "mine", a="1")
    assert [path.name for path in (tmp_path / "mine").iterdir()] == ["thesis.txt"]
    with pytest.raises(HandoutError, match="did not create it"):
        write(tmp_path / "mine" / "thesis.txt", a="1")
    (tmp_path / "empty").mkdir()
    assert write(tmp_path / "empty", a="1").commit


def test_changes_by_hand_are_not_overwritten(tmp_path: Path) -> None:
    """An uncommitted change of a released file stops the release."""
    folder = tmp_path / "out"
    write(folder, a="1", b="1")
    (folder / "a").write_text("by hand")
    with pytest.raises(HandoutError, match=r"changed by hand and not committed: a\. .*checkout HEAD"):
        write(folder, a="2", b="2")
    assert (folder / "b").read_text() == "1"
    git(folder, "-c", "user.name=x", "-c", "user.email=x@localhost", "commit", "-qam", "by hand")
    assert write(folder, a="2", b="2").changed == 2


def test_a_folder_inside_the_course_is_refused() -> None:
    """A release into a folder inside the checkout raises an error."""
    with pytest.raises(HandoutError, match="Give a folder outside"):
        refuse_inside(ROOT / "out", ROOT)


def test_a_zip_that_no_release_made_is_refused(tmp_path: Path) -> None:
    """A release overwrites a zip file only if this file is the zip of an earlier release."""
    folder = tmp_path / "out"
    path = zip_path(folder)
    write_zip(path, "out", files(a="1"))
    first = path.read_bytes()
    write_zip(zip_path(folder), "out", files(a="1"))
    assert path.read_bytes() == first
    path.write_bytes(b"PK")
    with pytest.raises(HandoutError, match="did not create it"):
        zip_path(folder)


@pytest.mark.parametrize(
    ("name", "released"),
    [
        ("course_pkg/chapters/ch05_write_a_server/checks/__init__.py", True),
        ("course_pkg/chapters/ch03_choose/programs/cashier.py", True),
        ("course_pkg/chapters/paths.json", True),
        ("course_pkg/chapters/private_05.py", False),
        ("course_pkg/chapters/ch05_write_a_server/answers.py", False),
        ("course_pkg/chapters/ch05_write_a_server/answers/first.py", False),
        ("course_pkg/chapters/ch05_write_a_server/fixtures.py", False),
        ("solutions/05_write_a_server.ipynb", False),
        # The release creates these files again from the solutions, because an author can have changed the
        # files.
        ("notebooks/05_write_a_server.ipynb", False),
        ("roster.csv", False),
        ("grades/class.html", False),
        ("private/private_05.py", False),
        ("points.json", False),
        ("private/points.json", False),
    ],
)
def test_which_files_are_copied(name: str, released: bool) -> None:
    """The release contains only files that belong to the package and contain no answers."""
    assert is_released(name) is released


def test_without_git_the_same_files_are_found(tmp_path: Path) -> None:
    """Without a git repository, the release finds the same files, and ignores __pycache__."""
    for name in git(ROOT, "ls-files", "--cached", "--others", "--exclude-standard").splitlines():
        if (ROOT / name).is_file() and not name.startswith("tests/"):
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    (tmp_path / "course_pkg" / "__pycache__").mkdir()
    (tmp_path / "course_pkg" / "__pycache__" / "x.pyc").write_bytes(b"")
    expected = edition_files(ROOT, ["05"], ())
    assert set(edition_files(tmp_path, ["05"], ())) >= set(expected)
    assert not any("__pycache__" in name for name in edition_files(tmp_path, ["05"], ()))


def test_the_points_of_an_instructor_are_not_released(tmp_path: Path) -> None:
    """A points.json in the checkout does not change the edition, which contains the points of the course."""
    for name in git(ROOT, "ls-files", "--cached", "--others", "--exclude-standard").splitlines():
        if (ROOT / name).is_file() and not name.startswith(("tests/", "deploy/")):
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    expected = edition_files(tmp_path, ["05"], ())
    for place in (tmp_path, tmp_path / "private", tmp_path / "grades"):
        place.mkdir(exist_ok=True)
        (place / "points.json").write_text('{"05.1": 40, "all parts": "all-or-nothing"}')
    released = edition_files(tmp_path, ["05"], ())
    assert released == expected
    assert not any(b'"05.1": 40' in file.content for file in released.values())
    assert "05.1: " in released["notebooks/05_write_a_server.ipynb"].content.decode()
    assert "(2 points)" in released["notebooks/05_write_a_server.ipynb"].content.decode()


def test_paths_and_chapters() -> None:
    """A learning path is selected by its name; for an unknown name, the error message lists all names."""
    assert chosen_chapters("the lab session") == chosen_chapters("Lab-Session") == ("00", "05", "06", "07")
    assert chosen_chapters("The turtle tutorial") == ("00", "02", "05", "06", "07", "09", "13", "14")
    assert chosen_chapters("The whole course") == chosen_chapters()
    assert chosen_chapters(listed=["06", "05"]) == ("05", "06")
    with pytest.raises(HandoutError, match=r'no path "lab".*"The lab session", "The turtle tutorial"'):
        chosen_chapters("lab")
    with pytest.raises(HandoutError, match=r"no chapter 42.*00 to 16"):
        chosen_chapters(listed=["05", "42"])


def test_the_link_for_nbgitpuller() -> None:
    """The link for nbgitpuller contains the repository, the branch and the notebook.

    nbgitpuller's documentation describes the format of such a link.
    """
    link = urlsplit(pull_link(HUB, REPOSITORY, "main", "notebooks/05_write_a_server.ipynb"))
    assert (link.netloc, link.path) == ("hub.example.edu", "/hub/user-redirect/git-pull")
    assert parse_qs(link.query) == {
        "repo": [REPOSITORY],
        "urlpath": ["lab/tree/course/notebooks/05_write_a_server.ipynb"],
        "branch": ["main"],
    }


@pytest.mark.parametrize(
    ("hub", "repository"), [("hub.example.edu", REPOSITORY), (HUB, "git@git.example.edu:a/b")]
)
def test_an_address_that_nbgitpuller_cannot_use_is_refused(hub: str, repository: str) -> None:
    """If a URL is wrong, the error message contains the option, and says that a URL begins with https://."""
    with pytest.raises(HandoutError, match=r"--(hub|repository) .* begins with https://"):
        pull_link(hub, repository, "main", "x.ipynb")


def test_which_edition_a_folder_holds(tmp_path: Path) -> None:
    """The record in the folder lists the released chapters.

    If a folder has no record and no solutions, the error message says that the solutions are needed.
    """
    assert released_chapters(tmp_path) is None
    with pytest.raises(SetupError, match=r"there are none in .*solutions.* Get this folder"):
        require_solutions(tmp_path, "grade")
    write(tmp_path / "out", a="1")
    assert released_chapters(tmp_path / "out") == ("05",)
    with pytest.raises(SetupError, match="students' edition"):
        require_solutions(tmp_path / "out", "grade")


def test_a_packed_module_is_the_same_module(tmp_path: Path) -> None:
    """A module that pack() has encoded defines the same names, but does not contain the source text."""
    source = '"""Text."""\n\nfrom __future__ import annotations\n\nANSWER = "lock order"\n'
    module: dict[str, object] = {"__file__": "x.py", "__name__": "x"}
    exec(compile(pack(source), "x.py", "exec"), module)  # noqa: S102 -- it is the text above
    assert (module["ANSWER"], module["__doc__"]) == ("lock order", "Text.")
    assert "lock" not in pack(source)
