"""Tests of the contents of all reports."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Iterator
from dataclasses import replace
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest

from course_pkg.checking.report import Verdict
from course_pkg.errors import GradingError
from course_pkg.grading.grade import CellOutcome, Grade
from course_pkg.grading.reports import read_grades, record_path, write_record, write_reports
from course_pkg.grading.reports.asked import Asked, Column
from course_pkg.grading.reports.gradebook import WITHOUT_SANDBOX, Book, attention
from tests.grading.grades import HINTS, NASTY, class_of, nasty, refused, report

OPEN = {"meta", "br", "rect", "img", "link", "input", "hr"}  # These tags have no end tag.


class Outline(HTMLParser):
    """Collects the tags of a page. Asserts that each end tag closes the last open tag."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text: list[str] = []
        self.wrong: list[str] = []
        self._open: list[str] = []
        self.feed(page)
        self.close()
        self.wrong += self._open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Store a tag."""
        self.tags.append((tag, dict(attrs)))
        if tag not in OPEN:
            self._open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Store a tag without an end tag."""
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        """Assert that this end tag closes the last open tag."""
        if not self._open or self._open.pop() != tag:
            self.wrong.append(tag)

    def handle_data(self, data: str) -> None:
        """Store the text."""
        self.text.append(data)

    def all(self, *names: str) -> list[dict[str, str | None]]:
        """Return the attributes of all tags with these names."""
        return [attributes for tag, attributes in self.tags if tag in names]


def _rows(path: Path) -> list[list[str]]:
    with path.open(encoding="utf-8-sig", newline="") as file:
        return list(csv.reader(file))


def _files(out: Path) -> Iterator[Path]:
    yield from (path for path in sorted(out.rglob("*")) if path.is_file())


def _two() -> list[Grade]:
    """Return the grades of two students.

    The first student submits late and earns all points. The second student's parts have all possible
    verdicts.
    """
    verdicts = (Verdict.PASSED, Verdict.FAILED, Verdict.NOT_ATTEMPTED, Verdict.UNDECIDED, Verdict.PASSED)
    mixed = tuple(report(f"05.{number}", verdict) for number, verdict in enumerate(verdicts, 1))
    full = tuple(report(f"05.{number}") for number in range(1, 6))
    other = tuple(report(f"06.{number}") for number in range(1, 3))
    return [
        Grade("s01", "05", full, late=1.0, factor=0.9),
        Grade("s01", "06", other),
        Grade("s02", "05", mixed, notes=("05.1: split.",)),
    ]


def test_the_table(tmp_path: Path) -> None:
    """The table has a row for each student and a column for each part."""
    write_reports(_two(), tmp_path)
    head, first, second = _rows(tmp_path / "grades.csv")
    five = ["05.1", "05.2", "05.3", "05.4", "05.5", "05 days late", "05 total"]
    assert head == [
        "student",
        *five,
        "06.1",
        "06.2",
        "06 days late",
        "06 total",
        "earned",
        "possible",
        "notes",
        "flags",
    ]
    assert first[:-2] == ["s01", "2", "2", "2", "2", "1", "1", "8.1", "2", "2", "0", "4", "12.1", "13"]
    assert second[:-2] == ["s02", "2", "0", "0", "0", "1", "0", "3", "", "", "", "", "3", "13"]
    assert "90%" in first[-2]
    for words in ("05.4 not examined", "05.1: split.", "Nothing was handed in for chapter 06."):
        assert words in second[-2]


def test_the_records(tmp_path: Path) -> None:
    """Each record contains the whole grade of a student."""
    grades = [*_two(), refused("s03", "", "x.pdf is no notebook."), refused("s03", "06")]
    write_reports(grades, tmp_path)
    assert read_grades(tmp_path) == sorted(grades, key=lambda grade: (grade.student, grade.chapter))
    assert (tmp_path / "results/s01/05.json").exists()
    assert record_path(tmp_path, "s01", "05") == tmp_path / "results/s01/05.json"


def test_reports_from_records(tmp_path: Path) -> None:
    """Reports can be written from the records of a killed run."""
    for grade in class_of(3):
        write_record(tmp_path, grade)
    write_reports(read_grades(tmp_path), tmp_path)
    assert len(_rows(tmp_path / "grades.csv")) == 4


@pytest.mark.parametrize("content", ["{", "[]", '{"student": "s01"}', '"x"'])
def test_invalid_record(tmp_path: Path, content: str) -> None:
    """If a record is invalid, the error message contains the file name, but not the student's name."""
    path = record_path(tmp_path, "s01", "05")
    path.parent.mkdir(parents=True)
    path.write_text(content)
    with pytest.raises(GradingError, match=r"record 1 of 1 \(05\.json\)") as caught:
        read_grades(tmp_path)
    assert "s01" not in str(caught.value)


