"""Tests of all steps from a platform's submissions to the file that the platform imports.

The tests imitate Moodle's importgradeslib.php and locallib.php, and Canvas's gradebook_importer.rb. The tests
also follow the specification of Gradescope's autograder.
"""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Mapping
from pathlib import Path

import pytest

from course_pkg.checking.report import Verdict
from course_pkg.grading.grade import Grade
from course_pkg.grading.intake.submissions import submissions
from course_pkg.grading.reports import write_reports
from course_pkg.grading.roster.class_list import ClassList, Lists, origins_of, read_lists
from tests.grading.grades import GOALS, HINTS, report
from tests.grading.handing_in import NAMES, folder, handed_out, raw, zipped
from tests.grading.roster.worksheets import ANONYMOUS, ENGLISH, FRENCH, GERMAN, SPANISH
from tests.grading.test_reports import Outline

ROSTER = (
    "section;email;id;name;username\n"
    "A;jane@uni.example;17;Doe, Jane;jdoe\nB;max@uni.example;18;Müller, Max;mmueller\n"
    "B;ann@uni.example;19;Lee, Ann;alee\n"
)
CANVAS_EXPORT = (
    "Student,ID,SIS User ID,SIS Login ID,Section,Old (7),Current Score\n"
    '    Points Possible,,,,,10.0,(read only)\n"Doe, Jane",17,S17,jdoe,ROS,,\n'
    '"Müller, Max",18,,mmueller,ROS,,\n'
    '"Lee, Ann",19,S19,alee,ROS,,\n"Student, Test",20,,,ROS,,\n'
)
METADATA = (
    "---\nsubmission_456:\n  :submitters:\n"
    "  - :name: Jane Doe\n    :sid: '4711'\n    :email: jane@uni.example\n"
    "  - :name: Max Müller\n    :sid: ''\n    :email: max@uni.example\n"
    "submission_457:\n  :submitters:\n  - :name: Jo New\n    :sid: '4799'\n    :email: jo@uni.example\n"
)


@pytest.fixture(scope="module")
def notebook() -> bytes:
    """Return the students' notebook of chapter 05."""
    return raw(handed_out())


def _graded(source: Path, lists: Lists, out: Path) -> tuple[list[Grade], ClassList]:
    """Grade all submissions in a folder. Jane Doe gets 7 of 9 points, and all other students get 9 points."""
    found = submissions(source)
    right = [report(check) for check in GOALS if check.startswith("05")]
    wrong = [report("05.1", Verdict.FAILED), *right[1:]]
    weak = re.compile("101|4711|jdoe").search
    grades = [
        Grade(each.student, each.chapter, tuple(wrong if weak(each.student) else right), origin=each.origin)
        for each in found
    ]
    class_list = lists.matched(origins_of(found), source)
    write_reports(grades, out, class_list)
    return grades, class_list


def _write(path: Path, content: str) -> Path:
    path.write_text(content, "utf-8", newline="")
    return path


def _rows(path: Path) -> list[list[str]]:
    with path.open(encoding="utf-8-sig", newline="") as file:
        return list(csv.reader(file))


def _named(path: Path) -> list[dict[str, str]]:
    head, *rows = _rows(path)
    return [dict(zip(head, row, strict=True)) for row in rows]


def _moodle_imports(
    content: bytes, grade: str, identifier: str, feedback: str, separator: str
) -> dict[str, tuple[float | None, str]]:
    """For each participant number, return the grade and the feedback that Moodle would import."""
    text = content.decode().removeprefix("\ufeff")
    head, *rows = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    imported = {}
    for row in rows:
        number = re.search(r"\d+$", row[head.index(identifier)])
        assert number, "Moodle takes the number from the end"
        written = row[head.index(grade)].replace(" ", "").replace(",", ".")
        comment = row[head.index(feedback)] if feedback else ""
        imported[number[0]] = (float(written) if written else None, comment)
    return imported


