"""Tests of `course collect`, which collects work from home folders with each student's permissions."""

from __future__ import annotations

import csv
import os
import shutil
import signal
import stat
import tempfile
from collections.abc import Iterator
from datetime import datetime, timezone
from pathlib import Path

import pytest

from course_pkg.errors import HandoutError
from course_pkg.grading.intake.submissions import submissions
from course_pkg.handout.collect import Options, Wanted, collect
from course_pkg.handout.homes.listing import Home, homes_in, read_students
from course_pkg.handout.homes.reading import read_home
from course_pkg.handout.homes.storing import store
from course_pkg.handout.homes.work import WorkFile
from tests.grading.handing_in import handed_out, raw
from tests.grading.packages import my_geometry
from tests.setup.test_course import course

ROOT = os.geteuid() == 0
NOTEBOOK = "05_write_a_server.ipynb"
TIME = 1_700_000_000  # seconds since 1970
FIRST_UID = 54_321  # No user of this machine has this id.
WANTED = Wanted(["05", "06", "07"])


@pytest.fixture
def homes() -> Iterator[Path]:
    """Create a folder for home folders; every user can enter this folder."""
    folder = Path(tempfile.mkdtemp(prefix="course-homes-"))
    folder.chmod(0o755)
    yield folder
    shutil.rmtree(folder)


def add_home(homes: Path, student: str, files: dict[str, bytes], course: str = "ros-course") -> Path:
    """Create a student's home folder with files that other users cannot read."""
    home = homes / student
    for name, content in files.items():
        path = home / course / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        os.utime(path, (TIME, TIME))
    home.mkdir(exist_ok=True)
    give(home, FIRST_UID + len(list(homes.iterdir())))
    return home


def give(path: Path, uid: int) -> None:
    """Change the owner of all files in a folder, if this process has the permission."""
    for each in [path, *path.rglob("*")]:
        if ROOT:
            os.chown(each, uid, uid, follow_symlinks=False)
        if not each.is_symlink():
            each.chmod(0o700 if each.is_dir() else 0o600)


def packaged() -> dict[str, bytes]:
    """Return the files of chapter 07's package and the files that catkin writes."""
    files = {f"workspace/src/my_geometry/{path}": content for path, content in my_geometry().items()}
    return {**files, "workspace/build/x/package.xml": b"<package/>", "workspace/src/CMakeLists.txt": b""}


def run(homes: Path, out: Path, **options: object) -> int:
    """Run the collection for all home folders."""
    return collect(Options("ros-course", out, homes, **options))  # type: ignore[arg-type]


