"""Tests of the layouts of submissions, and of unusable files."""

from __future__ import annotations

import json
import os
import re
import stat
import struct
import zipfile
from pathlib import Path

import pytest

from course_pkg.authoring.cells import Notebook
from course_pkg.errors import AuthoringError, GradingError
from course_pkg.grading.grade import Submission
from course_pkg.grading.intake import archive
from course_pkg.grading.intake.first_edition import CHOOSE, RENUMBERED, RenumberedChapter
from course_pkg.grading.intake.submissions import LATE, submission_of, submissions
from course_pkg.grading.rebuild.rebuilder import rebuild
from tests.grading.handing_in import NAMES, folder, handed_out, raw, reference, zipped

FIVE, SIX = NAMES["05"], NAMES["06"]


@pytest.fixture(scope="module")
def five() -> bytes:
    """Return the students' notebook of chapter 05."""
    return raw(handed_out("05"))


@pytest.fixture(scope="module")
def six() -> bytes:
    """Return the students' notebook of chapter 06."""
    return raw(handed_out("06"))


def _kept(found: list[Submission]) -> list[tuple[str, str]]:
    """Return the student and the chapter of each submission. Assert that each submission can be graded."""
    assert [each.problem for each in found] == [""] * len(found)
    return [(each.student, each.chapter) for each in found]


GRADESCOPE = b"""---
submission_11:
  :submitters:
  - :name: Somebody
    :sid: '0042'
    :email: s42@example.com
  - :name: Else
    :sid: ''
    :email: s43@example.com
  :created_at: !ruby/object:ActiveSupport::TimeWithZone 2026-01-01 10:00:00.1 Z
  :score: 0.0
submission_12:
  :submitters:
  - :name: Third
"""


def test_layouts(tmp_path: Path, five: bytes, six: bytes) -> None:
    """The program finds the submissions in each platform's layout, in a folder and in a zip."""
    layouts = {
        "hand": (
            {f"s02/{FIVE}": five, f"s01/{FIVE}": five, f"s01/{SIX}": six},
            ["s01 05", "s01 06", "s02 05"],
        ),
        "deeper": ({f"s01/work/{FIVE}": five, f"s02/{FIVE}": five}, ["s01 05", "s02 05"]),
        "one": ({f"s01/{FIVE}": five}, ["s01 05"]),
        "wrapped": ({f"submissions/s01/{FIVE}": five}, ["s01 05"]),
        "moodle": (
            {
                f"A One_11_assignsubmission_file_/{FIVE}": five,
                f"Participant_12_assignsubmission_file/{FIVE}": five,
                f"A Two_13_assignsubmission_file_{FIVE}": five,
            },
            ["A One_11 05", "A Two_13 05", "Participant_12 05"],
        ),
        "canvas": (
            {"onea_123_4567_" + FIVE: five, "two-b_LATE_124_4568_05_write_a_server-1.ipynb": five},
            ["onea_123 05", "two-b_124 05"],
        ),
        "gradescope": (
            {
                "assignment_9_export/submission_metadata.yml": GRADESCOPE,
                f"assignment_9_export/submission_11/{FIVE}": five,
                f"assignment_9_export/submission_12/{FIVE}": five,
                f"assignment_9_export/submission_13/{FIVE}": five,
            },
            ["0042 05", "Third 05", "s43@example.com 05", "submission_13 05"],
        ),
        "nbgrader": (
            {
                f"submitted/s01/ps5/{FIVE}": five,
                "submitted/s01/ps5/timestamp.txt": b"2026",
                f"submitted/s02/ps5/{FIVE}": five,
            },
            ["s01 05", "s02 05"],
        ),
    }
    for name, (files, expected) in layouts.items():
        for source in (folder(tmp_path / name, files), zipped(tmp_path / f"{name}.zip", files)):
            assert [" ".join(pair) for pair in _kept(submissions(source))] == expected, source.name


