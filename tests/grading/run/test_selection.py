"""Tests of the options --student, --part and --chapters."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from course_pkg.checking.report import Verdict
from course_pkg.errors import CourseError, GradingError
from course_pkg.grading.grade import IN_PACKAGES, Grade, Submission
from course_pkg.grading.reports import write_reports
from course_pkg.grading.run.earlier import Earlier, read_earlier
from course_pkg.grading.run.regrade import Regrade
from course_pkg.grading.run.selection import Selection, merged, selection
from course_pkg.grading.store import Store
from tests.grading.grades import class_of, refused, report

SUBMISSIONS = [
    Submission("s01", "05", b"", "s01/05.ipynb"),
    Submission("s01", "06", b"", "s01/06.ipynb"),
    Submission("A One_17", "05", b"", "A One_17_assignsubmission_file_/05.ipynb"),
    Submission("A One_18", "05", b"", "A One_18_assignsubmission_file_/05.ipynb"),
    Submission("A Two_19", "", b"", "A Two_19_assignsubmission_file_/x.pdf", problem="no"),
]


def _chosen(selected: Selection) -> list[tuple[str, str]]:
    return [(each.student, each.chapter) for each in selected.for_students(SUBMISSIONS).of(SUBMISSIONS)]


def test_nothing_selects_everything() -> None:
    """Without an option, `course grade` grades all submissions."""
    selected = selection((), (), ())
    assert _chosen(selected) == [(each.student, each.chapter) for each in SUBMISSIONS]
    assert selected.everything
    assert not selected.again


def test_a_chapter_and_files_without_a_chapter() -> None:
    """With --chapters, the run also includes the files of an unknown chapter."""
    assert ("A Two_19", "") in _chosen(selection((), ("05",), ()))
    assert ("s01", "06") not in _chosen(selection((), ("05",), ()))


@pytest.mark.parametrize("name", ["s01", "S01"])
def test_a_student_in_any_case(name: str) -> None:
    """`--student` accepts a student's name in upper or lower case."""
    assert _chosen(selection([name], (), ())) == [("s01", "05"), ("s01", "06")]


def test_a_student_without_the_number_of_the_platform() -> None:
    """An instructor can select a student by name, without the number that the platform adds to the name."""
    assert _chosen(selection(["a two"], (), ())) == [("A Two_19", "")]


@pytest.mark.parametrize(
    ("name", "said"), [("A One", "fits 2 students"), ("s99", "is not the name of a student")]
)
def test_a_name_that_does_not_fit_one_student(name: str, said: str) -> None:
    """If a name does not select one student, the error message names grades.csv, but no other student."""
    with pytest.raises(GradingError, match=rf"--student {name} .*{said}.*grades\.csv") as caught:
        selection([name], (), ()).for_students(SUBMISSIONS)
    assert "s01" not in str(caught.value)


def test_a_part_selects_its_chapter() -> None:
    """In the id of a part, the chapter number can have one digit."""
    selected = selection((), (), ["5.2"])
    assert (selected.chapters, selected.parts_of("05"), selected.parts_of("06")) == (("05",), ("05.2",), ())
    assert selected.again


@pytest.mark.parametrize(
    ("chapters", "part", "said"), [((), "05.99", "05.99"), (("06",), "05.1", "--part 05.1 is not in")]
)
def test_a_part_that_cannot_be_selected(chapters: tuple[str, ...], part: str, said: str) -> None:
    """An unknown part, or a part of an unselected chapter, is an error."""
    with pytest.raises(CourseError, match=said):
        selection((), chapters, [part])


def _grade(*verdicts: Verdict, **more: object) -> Grade:
    reports = tuple(report(f"05.{number}", verdict) for number, verdict in enumerate(verdicts, 1))
    return replace(Grade("s01", "05", reports, key="k"), **more)  # type: ignore[arg-type]


def test_the_other_parts_keep_their_results() -> None:
    """Only the selected parts get a new result."""
    base = _grade(Verdict.PASSED, Verdict.FAILED, notes=(f"{IN_PACKAGES}: 05.1.", "old"), absent=True)
    again = replace(base, reports=(report("05.3"), report("05.2")), notes=("new",), late=1.0)
    both = merged(base, again)
    assert [(each.check, each.verdict) for each in both.reports] == [
        ("05.1", Verdict.PASSED),
        ("05.2", Verdict.PASSED),
        ("05.3", Verdict.PASSED),
    ]
    assert (both.notes, both.late, both.absent, both.key) == (
        (f"{IN_PACKAGES}: 05.1.", "new"),
        1.0,
        False,
        "k",
    )