@pytest.mark.parametrize("zip_file", [False, True], ids=["folder", "zip"])
@pytest.mark.parametrize(
    ("sheet", "maximum", "columns"),
    [
        (ENGLISH, 100, ("Grade", "Identifier", "Feedback comments", ",")),
        (GERMAN, 10, ("Bewertung", "ID", "Feedback als Kommentar", ",")),  # codespell:ignore als
        (FRENCH, 20, ("Note", "Identifiant", "Feedback par commentaires", ";")),
        (SPANISH, 9, ("Calificación", "Identificador", "Comentarios de retroalimentación", ",")),
        (ANONYMOUS, 9, ("Grade", "Identifier", "", ",")),
    ],
    ids=["English", "German", "French", "Spanish", "anonymous"],
)
def test_moodle(
    tmp_path: Path,
    notebook: bytes,
    zip_file: bool,
    sheet: str,
    maximum: int,
    columns: tuple[str, str, str, str],
) -> None:
    """Moodle imports the scaled grades and the feedback for the right participants."""
    name = "Participant" if sheet is ANONYMOUS else "Jane Doe"
    files = {
        f"{name}_101_assignsubmission_file_/{NAMES['05']}": notebook,
        f"Max M\u00fcller_102_assignsubmission_file_/{NAMES['05']}": notebook,
    }
    source = zipped(tmp_path / "in.zip", files) if zip_file else folder(tmp_path / "in", files)
    path = _write(tmp_path / "sheet.csv", sheet)
    out = tmp_path / "out"
    _, found = _graded(source, read_lists(None, path), out)
    content = (out / "moodle_worksheet.csv").read_bytes()
    grade, feedback = _moodle_imports(content, *columns)["101"]
    assert grade == pytest.approx(7 / 9 * maximum, abs=0.005)
    if columns[2]:
        assert feedback.startswith("7 of 9 points.<br>")
        assert HINTS["05.1"] in feedback
    before = _moodle_imports(sheet.encode(), *columns)
    after = _moodle_imports(content, *columns)
    assert after.keys() == before.keys()
    if sheet in (ENGLISH, GERMAN):
        assert after["102"][0] == maximum
    else:
        assert found.unlisted == ("Max Müller_102",)
    assert {key: after[key] for key in after.keys() - {"101", "102"}} == {
        key: before[key] for key in before.keys() - {"101", "102"}
    }
    assert path.read_bytes() == sheet.encode()


def test_moodle_with_a_roster(tmp_path: Path, notebook: bytes) -> None:
    """With a roster, moodle.csv contains user names."""
    source = folder(
        tmp_path / "in",
        {
            f"Group A-Jane Doe_101_assignsubmission_file_/{NAMES['05']}": notebook,
            f"mmueller/{NAMES['05']}": notebook,
            f"Bo Li_104_assignsubmission_file_/{NAMES['05']}": notebook,
        },
    )
    out = tmp_path / "out"
    lists = read_lists(_write(tmp_path / "roster.csv", ROSTER), _write(tmp_path / "sheet.csv", ENGLISH))
    _, found = _graded(source, lists, out)
    rows = {row["full name"]: row for row in _named(out / "moodle.csv")}
    assert rows["Doe, Jane"]["username"] == "jdoe"
    assert rows["Doe, Jane"]["identifier"] == "Participant 101"
    assert (rows["Müller, Max"]["email"], rows["Müller, Max"]["identifier"]) == (
        "max@uni.example",
        "Participant 102",
    )
    imported = _moodle_imports(
        (out / "moodle_worksheet.csv").read_bytes(), "Grade", "Identifier", "Feedback comments", ","
    )
    assert imported["102"][0] == 100
    assert imported["104"] == (10.0, "kept"), "its grade is locked in Moodle"
    assert found.strangers == ("Bo Li_104",)
    assert list(found.summary()) == [
        "Roster: 2 of 3 students handed in their work.",
        "1 handed in nothing: Lee, Ann.",
        "1 is not on the roster: Bo Li_104.",
        "Moodle's worksheet: 2 of 4 participants have a grade in moodle_worksheet.csv; the points are scaled "
        "to Moodle's maximum grade of 100.",
        "1 has a locked grade in Moodle: Bo Li_104.",
    ]