@pytest.mark.parametrize("name", ["class.zip", "other.zip"])
def test_a_zip_of_the_folder(tmp_path: Path, five: bytes, name: str) -> None:
    """In a zip, the students' folders can be inside another folder."""
    files = {f"class/{student}/{FIVE}": five for student in ("s01", "s02")}
    assert _kept(submissions(zipped(tmp_path / name, files))) == [("s01", "05"), ("s02", "05")]


def test_canvas_marks_lateness(tmp_path: Path, five: bytes) -> None:
    """A submission that Canvas marks as late gets a note."""
    [found] = submissions(folder(tmp_path, {"one_LATE_1_22_" + FIVE: five}))
    assert found.notes == (LATE,)
    assert found.late == 0.0


def test_only_the_given_chapters_are_graded(tmp_path: Path, five: bytes, six: bytes) -> None:
    """`course grade` grades only the given chapters, and refuses an unknown chapter."""
    source = folder(tmp_path, {f"s01/{FIVE}": five, f"s01/{SIX}": six})
    assert _kept(submissions(source, ["06"])) == [("s01", "06")]
    with pytest.raises(AuthoringError, match="chapter 77"):
        submissions(source, ["77"])


@pytest.mark.parametrize(
    "name", ["mine.ipynb", "Untitled.ipynb", "06_write_a_client.ipynb", "05 (1).ipynb", "5.ipynb.txt"]
)
def test_cells_identify_the_chapter(tmp_path: Path, five: bytes, name: str) -> None:
    """If a notebook was renamed, its exercises identify the chapter."""
    [found] = submissions(folder(tmp_path, {f"s01/{name}": five}))
    assert (found.chapter, found.problem) == ("05", "")
    assert any("chapter 06" in note for note in found.notes) == name.startswith("06")


def test_notebook_without_exercises(tmp_path: Path) -> None:
    """If a notebook contains no exercises, the ids of its other cells identify the chapter."""
    notebook = handed_out("05")
    notebook["cells"] = [cell for cell in notebook["cells"] if "course" not in cell["metadata"]]
    [found] = submissions(folder(tmp_path, {"s01/mine.ipynb": raw(notebook)}))
    assert (found.chapter, found.problem) == ("05", "")


def _of_first_edition(chapter: RenumberedChapter) -> Notebook:
    """Return the number and the title of a chapter in the first edition."""
    text = json.dumps(handed_out(chapter.now))
    notebook: Notebook = json.loads(re.sub(rf"(?<![0-9]){chapter.now}(?=[.-][0-9a-z])", chapter.number, text))
    notebook["cells"][0]["source"] = f"# {chapter.title}\n\nA first paragraph."
    return notebook


@pytest.mark.parametrize("chapter", RENUMBERED, ids=[each.name for each in RENUMBERED])
def test_a_notebook_of_the_first_edition(tmp_path: Path, chapter: RenumberedChapter) -> None:
    """The error message for a notebook of the first edition contains the new chapter number."""
    notebook = _of_first_edition(chapter)
    without_title = {**notebook, "cells": notebook["cells"][1:]}
    without_ids = {
        **notebook,
        "cells": [{**cell, "id": str(place), "metadata": {}} for place, cell in enumerate(notebook["cells"])],
    }
    files = {
        f"s01/{chapter.name}.ipynb": raw(notebook),
        "s02/mine.ipynb": raw(notebook),
        "s03/mine.ipynb": raw(without_title),
        "s04/mine.ipynb": raw(without_ids),
        f"s05/{chapter.name} (1).ipynb": b'{"cells": []}',
    }
    found = submissions(folder(tmp_path, files))
    assert [each.chapter for each in found] == [chapter.now] * 5
    for each, path in zip(found, files, strict=True):
        assert each.content == b""
        assert each.problem.startswith(
            f"{Path(path).name} was not graded: this notebook belongs to the first edition"
        )
        assert f"and it is chapter {chapter.now} now." in each.problem
        assert f"{chapter.now}_{chapter.name[3:]}.ipynb" in each.problem