def test_gradescope(tmp_path: Path) -> None:
    """The file results.json has the format that Gradescope imports."""
    write_reports(_two(), tmp_path)
    results = json.loads((tmp_path / "gradescope/s01/results.json").read_text())
    assert results["score"] == 12.1
    assert "90%" in results["output"]
    assert [(test["number"], test["score"], test["max_score"]) for test in results["tests"]][4:6] == [
        ("05.5", 1, 1),
        ("06.1", 2, 2),
    ]
    tests = json.loads((tmp_path / "gradescope/s02/results.json").read_text())["tests"]
    assert [test["status"] for test in tests] == ["passed", "failed", "failed", "failed", "passed"]
    assert HINTS["05.2"] in " ".join(tests[1]["output"].split())
    for test in tests:
        assert (test["output_format"], test["visibility"]) == ("text", "visible")


def test_canvas(tmp_path: Path) -> None:
    """The file canvas.csv has Canvas's format, and the cell of a missing submission is empty."""
    canvas = replace(
        _two()[0], student="lastfirst_4711", origin="lastfirst_LATE_4711_99_05_write_a_server.ipynb"
    )
    grades = [*_two(), canvas, replace(_two()[2], student="s_17", origin="s_17/05_write_a_server.ipynb")]
    write_reports(grades, tmp_path)
    assert _rows(tmp_path / "canvas.csv") == [
        ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Chapter 05", "Chapter 06"],
        ["    Points Possible", "", "", "", "", "9", "4"],
        ["lastfirst", "4711", "", "", "", "8.1", ""],
        ["s01", "", "", "s01", "", "8.1", "4"],
        ["s02", "", "", "s02", "", "3", ""],
        ["s_17", "", "", "s_17", "", "3", ""],
    ]


def test_moodle(tmp_path: Path) -> None:
    """The file moodle.csv has Moodle's format; a user name, an address or a name identifies a student."""
    five = _two()[2]
    moodle = replace(five, student="Full Name_12", origin="Full Name_12_assignsubmission_file_/05.ipynb")
    write_reports([five, replace(five, student="a@b.example"), moodle], tmp_path)
    head, full, address, user = _rows(tmp_path / "moodle.csv")
    assert head == ["username", "email", "full name", "identifier", "Chapter 05", "Chapter 05 feedback"]
    assert full[:5] == ["", "", "Full Name", "Participant 12", "3"]
    assert address[:5] == ["", "a@b.example", "", "", "3"]
    assert user[:5] == ["s02", "", "", "", "3"]
    assert HINTS["05.2"] in user[5]


def test_junit(tmp_path: Path) -> None:
    """A part that was not examined is an error in the JUnit file."""
    write_reports([*_two(), refused("s03", "")], tmp_path)
    root = ElementTree.parse(tmp_path / "junit.xml").getroot()  # noqa: S314 -- our own file
    assert {key: root.get(key) for key in ("tests", "failures", "errors")} == {
        "tests": "13",
        "failures": "2",
        "errors": "2",
    }
    assert [suite.get("name") for suite in root] == [
        "s01 chapter 05",
        "s01 chapter 06",
        "s02 chapter 05",
        "s03 chapter ?",
    ]
    assert HINTS["05.2"] in " ".join("".join(root.itertext()).split())


def test_feedback_teaches(tmp_path: Path) -> None:
    """The feedback page shows the assertion, the inputs, the expected and the actual value, and the hint."""
    write_reports(_two(), tmp_path)
    page = " ".join("".join(Outline((tmp_path / "feedback/s02.html").read_text()).text).split())
    for words in (
        "3 of 9 points",
        "area is width times length",
        "5.25",
        HINTS["05.2"],
        "05.1: split.",
        "more than 512 MB",
    ):
        assert words in page
    assert "12.1 of 13 points" in (tmp_path / "feedback/s01.html").read_text()


def test_the_class_page(tmp_path: Path) -> None:
    """The class page shows the results of each part, and the students who need help."""
    write_reports([*class_of(30), refused("s31")], tmp_path)
    outline = Outline((tmp_path / "class.html").read_text())
    page = " ".join("".join(outline.text).split())
    labels = [svg["aria-label"] for svg in outline.all("svg")]
    assert len(labels) == 5
    for label in labels:
        assert sum(int(number) for number in re.findall(r"(\d+) (?:passed|not)", str(label))) == 31
    counts = [int(number) for number in re.findall(r"\. (\d+) (?=05\.)", page)]
    assert counts == sorted(counts, reverse=True)
    assert "05_write_a_server.ipynb was not graded" in page
    assert "feedback/s31.html" in [link["href"] for link in outline.all("a")]