def test_a_worksheet_without_a_maximum_grade_and_without_feedback(tmp_path: Path, notebook: bytes) -> None:
    """The output in the terminal says that the points are not scaled, and how to upload feedback."""
    source = folder(tmp_path / "in", {f"Participant_101_assignsubmission_file_/{NAMES['05']}": notebook})
    lists = read_lists(None, _write(tmp_path / "sheet.csv", ANONYMOUS))
    _, found = _graded(source, lists, tmp_path / "out")
    first, second = found.summary()
    assert first.startswith("Moodle's worksheet: 1 of 1 participants")
    assert "no maximum grade, so the points are not scaled" in first
    assert "switch on the feedback type *Feedback comments*" in second


def test_anonymous_submissions_of_an_instructor_who_sees_names(tmp_path: Path, notebook: bytes) -> None:
    """In a worksheet with anonymous submissions, the participant numbers identify the students."""
    source = folder(tmp_path / "in", {f"Participant_102_assignsubmission_file_/{NAMES['05']}": notebook})
    lists = read_lists(_write(tmp_path / "roster.csv", ROSTER), _write(tmp_path / "sheet.csv", ENGLISH))
    _, found = _graded(source, lists, tmp_path / "out")
    assert found.unclear == {}
    assert found.people["Participant_102"].username == "mmueller"
    [row] = _named(tmp_path / "out/moodle.csv")
    assert (row["full name"], row["identifier"]) == ("Müller, Max", "Participant 102")


def test_a_worksheet_of_another_assignment(tmp_path: Path, notebook: bytes) -> None:
    """If the participant number and the name belong to different students, no grade is written."""
    source = folder(tmp_path / "in", {f"Jo New_101_assignsubmission_file_/{NAMES['05']}": notebook})
    out = tmp_path / "out"
    _, found = _graded(source, read_lists(None, _write(tmp_path / "sheet.csv", ENGLISH)), out)
    assert found.unclear == {
        "Jo New_101": "the student's number is in a row with a different name of Moodle's worksheet (line 2)"
    }
    assert (out / "moodle_worksheet.csv").read_bytes() == ENGLISH.encode()


def _canvas_imports(rows: list[list[str]], users: Mapping[str, tuple[str, str, str]]) -> dict[str, list[str]]:
    """For each Canvas user id, return the cells that Canvas would import.

    `users` maps each Canvas user id to the tuple (SIS user id, login, name).
    """
    head, possible, *students = rows
    assert "Student" in head[0]
    assert "ID" in head[1]
    assert head[2:5] == ["SIS User ID", "SIS Login ID", "Section"]
    assert "Points Possible" in possible[0]
    imported = {}
    for row in students:
        keys = [row[1]] if row[1] in users else []
        for place, value in ((0, row[2]), (1, row[3]), (2, row[0])):
            keys += [key for key, user in users.items() if value and user[place] == value]
        assert keys, "Canvas would ask who this is"
        imported[keys[0]] = row[5:]
    return imported


USERS = {
    "17": ("S17", "jdoe", "Doe, Jane"),
    "18": ("", "mmueller", "Müller, Max"),
    "19": ("S19", "alee", "Lee, Ann"),
}