def test_a_chapter_whose_exercises_were_renumbered(tmp_path: Path) -> None:
    """In chapter 03, the old title or the old exercise number 03.5 identifies the first edition."""
    notebook = handed_out("03")
    titled = {
        **notebook,
        "cells": [{**notebook["cells"][0], "source": f"# {CHOOSE.title}"}, *notebook["cells"][1:]],
    }
    five = json.loads(json.dumps(notebook).replace("exercise-03-4", "exercise-03-5"))
    files = {"s01/03_choose.ipynb": raw(titled), "s02/mine.ipynb": raw(five), "s03/mine.ipynb": raw(notebook)}
    first, second, third = submissions(folder(tmp_path, files))
    for each in (first, second):
        assert (each.chapter, each.content) == ("03", b"")
        assert "the exercises of this chapter had other numbers. Exercise 03.3 is" in each.problem
        assert "Copy your answers into 03_choose.ipynb" in each.problem
    assert (third.chapter, third.problem) == ("03", "")


def test_exercises_that_another_chapter_has_now(tmp_path: Path) -> None:
    """If exercises have moved to another chapter, the error message for a notebook names these exercises."""
    chapter = next(each for each in RENUMBERED if each.number == "10")
    [found] = submissions(folder(tmp_path, {"s01/mine.ipynb": raw(_of_first_edition(chapter))}))
    assert "and it is chapter 12 now. Exercise 10.1 is now exercise 10.4 in chapter 10" in found.problem


@pytest.mark.parametrize("chapter", RENUMBERED, ids=[each.name for each in RENUMBERED])
def test_a_notebook_of_this_edition_under_a_name_of_the_first(
    tmp_path: Path, chapter: RenumberedChapter
) -> None:
    """A notebook with this edition's exercises gets a grade, even if its name is from the first edition."""
    content = raw(handed_out(chapter.now))
    source = folder(tmp_path, {f"s01/{chapter.name}.ipynb": content, "s02/mine.ipynb": content})
    assert _kept(submissions(source)) == [("s01", chapter.now), ("s02", chapter.now)]


def test_newest_of_two_notebooks_is_used(tmp_path: Path, five: bytes) -> None:
    """If a chapter has two notebooks, the program grades the newer one, and a note names the older one."""
    source = folder(
        tmp_path,
        {f"one_1_2{n}_05_write_a_server{end}.ipynb": five for n, end in enumerate(["", "-2", "-10"])},
    )
    [found] = submissions(source)
    assert "server-10" in found.origin
    assert "server-2" in found.notes[0]
    source = folder(tmp_path / "again", {"s01/05_a.ipynb": five, "s01/05_b.ipynb": five})
    os.utime(source / "s01/05_b.ipynb", (1, 1))
    [found] = submissions(source)
    assert found.origin == "s01/05_a.ipynb"
    assert "05_b" in found.notes[0]


def test_readable_notebook_is_used_instead_of_a_broken_one(tmp_path: Path, five: bytes) -> None:
    """If only one of a chapter's notebooks can be read, the program grades this notebook."""
    source = folder(tmp_path, {f"s01/{FIVE}": five, "s01/05_write_a_server (2).ipynb": b"{"})
    [found] = submissions(source)
    assert (found.origin, found.problem) == (f"s01/{FIVE}", "")
    assert "(2)" in found.notes[0]


def test_files_of_systems_and_editors_are_ignored(tmp_path: Path, five: bytes) -> None:
    """The program ignores files that operating systems and editors create."""
    litter = [
        "__MACOSX/s01/._" + FIVE,
        "s01/.ipynb_checkpoints/" + FIVE,
        "s01/.DS_Store",
        ".git/x.ipynb",
        "s01/Thumbs.db",
    ]
    files = {f"s01/{FIVE}": five, **dict.fromkeys(litter, b"x")}
    for source in (folder(tmp_path / "a", files), zipped(tmp_path / "a.zip", files)):
        assert _kept(submissions(source)) == [("s01", "05")]