def test_what_was_asked_for_counts_as_possible(tmp_path: Path) -> None:
    """A student's total of possible points includes a chapter that the student did not hand in."""
    five, six = (Grade("s01", each, (report(f"{each}.1"),)) for each in ("05", "06"))
    gone = replace(five, student="s03", absent=True)
    asked = Asked(
        frozenset({"05", "06", "07"}),
        (Column("07.1", "07", "", 3), Column("08.1", "08", "", 5)),
        lambda student, chapter: chapter != "08" or student == "s04",
    )
    grades = [five, six, replace(five, student="s02"), gone, replace(five, student="s04")]
    write_reports(grades, tmp_path, asked=asked)
    head, *rows = _rows(tmp_path / "grades.csv")
    possible = {row[0]: row[head.index("possible")] for row in rows}
    assert possible == {"s01": "7", "s02": "7", "s03": "2", "s04": "12"}
    page = (tmp_path / "feedback" / "s02.html").read_text()
    assert "2 of 7 points" in page
    assert "Nothing was handed in for chapters 06, 07." in page
    assert "06" not in (tmp_path / "feedback" / "s03.html").read_text()
    assert "Chapter 07" not in (tmp_path / "canvas.csv").read_text()


def test_a_hint_counts_once_for_a_student(tmp_path: Path) -> None:
    """The same hint is counted only once for a student."""
    failed = report("05.1", Verdict.FAILED)
    twice = replace(failed, assertions=(*failed.assertions, failed.assertions[-1]))
    write_reports([Grade("s01", "05", (twice,)), Grade("s02", "05", (failed,))], tmp_path)
    page = (tmp_path / "class.html").read_text()
    assert re.search(rf"{re.escape(HINTS['05.1'])}</td><td class=\"number\">2<", page)


def test_failed_assertion_without_a_hint_is_counted(tmp_path: Path) -> None:
    """The class page also lists failed assertions that have no hint."""
    failed = report("05.1", Verdict.FAILED)
    plain = replace(failed, assertions=tuple(replace(rule, hint="") for rule in failed.assertions))
    write_reports([Grade("s01", "05", (plain,))], tmp_path)
    assert "(no hint) area is width times length" in (tmp_path / "class.html").read_text()


def test_empty_class_and_files_without_a_student(tmp_path: Path) -> None:
    """Reports can be written for an empty class, and for files without a student."""
    write_reports([], tmp_path)
    assert "nothing to show" in (tmp_path / "class.html").read_text()
    write_reports([refused("", "", "x.ipynb: its student is unknown it is.")], tmp_path)
    assert "(nobody)" in (tmp_path / "class.html").read_text()
    assert "its student is unknown" in (tmp_path / "feedback/nobody.html").read_text()
    assert len(_rows(tmp_path / "canvas.csv")) == 2


def test_students_who_need_attention() -> None:
    """A student with a problem or without points needs help; a student who is only late does not."""
    empty = Grade("s05", "05", (report("05.1", Verdict.FAILED),))
    book = Book([*_two(), refused("s03"), refused("s04", "06"), empty])
    assert attention(book, "s01") == []
    assert attention(book, "s02")[0].startswith("05.4 not examined: The kernel ended")
    assert attention(book, "s03")[0].startswith("05_write_a_server.ipynb was not graded")
    assert "The student has 0 points in chapter 05." in attention(book, "s05")


def test_without_walls_every_report_says_so(tmp_path: Path) -> None:
    """Without a sandbox, each report contains one warning, even if the reports are written again."""
    write_reports([replace(grade, sandboxed=False) for grade in class_of(2)], tmp_path)
    for path in _files(tmp_path):
        assert "without a sandbox" in path.read_text(), path
    assert WITHOUT_SANDBOX in read_grades(tmp_path)[0].notes
    write_reports(read_grades(tmp_path), tmp_path)
    assert read_grades(tmp_path)[0].notes.count(WITHOUT_SANDBOX) == 1


def test_feedback_shows_the_code_and_sentences_about_cells(tmp_path: Path) -> None:
    """The feedback page shows the student's code, and a sentence for each cell with a different output."""
    raised = CellOutcome("c7", "failed", "The cell raised NameError: name 'x' is not defined", "print(x)")
    write_reports(
        [Grade("s01", "05", (report("05.1"),), cells=(raised,), code={"05.1": "if a < b:\n    pass"})],
        tmp_path,
    )
    page = (tmp_path / "feedback/s01.html").read_text()
    assert "<pre>if a &lt; b:\n    pass</pre>" in page
    assert "print(x)" in page
    assert "The cell raised NameError" in page