@pytest.mark.parametrize("roster", [ROSTER, CANVAS_EXPORT], ids=["roster.csv", "exported gradebook"])
def test_canvas(tmp_path: Path, notebook: bytes, roster: str) -> None:
    """Canvas imports the right grade for each user."""
    source = folder(
        tmp_path / "in",
        {
            f"doejane_LATE_17_99_{NAMES['05']}": notebook,
            f"alee/{NAMES['05']}": notebook,
            f"alee/{NAMES['06']}": raw(handed_out("06")),
        },
    )
    out = tmp_path / "out"
    lists = read_lists(_write(tmp_path / "roster.csv", roster), None)
    found = submissions(source)
    grades = [
        Grade(each.student, each.chapter, (report(f"{each.chapter}.1"),), origin=each.origin)
        for each in found
    ]
    class_list = lists.matched(origins_of(found), source)
    write_reports(grades, out, class_list)
    assert [person.id for person in class_list.missing] == ["18"]
    rows = _rows(out / "canvas.csv")
    assert rows[0][5:] == ["Chapter 05", "Chapter 06"]
    assert rows[1][5:] == ["2", "2"]
    assert _canvas_imports(rows, USERS) == {"17": ["2", ""], "19": ["2", "2"]}
    assert _canvas_imports(_rows(out / "canvas/05.csv"), USERS) == {"17": ["2"], "19": ["2"]}
    assert _canvas_imports(_rows(out / "canvas/06.csv"), USERS) == {"19": ["2"]}
    sections = {row[1]: row[4] for row in rows[2:]}
    assert sections == ({"17": "A", "19": "B"} if roster is ROSTER else {"17": "ROS", "19": "ROS"})


def test_canvas_forgets_chapters_of_an_earlier_run(tmp_path: Path) -> None:
    """The run deletes old files for Canvas, because an instructor could import them by mistake."""
    write_reports([Grade("s01", each, (report(f"{each}.1"),)) for each in ("05", "06")], tmp_path)
    write_reports([Grade("s01", "06", (report("06.1"),))], tmp_path)
    assert [path.name for path in (tmp_path / "canvas").iterdir()] == ["06.csv"]


def test_a_student_who_is_unclear_is_in_no_file_of_a_platform(tmp_path: Path) -> None:
    """Students with the same name get no row in the files for platforms."""
    twice = "name,id\nSam Smith,21\nSam Smith,22\nJane Doe,17\n"
    lists = read_lists(_write(tmp_path / "roster.csv", twice), None)
    grades = [Grade(name, "05", (report("05.1"),), origin=f"{name}/05.ipynb") for name in ("Sam Smith", "17")]
    out = tmp_path / "out"
    write_reports(grades, out, lists.matched(origins_of(grades)))
    assert [row[0] for row in _rows(out / "canvas.csv")[2:]] == ["Jane Doe"]
    assert [row[2] for row in _rows(out / "moodle.csv")[1:]] == ["Jane Doe"]
    notes = {row["student"]: row["notes"] for row in _named(out / "grades.csv")}
    assert (
        notes["Sam Smith"]
        == "This student was not identified: several rows fit the student of the roster (lines 2 and 3)."
    )


def test_an_id_that_is_no_number(tmp_path: Path) -> None:
    """An id that is not a Canvas user id is written into the column SIS User ID."""
    lists = read_lists(_write(tmp_path / "roster.csv", "name,id\nJane Doe,S17\n"), None)
    grades = [Grade("Jane Doe", "05", (report("05.1"),), origin="Jane Doe/05.ipynb")]
    write_reports(grades, tmp_path / "out", lists.matched(origins_of(grades)))
    assert _rows(tmp_path / "out" / "canvas.csv")[2] == ["Jane Doe", "", "S17", "", "", "2"]


def test_a_roster_can_do_no_harm(tmp_path: Path) -> None:
    """Markup, formulas and control characters from a roster have no effect in the files."""
    cells = ["<script>alert(1)</script>", "=cmd()", "\x1b[31mred\u202e", "@sum"]
    path = tmp_path / "roster.csv"
    with path.open("w", newline="") as file:
        csv.writer(file).writerows([["name", "id", "username", "section"], cells, ["Jane", "=1+1", "", "-2"]])
    grades = [Grade(name, "05", (report("05.1"),), origin=f"{name}/05.ipynb") for name in ("Jane", "s99")]
    out = tmp_path / "out"
    write_reports(grades, out, read_lists(path, None).matched(origins_of(grades)))
    page = (out / "class.html").read_text()
    assert "<script" not in page
    assert Outline(page).wrong == []
    for table in out.rglob("*.csv"):
        assert not [cell for row in _rows(table) for cell in row if cell.startswith(tuple("=+-@"))], table
        assert "\x1b" not in table.read_text()