DEEP = b'{"cells": ' + b"[" * 100_000 + b"]" * 100_000 + b"}"
BAD = {
    "empty": (b" \n", "empty"),
    "not JSON": (b"{", "not JSON"),
    "not UTF-8": (b'{"cells": ["\xff"]}', "not JSON"),
    "a number of many digits": (b'{"cells": ' + b"9" * 10_000 + b"}", "not JSON"),
    "a list": (b"[]", "is JSON, but it has no cells"),
    "no cells": (b'{"nbformat": 4}', "no cells"),
    "cells that are none": (b'{"cells": {"a": 1}}', "no cells"),
    "nested": (DEEP, "not JSON"),
    "brackets": (b'{"cells": [' + b"[]," * 500_000 + b"[]]}", "500000"),
    "many cells": (json.dumps({"cells": [{}] * 50_001}).encode(), "50000"),
    "a web page": (b"<!DOCTYPE html><html>", "download"),
    "merge marks": (b"<<<<<<< HEAD\n{}", "git merge"),
    "a PDF": (b"%PDF-1.7", "PDF"),
    "a zip": (b"PK\x03\x04", "zip"),
    "an old one with nothing in it": (b'{"nbformat": 3, "worksheets": 3}', "no cells"),
    "too large": (b" " * (archive.LARGEST + 1), "20 MiB"),
}


@pytest.mark.parametrize(("content", "words"), BAD.values(), ids=BAD)
def test_what_is_no_notebook(tmp_path: Path, content: bytes, words: str) -> None:
    """If a file is unreadable, the error message contains the file name and what to do next."""
    for source in (
        folder(tmp_path / "a", {f"s01/{FIVE}": content}),
        zipped(tmp_path / "a.zip", {f"s01/{FIVE}": content}),
    ):
        [found] = submissions(source)
        assert (found.student, found.chapter, found.content) == ("s01", "05", b"")
        assert FIVE in found.problem
        assert words in found.problem or "after unpacking is too large" in found.problem


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("s01/77_other.ipynb", "no chapter 77"),
        ("s01/mine.ipynb", "give the file a name such as"),
        ("s01/notes.pdf", "neither a notebook"),
        ("s01/all.zip", "archive inside"),
        (FIVE, "the student is unknown"),
    ],
)
def test_files_without_a_chapter_or_student(tmp_path: Path, name: str, words: str) -> None:
    """The program lists files that belong to no chapter or to no student."""
    [found] = submissions(folder(tmp_path, {name: b'{"cells": []}'}))
    assert words in found.problem
    assert found.chapter == ""


def test_many_other_files_are_one_problem(tmp_path: Path, five: bytes) -> None:
    """One error message reports all unusable files of a student."""
    others = {f"s01/photo_{number}.png": b"x" for number in range(9)}
    found = submissions(folder(tmp_path, {f"s01/{FIVE}": five, **others}))
    assert [each.chapter for each in found] == ["", "05"]
    assert "5 more" in found[0].problem


def test_links_are_not_followed(tmp_path: Path, five: bytes) -> None:
    """The program does not follow links to files and folders."""
    secret = folder(tmp_path / "secret", {f"s09/{FIVE}": five})
    source = folder(tmp_path / "in", {f"s03/{FIVE}": five})
    (source / "s01").mkdir()
    (source / "s01" / FIVE).symlink_to(secret / "s09" / FIVE)
    (source / "s02").symlink_to(secret / "s09")
    found = submissions(source)
    assert [(each.student, bool(each.problem)) for each in found] == [
        ("", True),
        ("s01", True),
        ("s03", False),
    ]
    assert "link" in found[1].problem
    assert not any(each.content for each in found[:2])


def test_pipe_is_not_opened(tmp_path: Path) -> None:
    """The program reports a pipe without opening it."""
    (tmp_path / "s01").mkdir()
    os.mkfifo(tmp_path / "s01" / FIVE)
    [found] = submissions(tmp_path)
    assert "not an ordinary file" in found.problem


