"""Every check is held to what students really write."""

from __future__ import annotations

import secrets
from collections.abc import Iterator

import pytest

from course_pkg.authoring import Shelf
from course_pkg.authoring.blank import handed_out
from course_pkg.authoring.cells import check_of, code_cells
from course_pkg.authoring.shelf import read
from course_pkg.examiner.answers import Answer, every_answer
from course_pkg.examiner.parts import Part, every_part, find
from course_pkg.examiner.report import Report, Verdict
from course_pkg.grading.walls import refusal
from course_pkg.grading.ward.job import PartJob
from course_pkg.grading.wards import Ward

ANSWERS = list(every_answer())
PARTS = list(every_part())
CHECK_CELLS = [cell for path in Shelf().solutions() for cell in code_cells(read(path)) if check_of(cell)]


@pytest.fixture(scope="session")
def ward() -> Iterator[Ward]:
    """One ward for each worker: answers run as submissions do, behind walls where the machine has them."""
    with Ward(walls=not refusal()) as warm:
        yield warm


def examined(ward: Ward, answer: Answer, source: str | None = None) -> Report:
    """Run `answer`, or `source` in its place, and return what the judge recorded."""
    own = answer.source if source is None else source
    deadline = find(answer.check).deadline
    job = PartJob(answer.check, answer.before, (own,), answer.after, secrets.randbits(32), deadline)
    outcome = ward.run(job)
    assert not [words for words in outcome.said if words["cell"] == "before"], outcome
    assert outcome.report is not None, outcome.ending
    return outcome.report


def _name(answer: Answer) -> str:
    return f"{answer.check} {'right' if answer.right else 'wrong'}: {answer.title}"


@pytest.mark.parametrize("answer", ANSWERS, ids=_name)
def test_right_passes_and_wrong_is_refused_with_its_hint(answer: Answer, ward: Ward) -> None:
    """A right answer passes; a wrong one fails, and the report holds the hint for that mistake."""
    report = examined(ward, answer)
    assert report.verdict is (Verdict.PASSED if answer.right else Verdict.FAILED), str(report)
    assert " ".join(answer.hint.split()) in " ".join(str(report).split())


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.check)
def test_exercise_left_as_it_is_reads_not_attempted(part: Part, ward: Ward) -> None:
    """The blanked answer is no failure and no error: it has not been attempted."""
    right = next(answer for answer in ANSWERS if answer.check == part.check and answer.right)
    report = examined(ward, right, handed_out(part.check, right.source))
    assert report.verdict is Verdict.NOT_ATTEMPTED, str(report)


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.check)
def test_a_pass_reads_as_it_is_stored_whatever_was_drawn(part: Part, ward: Ward) -> None:
    """The text and the HTML of a pass stand in the solution, and nbval compares both."""
    right = next(answer for answer in ANSWERS if answer.check == part.check and answer.right)
    report = examined(ward, right)
    stored = next(cell for cell in CHECK_CELLS if check_of(cell) == part.check)["outputs"][0]["data"]
    assert str(report) == stored["text/plain"]
    assert report.html() == stored["text/html"]


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.check)
def test_part_has_enough_answers(part: Part) -> None:
    """A part is held to two right answers and to four wrong ones, each with a hint of its own."""
    right = [answer for answer in ANSWERS if answer.check == part.check and answer.right]
    hints = {answer.hint for answer in ANSWERS if answer.check == part.check and not answer.right}
    assert len(right) >= 2
    assert len(hints) >= 4


def test_every_answer_belongs_to_a_part() -> None:
    """No answer is for a check that does not exist."""
    assert {answer.check for answer in ANSWERS} <= {part.check for part in PARTS}