@pytest.mark.parametrize("with_roster", [False, True])
def test_gradescope(tmp_path: Path, notebook: bytes, with_roster: bool) -> None:
    """results.json and gradescope.csv contain the students' names and ids."""
    source = folder(
        tmp_path / "in",
        {
            f"assignment_9_export/submission_456/{NAMES['05']}": notebook,
            f"assignment_9_export/submission_457/{NAMES['05']}": notebook,
            "assignment_9_export/submission_metadata.yml": METADATA.encode(),
        },
    )
    out = tmp_path / "out"
    roster = _write(tmp_path / "roster.csv", ROSTER) if with_roster else None
    grades, found = _graded(source, read_lists(roster, None), out)
    assert {grade.student for grade in grades} == {"4711", "max@uni.example", "4799"}
    if with_roster:
        assert found.strangers == ("4799",)
        assert [person.label for person in found.missing] == ["Lee, Ann"]
    table = {row["Email"]: row for row in _named(out / "gradescope.csv")}
    first = table["jane@uni.example"]
    assert list(first)[:9] == [
        *("Name", "SID", "Email", "Sections", "Total Score", "Max Points", "Status", "Submission ID"),
        f"05.1: {GOALS['05.1']} (2 pts)",
    ]
    assert list(first.values())[:9] == (
        ["Doe, Jane", "17", "jane@uni.example", "A", "7", "9", "Graded", "456", "0"]
        if with_roster
        else ["Jane Doe", "4711", "jane@uni.example", "", "7", "9", "Graded", "456", "0"]
    )
    assert table["jo@uni.example"]["Submission ID"] == "457"
    if with_roster:
        assert table["ann@uni.example"]["Status"] == "Missing"
    results = json.loads((out / "gradescope/4711/results.json").read_text())
    assert results["score"] == sum(test["score"] for test in results["tests"]) == 7
    assert results["extra_data"]["email"] == "jane@uni.example"
    assert results["extra_data"]["submission_id"] == "456"


def test_who_is_missing_is_in_the_table_and_on_the_page(tmp_path: Path, notebook: bytes) -> None:
    """grades.csv contains all students of the roster, and class.html lists missing students."""
    source = folder(tmp_path / "in", {f"{name}/{NAMES['05']}": notebook for name in ("jdoe", "s99")})
    out = tmp_path / "out"
    _graded(source, read_lists(_write(tmp_path / "roster.csv", ROSTER), None), out)
    rows = {row["student"]: row for row in _named(out / "grades.csv")}
    assert list(rows) == ["jdoe", "s99", "Müller, Max", "Lee, Ann"]
    assert (rows["jdoe"]["name"], rows["jdoe"]["id"], rows["jdoe"]["earned"]) == ("Doe, Jane", "17", "7")
    assert (rows["s99"]["name"], rows["s99"]["earned"]) == ("", "9")
    assert "This student is not on the roster." in rows["s99"]["notes"]
    missing = rows["Lee, Ann"]
    assert (missing["section"], missing["05.1"], missing["earned"], missing["possible"]) == (
        "B",
        "",
        "0",
        "9",
    )
    assert missing["notes"] == "This student is on the roster, but handed in nothing."
    page = (out / "class.html").read_text()
    assert "1 of 3 students on the roster handed in their work." in page
    assert re.search(r"Lee, Ann</th>.*ann@uni\.example.*handed in nothing", page)
    assert re.search(r"feedback/s99\.html.*is not on the roster\.", page)
