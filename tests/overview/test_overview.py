"""Tests of the overview of a student's progress."""

from __future__ import annotations

import csv
import json
import re
from html.parser import HTMLParser
from io import StringIO
from pathlib import Path

import pytest

from course_pkg import predictions, progress
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.checking.parts import chapters, notebook_of, parts_of, title_of
from course_pkg.checking.record import StudentRecord
from course_pkg.errors import UnknownCheck
from course_pkg.overview.page import page
from course_pkg.overview.table import table
from course_pkg.panels.choices.model import ChoicesModel, ChoiceStore
from course_pkg.panels.prediction.model import PredictionModel, PredictionStore
from course_pkg.panels.prediction.view import Predictions
from tests.setup.test_course import course


@pytest.fixture
def state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Create an empty state folder, and return its path."""
    monkeypatch.setenv("COURSE_STATE", str(tmp_path / "state"))
    return tmp_path / "state"


def store(verdict: str, *checks: str) -> None:
    """Store the same result for each of the given checks."""
    for check in checks:
        StudentRecord().store(check, {"check": check, "verdict": verdict})


def complete(chapter: str) -> None:
    """Store the result "passed" for each part of a chapter."""
    store("passed", *(part.check for part in parts_of(chapter)))


def predicted(key: str, answer: str, actual: str) -> None:
    """Store a prediction: the reader's answer, and the actual result."""
    model = PredictionModel(key, "What does the client see?", (), PredictionStore())
    model.answer(answer)
    model.compare(actual)


@pytest.mark.usefixtures("state")
def test_at_the_beginning_the_first_chapter_is_next() -> None:
    """Without any records, the next step is chapter 00."""
    text = str(progress())
    assert text.startswith("Your progress: 0 of ")
    assert [number for number in chapters() if f"\n  {number}  {title_of(number)}" not in text] == []
    assert "Next: Begin with chapter 00, Start the graph\n      in 00_start_the_graph.ipynb" in text
    assert "It is not a grade." in text


@pytest.mark.usefixtures("state")
def test_fulfilled_goals_are_counted() -> None:
    """If a part has not passed, the overview shows the points that the last check gave."""
    StudentRecord().store("05.3", {"check": "05.3", "verdict": "not yet", "points": 1.5})
    shown = progress("05")
    assert str(shown).startswith("Chapter 05, Write a server: 0 of 5 parts passed, 1.5 of 11 points")
    assert "1.5 of 2" in shown._repr_mimebundle_()["text/html"]


@pytest.mark.usefixtures("state")
def test_parts_points_and_predictions_are_counted() -> None:
    """The overview counts passed parts, points and predictions.

    A prediction without an answer, such as 05.late, does not count.
    """
    store("passed", "05.1", "05.2")
    store("not yet", "05.2", "05.3")
    predicted("05.none", "an error", "an error")
    predicted("05.many", "two", "one")
    predicted("05.late", "", "one")
    choices = ChoicesModel("05.cases", "?", ["a", "b"], [("x", "a", "."), ("y", "b", ".")], ChoiceStore())
    choices.choose(0, "a")
    choices.choose(1, "a")
    choices.compare()
    first, *lines = str(progress("05")).splitlines()
    assert first == (
        "Chapter 05, Write a server: 2 of 5 parts passed, 4 of 11 points, 1 of 2 predictions right, "
        "1 of 2 choices right"
    )
    marks = [line.split()[:3] for line in lines if re.match(r"  . 05\.", line)]
    assert marks == [
        ["✓", "05.1", "passed"],
        ["✓", "05.2", "passed"],
        ["✗", "05.3", "not"],
        ["·", "05.4", "not"],
        ["·", "05.5", "not"],
    ]
    assert "Next: 05.3: " in "\n".join(lines)
    row = next(line for line in str(progress()).splitlines() if line.startswith("  05  "))
    assert row.split("  ")[-1] == "1 of 2, 1 of 2 choices"
    assert "✓✓✗··" in row