def test_parts_of_two_versions_have_no_key() -> None:
    """If two versions of the checks have graded parts of one submission, the grade has an empty key."""
    base = _grade(Verdict.PASSED, Verdict.FAILED)
    assert merged(base, replace(base, key="other")).key == ""


def test_a_part_alone_is_graded_only_for_the_same_notebook() -> None:
    """If the notebook has changed or has no earlier grade, --part grades all parts of the notebook."""
    submission = SUBMISSIONS[0]
    known = _grade(Verdict.PASSED, handed_in=submission.digest)
    selected = selection((), (), ["05.2"])
    assert Regrade(selected, Earlier(Path(), (known,))).parts(submission) == ("05.2",)
    assert Regrade(selected, Earlier(Path(), ())).parts(submission) == ()
    changed = replace(submission, content=b"changed")
    assert Regrade(selected, Earlier(Path(), (known,))).parts(changed) == ()


def test_what_stays_and_what_is_marked(tmp_path: Path) -> None:
    """A result outside the selection does not change.

    If this run has no submission for a selected result, the reports mark this result.
    """
    write_reports([*class_of(3, ("05", "06")), refused("s09", "")], tmp_path)
    earlier = read_earlier(tmp_path)
    now = [grade for grade in earlier.grades if grade.student == "s01" and grade.chapter == "05"]
    rest = earlier.rest(now, Selection(chapters=("05",)))
    marks = {(grade.student, grade.chapter): grade.absent for grade in rest}
    assert marks == {
        ("s01", "06"): False,
        ("s02", "05"): True,
        ("s02", "06"): False,
        ("s03", "05"): True,
        ("s03", "06"): False,
    }
    earlier.forget_files(now, Selection(chapters=("05",)))
    assert not list((tmp_path / "results" / "s09").iterdir())


def test_another_assignment_in_the_same_folder(tmp_path: Path) -> None:
    """If no student submitted a chapter in this run, the reports do not mark its earlier results."""
    write_reports(class_of(2, ("05", "06")), tmp_path)
    earlier = read_earlier(tmp_path)
    now = [grade for grade in earlier.grades if grade.chapter == "06" and grade.student == "s01"]
    rest = {(each.student, each.chapter): each.absent for each in earlier.rest(now, Selection())}
    assert rest == {("s01", "05"): False, ("s02", "05"): False, ("s02", "06"): True}
    alone = earlier.rest(now, Selection().only(now))
    assert not any(each.absent for each in alone)


def test_kept_grades_belong_to_no_student(tmp_path: Path) -> None:
    """A newly graded part replaces the stored part.

    If a stored grade of the same notebook belongs to other options, the run removes this grade.
    """
    submission = SUBMISSIONS[0]
    store = Store(tmp_path)
    whole = _grade(Verdict.PASSED, Verdict.FAILED, notes=("about the cells",))
    for key in ("k", "other options"):
        store.keep(replace(whole, key=key))
    base = replace(whole, key="other options", handed_in=submission.digest, notes=("s01 was late",))
    regrade = Regrade(selection((), (), ["05.2"]), Earlier(tmp_path, (base,)))
    fresh = replace(whole, reports=(report("05.2"),), student="")
    regrade.keep(store, fresh, ("05.2",), [submission])
    kept = store.load("k")
    assert kept is not None
    assert [each.points for each in kept.reports] == [2, 2]
    assert (kept.student, kept.notes) == ("", ("about the cells",))
    assert store.load("other options") is None


def test_marked_results_are_in_no_file_for_a_platform(tmp_path: Path) -> None:
    """The files for Canvas and Moodle contain no results of missing submissions."""
    present, absent = class_of(2)
    write_reports([present, replace(absent, absent=True)], tmp_path)
    for name in ("class.html", "grades.csv", "feedback/s02.html"):
        assert "earlier run" in (tmp_path / name).read_text("utf-8")
    for name in ("canvas.csv", "moodle.csv", "junit.xml"):
        text = (tmp_path / name).read_text("utf-8")
        assert "s01" in text
        assert "s02" not in text
    assert read_earlier(tmp_path).find("s02", "05") is not None
    assert not (tmp_path / "gradescope" / "s02").exists()


def test_a_file_that_is_no_result_is_counted(tmp_path: Path) -> None:
    """The run continues after a damaged record, or a record of another version."""
    write_reports(class_of(1), tmp_path)
    (tmp_path / "results" / "s01" / "06.json").write_text("{}")
    assert (len(read_earlier(tmp_path).grades), read_earlier(tmp_path).unreadable) == (1, 1)