def test_private_parts_stay_private(tmp_path: Path) -> None:
    """Only the instructor's page shows the details of a private check."""
    secret = report("05.1", Verdict.FAILED, goal="secret goal", note="secret note", printed="secret print")
    secret = replace(
        secret,
        assertions=tuple(replace(rule, text="secret rule", hint="secret hint") for rule in secret.assertions),
    )
    write_reports([Grade("s01", "05", (secret,), private=("05.1",), code={"05.1": "secret"})], tmp_path)
    for name in ("feedback/s01.html", "gradescope/s01/results.json", "moodle.csv", "canvas.csv"):
        assert "secret" not in (tmp_path / name).read_text()
    for name in ("class.html", "junit.xml", "results/s01/05.json"):
        assert "secret" in (tmp_path / name).read_text()


def test_nothing_harmful_in_any_report(tmp_path: Path) -> None:
    """Reports contain no control characters, markup or formulas from a submission."""
    out = tmp_path / "deep" / "out"
    write_reports([nasty(), nasty("=cmd()"), nasty("CON"), nasty("con"), nasty("s01")], out)
    assert [path.name for path in tmp_path.iterdir()] == ["deep"]
    assert [path.name for path in (tmp_path / "deep").iterdir()] == ["out"]
    assert len(list((out / "results").iterdir())) == 5
    for path in _files(out):
        content = path.read_bytes().decode("utf-8-sig")
        assert not re.search("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u202a-\u202e\ufffe]", content), path
        if path.suffix == ".json":
            assert "\\u001b" not in content
            assert "\\ud800" not in content
            json.loads(content)
        if path.suffix == ".csv":
            assert not [cell for row in _rows(path) for cell in row if cell.startswith(tuple("=+-@\t\r"))], (
                path
            )
        if path.suffix == ".html":
            assert "<script" not in content
    ElementTree.parse(out / "junit.xml")  # noqa: S314 -- our own file


def test_similar_names_have_different_files(tmp_path: Path) -> None:
    """Students with similar names have different files, even if the file system ignores case."""
    names = ["s01", "S01", "s01 ", "s-01", "../s01", "s01/", "Ś01"]
    write_reports([replace(class_of(1)[0], student=name) for name in names], tmp_path)
    for folder in ("results", "feedback", "gradescope"):
        assert len({path.name.lower() for path in (tmp_path / folder).iterdir()}) == len(names)


def _pages(out: Path) -> list[str]:
    write_reports([*class_of(12, ("05", "06")), refused("s31"), nasty()], out)
    return [path.read_text() for path in _files(out) if path.suffix == ".html"]


def test_pages_stand_alone(tmp_path: Path) -> None:
    """A page contains no scripts and loads no other files."""
    for page in _pages(tmp_path):
        outline = Outline(page)
        names = {tag for tag, _ in outline.tags}
        assert not names & {"script", "link", "iframe", "img", "object", "embed", "form", "base"}
        for _, attributes in outline.tags:
            assert not [key for key in attributes if key == "style" or key.startswith("on") or key == "src"]
            assert not re.match(r"\w+:|//", attributes.get("href") or "")
        [policy] = [str(each["content"]) for each in outline.all("meta") if each.get("http-equiv")]
        assert policy.startswith("default-src 'none'; style-src 'sha256-")
        assert "unsafe" not in policy


def test_pages_can_be_read_by_everybody(tmp_path: Path) -> None:
    """The page's structure is accessible: language, title, headings, table headers and labels."""
    for page in _pages(tmp_path):
        outline = Outline(page)
        assert outline.wrong == []
        assert outline.all("html")[0]["lang"] == "en"
        assert len(outline.all("main")) == len(outline.all("title")) == len(outline.all("h1")) == 1
        levels = [int(tag[1]) for tag, _ in outline.tags if re.fullmatch(r"h[1-6]", tag)]
        assert levels[0] == 1
        assert all(after <= before + 1 for before, after in pairwise(levels))
        assert all(cell.get("scope") for cell in outline.all("th"))
        assert all(svg["role"] == "img" and svg["aria-label"] for svg in outline.all("svg"))
        assert len(outline.all("caption")) == len(outline.all("table"))
        assert "width=device-width" in page


def test_reports_print_and_log_nothing(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture
) -> None:
    """Writing reports prints nothing and logs nothing."""
    write_reports([*class_of(3), nasty()], tmp_path)
    assert capfd.readouterr() == ("", "")
    assert caplog.records == []


def test_a_folder_that_cannot_be_written(tmp_path: Path) -> None:
    """If a report cannot be written, the error message contains the name of the report."""
    (tmp_path / "out").write_text("")
    with pytest.raises(GradingError, match="No grade is lost"):
        write_reports(class_of(1), tmp_path / "out")


def test_long_texts_are_cut(tmp_path: Path) -> None:
    """The reports shorten long texts from a submission."""
    flood = report("05.1", Verdict.FAILED, printed=NASTY * 100_000, note="x" * 1_000_000)
    write_reports([Grade("s01", "05", (flood,), notes=("y" * 1_000_000,))], tmp_path)
    assert max(path.stat().st_size for path in _files(tmp_path)) < 60_000