@pytest.mark.usefixtures("state")
def test_after_a_complete_chapter_each_path_has_its_next_chapter() -> None:
    """The next steps contain only chapters that are not complete."""
    complete("00")
    text = " ".join(str(progress()).split())
    assert "Next: Chapter 01, Name things and find them (path: the whole course)" in text
    assert "or: Chapter 02, Stream data with a topic (path: the turtle tutorial)" in text
    assert "or: Chapter 05, Write a server (path: the lab session)" in text
    complete("01")
    text = " ".join(str(progress("01")).split())
    assert "Next: Chapter 02, Stream data with a topic (path: the whole course) in" in text
    assert "lab session" not in text


@pytest.mark.usefixtures("state")
def test_at_the_end_there_is_nothing_left() -> None:
    """If all parts have passed, the overview contains no next step."""
    for number in chapters():
        complete(number)
    assert "Next: You have passed all parts of the course." in str(progress())


@pytest.mark.usefixtures("state")
def test_an_unknown_chapter_is_refused() -> None:
    """The error message for an unknown chapter contains the first and the last chapter number."""
    with pytest.raises(UnknownCheck, match=r"no chapter '99'. Give a number from 00 to 16"):
        progress("99")
    assert str(progress("5")) == str(progress("05"))


def test_damaged_records_are_reported_and_the_others_are_shown(state: Path) -> None:
    """The overview reports each damaged record and shows all other records."""
    store("passed", "05.1", "05.2")
    (state / "results-2" / "05.2.json").write_text("{")
    (state / "predictions-2.json").write_text('{"05.none": {"key": 5, "question": null}}')
    (state / "choices-2.json").write_text("[]")
    overview = progress("05")
    assert "1 of 5 parts passed" in str(overview)
    assert str(overview).count("Problem: ") == 3
    html = overview._repr_mimebundle_()["text/html"]
    assert (
        html.count("class='course-problem'") == page(overview.progress).count("class='course-problem'") == 3
    )
    assert "predictions-2.json" in html


@pytest.mark.usefixtures("state")
def test_stored_text_cannot_become_markup_or_a_formula() -> None:
    """A changed record cannot add a script to the page or a formula to the table."""
    StudentRecord().store("05.1", {"check": "05.1", "verdict": "<script>alert(1)</script>"})
    PredictionModel("05.x", "=1+<script>", (), PredictionStore()).answer("yes")
    overview = progress("05")
    for html in (overview._repr_mimebundle_()["text/html"], page(overview.progress)):
        assert "<script" not in html
    assert [row["text"] for row in rows(table(overview.progress)) if row["kind"] == "prediction"] == [
        "'=1+<script>"
    ]


def rows(text: str) -> list[dict[str, str]]:
    """Return the rows of a CSV table."""
    return list(csv.DictReader(StringIO(text)))


@pytest.mark.usefixtures("state")
def test_the_table_has_a_row_for_each_part_and_prediction() -> None:
    """The table contains every part of the course with its result and times."""
    store("passed", "05.1")
    store("not yet", "05.1")
    predicted("05.none", "two", "one")
    found = rows(table(progress().progress))
    assert len(found) == sum(len(parts_of(number)) for number in chapters()) + 1
    part = next(row for row in found if row["id"] == "05.1")
    assert (part["state"], part["points"], part["possible"], part["checks"]) == ("passed", "2", "2", "2")
    assert part["last_result"] == "not yet"
    assert part["first_passed"] <= part["last_time"]
    assert found[-1]["chapter"] == "16"
    assert next(row for row in found if row["kind"] == "prediction")["state"] == "wrong"


class Tags(HTMLParser):
    """Collects the tags of a page. Asserts that the tags of the page are closed in the right order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Add a tag to the list of open tags."""
        self.found.append((tag, dict(attrs)))
        if tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        """Assert that the tag closes the last open tag."""
        assert self.open.pop() == tag


@pytest.mark.usefixtures("state")
def test_the_page_needs_no_other_files() -> None:
    """The page contains a style sheet, but no scripts, links or pictures."""
    store("passed", "05.1")
    tags = Tags(page(progress().progress)).found
    names = {name for name, _ in tags}
    assert not names & {"script", "link", "img", "iframe"}
    assert [attributes for _, attributes in tags if {"href", "src"} & attributes.keys()] == []
    assert sum(name == "h2" for name, _ in tags) == len(chapters())