def times(out: Path) -> list[list[str]]:
    """Return the rows of times.csv."""
    with (out / "times.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def test_work_is_where_the_grader_looks(
    homes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The command stores each student's work in a separate folder, and lists the students without work."""
    notebook = raw(handed_out("05"))
    add_home(homes, "anna", {f"notebooks/{NOTEBOOK}": notebook, **packaged(), "notebooks/own.ipynb": b"{}"})
    add_home(homes, "ben", {NOTEBOOK: notebook})  # This student has moved the notebook.
    add_home(homes, "carla", {"notebooks/notes.txt": b""})
    add_home(homes, "dora", {}, "elsewhere")
    out = tmp_path / "out"
    assert run(homes, out) == 0
    printed = capsys.readouterr().out
    assert "2 notebooks and 1 package of 2 students" in printed
    assert "No work was found for 2 students: carla, dora" in printed
    assert (out / "anna" / NOTEBOOK).read_bytes() == notebook
    assert stat.S_IMODE(out.stat().st_mode) == 0o700
    assert not (out / "anna" / "own.ipynb").exists()
    head, *rows = times(out)
    assert head == ["student", "chapter", "file", "time"]
    expected = datetime.fromtimestamp(TIME, timezone.utc)
    assert {datetime.fromisoformat(time) for *_, time in rows} == {expected}
    assert ["anna", "05", f"anna/{NOTEBOOK}"] in [row[:3] for row in rows]
    assert ["anna", "07", "anna/my_geometry/package.xml"] in [row[:3] for row in rows]
    assert ["anna", "07", "anna/my_geometry"] in [row[:3] for row in rows]
    found = {(each.student, each.chapter, each.problem) for each in submissions(out)}
    assert {("anna", "05", ""), ("ben", "05", "")} <= found
    assert {student for student, _, _ in found} == {"anna", "ben"}
    assert {each.origin for each in submissions(out)} <= {row[2] for row in rows}
    [with_package] = [each for each in submissions(out, ["07"]) if each.chapter == "07"]
    assert [package.name for package in with_package.packages] == ["my_geometry"]


def test_the_command_line(homes: Path, tmp_path: Path) -> None:
    """The command collects the files, and prints one error message for a wrong folder."""
    add_home(homes, "anna", {f"notebooks/{NOTEBOOK}": b"1"})
    words = ["collect", "ros-course", str(tmp_path / "out"), "--chapters", "5", "--homes"]
    done = course(*words, str(homes))
    assert done.returncode == 0, done.stderr
    assert "1 notebook and 0 packages of 1 student are in" in done.stdout
    refused = course(*words, "/nowhere")
    assert (refused.returncode, refused.stderr) == (
        1,
        "course: /nowhere cannot be listed (No such file or directory). With --homes, give the folder that "
        "contains the home folders.\n",
    )


def test_a_second_collection_replaces_what_changed_and_keeps_the_rest(homes: Path, tmp_path: Path) -> None:
    """A later collection replaces old notebooks and packages, and does not change other chapters."""
    home = add_home(homes, "anna", {f"notebooks/{NOTEBOOK}": b"1", **packaged()})
    run(homes, tmp_path / "out")
    (home / "ros-course" / "notebooks" / NOTEBOOK).write_bytes(b"2")
    (home / "ros-course" / "workspace" / "src" / "my_geometry" / "scripts" / "server.py").unlink()
    assert run(homes, tmp_path / "out", chapters=("07",)) == 0
    assert (tmp_path / "out" / "anna" / NOTEBOOK).read_bytes() == b"1"
    assert not (tmp_path / "out" / "anna" / "my_geometry" / "scripts" / "server.py").exists()
    assert run(homes, tmp_path / "out") == 0
    assert (tmp_path / "out" / "anna" / NOTEBOOK).read_bytes() == b"2"
    rows = [row[:3] for row in times(tmp_path / "out")]
    assert rows.count(["anna", "05", f"anna/{NOTEBOOK}"]) == 1
    assert not any(row[2].endswith("server.py") for row in rows)
    assert sorted(path.name for path in (tmp_path / "out" / "anna").iterdir()) == [NOTEBOOK, "my_geometry"]


@pytest.mark.skipif(not ROOT, reason="only root can read with another user's rights")
def test_only_what_the_student_may_read_is_read(homes: Path, tmp_path: Path) -> None:
    """Root reads only files that the student has permission to read."""
    anna = add_home(homes, "anna", {f"notebooks/{NOTEBOOK}": b"1"})
    ben = add_home(homes, "ben", {"notebooks/06_write_a_client.ipynb": b"2"})
    secret = ben / "ros-course" / "notebooks" / NOTEBOOK
    # On some file systems, a student can create a hard link to another student's file.
    os.link(anna / "ros-course" / "notebooks" / NOTEBOOK, secret)
    [home] = [each for each in homes_in(homes) if each.student == "ben"]
    files, problems = read_home(home, "ros-course", WANTED.notebooks, WANTED.packages)
    assert [file.path for file in files] == ["06_write_a_client.ipynb"]
    assert problems == [f"{NOTEBOOK}: it cannot be read (Permission denied)"]
    homes.chmod(0o700)  # Only root can enter the folder now.
    files, problems = read_home(home, "ros-course", WANTED.notebooks, WANTED.packages)
    assert (files, problems) == ([], ["ros-course: it cannot be read (Permission denied)"])


def home_of(homes: Path, student: str) -> Home:
    """Return the object for a home folder that belongs to the user of this process."""
    return Home(student, homes / student, os.getuid(), os.getgid())


@pytest.mark.parametrize("place", ["ros-course", "ros-course/notebooks", f"ros-course/notebooks/{NOTEBOOK}"])
def test_no_link_is_followed(homes: Path, place: str) -> None:
    """If a link replaces a folder or a notebook, the command reports the link, but does not follow it."""
    add_home(homes, "other", {f"notebooks/{NOTEBOOK}": b"secret"})
    link = homes / "anna" / place
    link.parent.mkdir(parents=True)
    link.symlink_to(homes / "other" / place)
    give(homes, FIRST_UID)  # The user can read all files in the folder.
    [home] = [each for each in homes_in(homes) if each.student == "anna"]
    files, [problem] = read_home(home, "ros-course", WANTED.notebooks, WANTED.packages)
    assert files == []
    assert "the command does not follow links" in problem


def test_links_in_packages_and_linked_packages_are_reported(homes: Path) -> None:
    """The command does not collect links in packages and links to packages, but reports these links."""
    home = add_home(homes, "anna", packaged())
    sources = home / "ros-course" / "workspace" / "src"
    (sources / "my_geometry" / "passwords").symlink_to("/etc/passwd")
    (sources / "loop").symlink_to(sources)
    (sources / "on_off").symlink_to(sources / "my_geometry")
    give(homes, FIRST_UID)
    [found] = homes_in(homes)
    asked = frozenset({"my_geometry", "on_off"})
    files, problems = read_home(found, "ros-course", {}, asked)
    assert {file.package for file in files} == {"my_geometry"}
    assert "passwords" not in {file.path for file in files}
    assert [problem.partition(": it is a link")[0] for problem in problems] == [
        "the package my_geometry: passwords",
        "the package on_off",
    ]


def test_pipes_large_files_and_large_packages_are_left_out(
    homes: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The command does not collect named pipes, large notebooks and large packages."""
    monkeypatch.setattr("course_pkg.grading.intake.archive.LARGEST", 1 << 20)
    home = add_home(
        homes, "anna", {"notebooks/06_write_a_client.ipynb": b"x" * ((1 << 20) + 1), **packaged()}
    )
    os.mkfifo(home / "ros-course" / "notebooks" / NOTEBOOK)
    (home / "ros-course" / "workspace" / "src" / "my_geometry" / "core").write_bytes(b"x" * (3 << 20))
    give(homes, FIRST_UID)
    [found] = homes_in(homes)
    files, problems = read_home(found, "ros-course", WANTED.notebooks, WANTED.packages)
    assert files == []
    assert problems == [
        f"{NOTEBOOK}: it is not an ordinary file",
        "06_write_a_client.ipynb: it has more than 1 MiB",
        "the package my_geometry: it has more than 2 MiB",
    ]


def test_a_home_that_does_not_answer_is_left_out(homes: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a home folder does not respond within the time limit, the command reports the folder."""
    add_home(homes, "anna", {f"notebooks/{NOTEBOOK}": b"1"})
    monkeypatch.setattr("course_pkg.handout.homes.reading.work_in", lambda *_: signal.pause())
    [home] = homes_in(homes)
    files, problems = read_home(home, "ros-course", WANTED.notebooks, WANTED.packages, timeout=0.05)
    assert (files, problems) == ([], ["reading the folder took more than 0.05 s"])


def test_a_name_that_leads_elsewhere_is_refused(homes: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The command refuses a path that leads out of the home folder."""
    add_home(homes, "anna", {f"notebooks/{NOTEBOOK}": b"1"})
    file = WorkFile("../../ben/05_write_a_server.ipynb", b"", 0, 0)
    monkeypatch.setattr("course_pkg.handout.homes.reading.work_in", lambda *_: iter([file]))
    [home] = homes_in(homes)
    files, [problem] = read_home(home, "ros-course", WANTED.notebooks, WANTED.packages)
    assert files == []
    assert "outside of the folder" in problem


def test_a_time_that_was_set_back_is_listed(
    homes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """If a student has changed the time of a file to an earlier time, the command reports the file."""
    add_home(homes, "anna", {f"notebooks/{NOTEBOOK}": b"1"})
    home = add_home(homes, "ben", {f"notebooks/{NOTEBOOK}": b"1"})
    os.utime(home / "ros-course" / "notebooks" / NOTEBOOK)
    run(homes, tmp_path / "out")
    printed = capsys.readouterr().out
    assert f"anna/{NOTEBOOK}: the time of the file is 2023-11-1" in printed
    assert f"ben/{NOTEBOOK}" not in printed


def test_a_time_that_is_no_date_does_no_harm(homes: Path, tmp_path: Path) -> None:
    """A file time that is not a valid date causes no error."""
    home = add_home(homes, "anna", {f"notebooks/{NOTEBOOK}": b"1"})
    os.utime(home / "ros-course" / "notebooks" / NOTEBOOK, (10**12, 10**12))
    assert run(homes, tmp_path / "out") == 0
    [_, row] = times(tmp_path / "out")
    assert datetime.fromisoformat(row[3]).year <= 2446  # Some file systems cannot store a later year.


def test_no_work_at_all_is_an_error(homes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """If no student has any work, the command returns 1, and the message says to check the folder's name."""
    add_home(homes, "anna", {}, "other")
    assert run(homes, tmp_path / "out") == 1
    assert "Check that ros-course is the course's folder in each home folder." in capsys.readouterr().out


def test_a_folder_that_no_collection_made_is_refused(homes: Path, tmp_path: Path) -> None:
    """The collection writes no file to a folder that contains other files."""
    (tmp_path / "thesis.txt").write_text("")
    with pytest.raises(HandoutError, match=r"Nothing was collected, because .* contains no "):
        run(homes, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


@pytest.mark.parametrize("folder", ["/home/anna/ros-course", "../ben", "."])
def test_the_folder_is_inside_of_the_home(folder: str, homes: Path, tmp_path: Path) -> None:
    """The command refuses an absolute path, and a path that leads out of the home folder."""
    with pytest.raises(HandoutError, match="Give the folder's path below the home folder"):
        collect(Options(folder, tmp_path / "out", homes))


@pytest.mark.parametrize(
    "text", ["anna\n\nben\n", "username\nanna\nben\n", "name;id;username\nA;1;anna\nB;2;ben\n"]
)
def test_a_list_of_students(
    text: str, homes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The command collects only work of listed students, and reports a student without a home folder."""
    (tmp_path / "students").write_text(text)
    add_home(homes, "anna", {f"notebooks/{NOTEBOOK}": b"1"})
    add_home(homes, "teacher", {f"notebooks/{NOTEBOOK}": b"1"})
    run(homes, tmp_path / "out", students=tmp_path / "students")
    assert "No work was found for 1 student: ben" in (printed := capsys.readouterr().out)
    assert f"ben: there is no home folder {homes / 'ben'}" in printed
    assert not (tmp_path / "out" / "teacher").exists()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("name,id\nA,1\n", "line 1: there is no column username"),
        ("anna\n../ben\n", "line 2: this is not the name of a user"),
        ("\n", "contains no student"),
        ("\udcff", "cannot be read"),
    ],
)
def test_a_list_that_cannot_be_used_is_refused(text: str, said: str, tmp_path: Path) -> None:
    """If the list of students is wrong, the error message contains the line number, but no student's name."""
    path = tmp_path / "students.csv"
    path.write_text(text, "utf-8", "surrogateescape")
    with pytest.raises(HandoutError, match=said):
        read_students(path)


def test_a_killed_collection_leaves_nothing_behind(tmp_path: Path) -> None:
    """The next collection removes the temporary files of a killed collection."""
    folder = tmp_path / "anna"
    file = WorkFile("package.xml", b"new", TIME, TIME, package="my_geometry", asked="my_geometry")
    store(folder, [file])
    (folder / ".my_geometry.new.collecting").mkdir()
    (folder / ".my_geometry.new.collecting" / "half").write_text("")
    store(folder, [file])
    assert [str(path.relative_to(folder)) for path in sorted(folder.rglob("*"))] == [
        "my_geometry",
        "my_geometry/package.xml",
    ]