def test_a_file_that_may_not_be_read(tmp_path: Path, five: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a file cannot be read, the error message asks the instructor to change the file's permissions."""

    def refuse(*_: object) -> int:
        raise PermissionError(13, "Permission denied")

    source = folder(tmp_path, {f"s01/{FIVE}": five})
    monkeypatch.setattr(os, "open", refuse)
    [found] = submissions(source)
    assert "Permission denied" in found.problem


@pytest.mark.parametrize(
    "name", ["../s01/" + FIVE, "/s01/" + FIVE, "C:\\s01\\" + FIVE, "s01/../../" + FIVE, "..\\s01\\" + FIVE]
)
def test_paths_that_lead_out(tmp_path: Path, five: bytes, name: str) -> None:
    """If the path of a zip member leads out of the zip, the program does not grade this member."""
    [found] = submissions(zipped(tmp_path / "a.zip", {name: five}))
    assert "outside the archive" in found.problem
    assert [path.name for path in tmp_path.iterdir()] == ["a.zip"]


def test_a_link_in_a_zip(tmp_path: Path) -> None:
    """The program does not follow a link in a zip."""
    source = zipped(
        tmp_path / "a.zip", {f"s01/{FIVE}": b"/etc/passwd"}, external_attr=(stat.S_IFLNK | 0o777) << 16
    )
    [found] = submissions(source)
    assert "link" in found.problem


def test_a_zip_bomb(tmp_path: Path, five: bytes) -> None:
    """The program does not unpack a huge zip member, even if the zip says that the member is small."""
    bomb = b" " * (archive.LARGEST - 5)
    source = zipped(tmp_path / "a.zip", {f"s01/{FIVE}": bomb, f"s02/{FIVE}": five})
    bad, good = submissions(source)
    assert "after unpacking is too large" in bad.problem
    assert good.content
    liar = zipped(tmp_path / "b.zip", {f"s01/{FIVE}": b" " * (30 << 20)})
    data = liar.read_bytes().replace(struct.pack("<L", 30 << 20), struct.pack("<L", 1000))
    liar.write_bytes(data)
    [found] = submissions(liar)
    assert found.problem


def test_total_size_of_a_zip_is_limited(tmp_path: Path, five: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    """After the size limit is reached, the program lists the remaining files, but does not read them."""
    monkeypatch.setattr(archive, "ALTOGETHER", len(five) * 5 // 2)
    found = submissions(zipped(tmp_path / "a.zip", {f"s0{n}/{FIVE}": five for n in range(4)}))
    assert [bool(each.problem) for each in found] == [False, False, True, True]


def test_number_of_members_is_limited(tmp_path: Path, five: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    """The program grades only the first files of a large zip."""
    monkeypatch.setattr(archive, "MEMBERS", 2)
    found = submissions(zipped(tmp_path / "a.zip", {f"s0{n}/{FIVE}": five for n in range(4)}))
    assert [(each.student, bool(each.problem)) for each in found] == [
        ("", True),
        ("s00", False),
        ("s01", False),
    ]


def test_a_damaged_or_locked_member(tmp_path: Path, five: bytes) -> None:
    """The program reports a zip member with a wrong checksum or a password."""
    source = zipped(tmp_path / "a.zip", {f"s01/{FIVE}": five})
    with zipfile.ZipFile(source) as archive:
        middle = archive.infolist()[0].compress_size // 2
    content = bytearray(source.read_bytes())
    content[middle] ^= 0xFF
    source.write_bytes(bytes(content))
    [found] = submissions(source)
    assert "damaged" in found.problem
    locked = zipped(tmp_path / "b.zip", {f"s01/{FIVE}": five})
    with zipfile.ZipFile(locked) as archive:
        listed = archive.start_dir
    content = bytearray(locked.read_bytes())
    content[6] |= 1  # This bit marks a zip member as encrypted.
    content[listed + 8] |= 1
    locked.write_bytes(bytes(content))
    [found] = submissions(locked)
    assert "password" in found.problem


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"x" * 1000, None])
def test_source_that_is_not_a_folder_or_zip(tmp_path: Path, content: bytes | None) -> None:
    """The error message for a wrong source contains the expected layouts."""
    source = tmp_path / "a.zip"
    if content is not None:
        source.write_bytes(content)
    with pytest.raises(GradingError, match="SUBMISSIONS/<student>"):
        submissions(source)


@pytest.mark.parametrize(
    "content",
    [b"{", b"- 1", b"a: [", b"\xff\xfe\x00", b"a: &x [*x]", b"submission_1: {':submitters': 3}", b""],
)
def test_gradescope_metadata_that_is_broken(tmp_path: Path, five: bytes, content: bytes) -> None:
    """If Gradescope's metadata are damaged, the folder names identify the students."""
    files = {"submission_metadata.yml": content, f"submission_1/{FIVE}": five}
    found = submissions(folder(tmp_path, files))
    assert [each.student for each in found if not each.problem] == ["submission_1"]


def test_file_name_cannot_name_another_student(tmp_path: Path, five: bytes) -> None:
    """A file counts for the student of its folder, even if its path also contains another student's name."""
    forged = b"submission_12:\n  :submitters:\n  - :sid: '0042'\n"
    files = {
        "submission_metadata.yml": GRADESCOPE,
        f"submission_11/{FIVE}": five,
        "submission_12/submission_metadata.yml": forged,
        f"submission_12/submission_11/{FIVE}": five,
    }
    found = submissions(folder(tmp_path / "a", files))
    assert [each.student for each in found if not each.problem] == ["0042", "Third", "s43@example.com"]
    assert [each.origin for each in found if each.student == "0042"] == [f"submission_11/{FIVE}"]
    files = {
        f"s01/A Two_12_assignsubmission_file_/{FIVE}": five,
        f"A One_11_assignsubmission_file_A Two_12_assignsubmission_file_{FIVE}": five,
        f"A Six_16_assignsubmission_file_/A Two_12_assignsubmission_file_/{FIVE}": five,
        f"s02/two_9_99_{FIVE}": five,
    }
    found = submissions(folder(tmp_path / "b", files))
    assert [each.student for each in found] == ["A One_11", "A Six_16", "s01", "s02"]
    [found] = submissions(folder(tmp_path / "c", {f"one_1_22_two_9_99_{FIVE}": five}))
    assert found.student == "one_1"


def test_nothing_is_in_an_empty_folder(tmp_path: Path) -> None:
    """An empty folder contains no submissions and causes no error."""
    assert submissions(tmp_path) == []


def test_outputs_are_not_kept_in_memory(tmp_path: Path, five: bytes) -> None:
    """The submissions in memory contain no outputs of cells."""
    notebook = json.loads(five)
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell["outputs"] = [{"output_type": "stream", "name": "stdout", "text": "x" * 10_000}]
            cell["source"] += "\n# mine \ud800"
    [found] = submissions(folder(tmp_path, {f"s01/{FIVE}": raw(notebook)}))
    assert len(found.content) < 100_000
    made, kept = (rebuild(reference("05"), content) for content in (raw(notebook), found.content))
    assert made == kept


def test_one_notebook(tmp_path: Path, five: bytes) -> None:
    """A single notebook belongs to the given student, or to the student in the folder's name."""
    source = folder(tmp_path, {f"s01/{FIVE}": five}) / "s01" / FIVE
    assert submissions(source) == [submission_of(source)]
    assert _kept([submission_of(source), submission_of(source, "s07")]) == [("s01", "05"), ("s07", "05")]
    with pytest.raises(GradingError, match="There is no"):
        submission_of(tmp_path / "s01" / "none.ipynb")


def test_names_of_any_letters(tmp_path: Path, five: bytes) -> None:
    """Student names can contain the letters of all languages."""
    names = ["Größe", "a\u202eb", "x" * 200, "名前", "\udcff"]
    found = submissions(folder(tmp_path, {f"{name}/{FIVE}": five for name in names}))
    assert len({each.student for each in found}) == len(names)
    json.dumps([each.student for each in found]).encode()
    for each in found:
        (each.student + each.origin).encode()