@pytest.mark.usefixtures("state")
def test_a_notebook_gets_text_and_html_with_links_to_the_chapters() -> None:
    """The overview in the output of a cell contains a link to each notebook."""
    bundle = progress()._repr_mimebundle_()
    assert bundle["text/plain"] == str(progress())
    links = {attributes["href"] for name, attributes in Tags(bundle["text/html"]).found if name == "a"}
    assert links == {notebook_of(number) for number in chapters()}


@pytest.mark.usefixtures("state")
def test_the_table_of_predictions_shows_the_progress_in_its_chapter() -> None:
    """The panel shows the progress in the chapter, but its plain text is the same for every student."""
    before = repr(predictions("05"))
    store("passed", "05.1")
    store("not yet", "05.2")
    panel = predictions("05")
    assert panel.row["text"] == "Chapter 05, Write a server: 1 of 5 parts passed, 2 of 11 points"
    assert [part["mark"] for part in panel.row["parts"]] == ["✓", "✗", "·", "·", "·"]
    assert panel.row["next"].startswith("Next: 05.2: ")
    assert repr(panel) == before == panel._repr_mimebundle_()[0]["text/plain"] == "predictions('05')"
    assert predictions().row == {}


def test_the_table_of_predictions_works_with_damaged_records(state: Path) -> None:
    """With a damaged record, the table shows a message, and the cell raises no error."""
    store("passed", "05.1")
    (state / "results-2" / "05.1.json").write_text("{")
    assert "05.1" in predictions("05").row["problems"][0]


@pytest.mark.usefixtures("state")
def test_without_checks_the_table_of_predictions_shows_no_progress() -> None:
    """If the checks are not available, the table shows only the predictions."""
    panel = predictions("77")
    assert isinstance(panel, Predictions)
    assert panel.row == {}


@pytest.mark.parametrize("path", NotebookStore().solutions(), ids=lambda path: path.stem)
def test_a_chapter_has_the_title_and_the_name_of_its_notebook(path: Path) -> None:
    """For each chapter, the package and the notebook contain the same title and file name."""
    first = read(path)["cells"][0]["source"].splitlines()[0]
    assert first == f"# {title_of(path.name[:2])}"
    assert notebook_of(path.name[:2]) == path.name


def test_the_command_prints_and_exports(state: Path, tmp_path: Path) -> None:
    """`course progress` prints the overview, and the options --csv and --html write the overview to files."""
    store("passed", "05.1")
    shown = course("progress", "05", COURSE_STATE=str(state))
    assert (shown.returncode, shown.stderr) == (0, "")
    assert shown.stdout == f"{progress('05')}\n"
    names = [str(tmp_path / "mine.csv"), str(tmp_path / "mine.html")]
    written = course("progress", "--csv", names[0], "--html", names[1], COURSE_STATE=str(state))
    assert written.stdout.split() == names, written.stderr
    assert len(rows(Path(names[0]).read_text())) > 50
    assert Path(names[1]).read_text().startswith("<!doctype html>")


def test_errors_of_the_command_are_one_line(state: Path, tmp_path: Path) -> None:
    """If a chapter is unknown or a file cannot be written, the error message is one line with the name."""
    refused = course("progress", "--csv", str(tmp_path), COURSE_STATE=str(state))
    assert refused.returncode == 1
    assert refused.stderr.startswith(f"course: {tmp_path} cannot be written")
    assert refused.stderr.count("\n") == 1
    assert "There is no chapter '99'" in course("progress", "99", COURSE_STATE=str(state)).stderr


def test_two_kernels_lose_no_prediction(state: Path) -> None:
    """If two kernels store one prediction each, the file of predictions contains both predictions."""
    one, other = PredictionStore(), PredictionStore()
    PredictionModel("05.a", "?", (), one).answer("yes")
    PredictionModel("05.b", "?", (), other).answer("no")
    assert sorted(json.loads((state / "predictions-2.json").read_text())) == ["05.a", "05.b"]
