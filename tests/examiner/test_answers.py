"""Every check is held to what students really write."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from pathlib import Path
from typing import TypeGuard

import pytest

from course_pkg.authoring import Shelf
from course_pkg.authoring.blank import handed_out
from course_pkg.authoring.cells import check_of, code_cells
from course_pkg.authoring.shelf import read
from course_pkg.examiner.answers import Answer, every_answer
from course_pkg.examiner.parts import Part, every_part, find
from course_pkg.examiner.report import Report, Verdict
from course_pkg.grading.ward.job import PartJob
from tests.examiner.lanes import Lanes

ANSWERS = list(every_answer())
PARTS = list(every_part())
STORED = {
    check: cell["outputs"][0]["data"]
    for path in Shelf().solutions()
    for cell in code_cells(read(path))
    if (check := check_of(cell))
}


def _job(answer: Answer, source: str) -> PartJob:
    deadline = find(answer.check).deadline
    return PartJob(answer.check, answer.before, (source,), answer.after, secrets.randbits(32), deadline)


def _blank(part: Part) -> PartJob:
    """Return the job of a part that nobody has begun."""
    right = next(answer for answer in ANSWERS if answer.check == part.check and answer.right)
    return _job(right, handed_out(part.check, right.source))


JOBS: dict[Answer | Part, PartJob] = {
    **{answer: _job(answer, answer.source) for answer in ANSWERS},
    **{part: _blank(part) for part in PARTS},
}


@pytest.fixture(scope="session")
def lanes(request: pytest.FixtureRequest) -> Iterator[Lanes]:
    """Run what was chosen as submissions do, behind walls where the machine has them, some at once."""
    chosen = [item.callspec.params for item in request.session.items if _takes_lanes(item)]
    with Lanes([JOBS[each.get("answer") or each["part"]] for each in chosen]) as lanes:
        yield lanes


def _takes_lanes(item: pytest.Item) -> TypeGuard[pytest.Function]:
    return item.path == Path(__file__) and isinstance(item, pytest.Function) and "lanes" in item.fixturenames


def examined(lanes: Lanes, job: PartJob) -> Report:
    """Return what the judge recorded of an answer."""
    outcome = lanes.outcome(job)
    assert not [words for words in outcome.said if words["cell"] == "before"], outcome
    assert outcome.report is not None, outcome.ending
    return outcome.report


def _name(answer: Answer) -> str:
    return f"{answer.check} {'right' if answer.right else 'wrong'}: {answer.title}"


@pytest.mark.parametrize("answer", ANSWERS, ids=_name)
def test_right_passes_and_wrong_is_refused_with_its_hint(answer: Answer, lanes: Lanes) -> None:
    """A right answer passes; a wrong one fails, and the report holds the hint for that mistake.

    The text and the HTML of a pass stand in the solution, and nbval compares both: whatever was drawn, they
    are the same.
    """
    report = examined(lanes, JOBS[answer])
    assert report.verdict is (Verdict.PASSED if answer.right else Verdict.FAILED), str(report)
    assert " ".join(answer.hint.split()) in " ".join(str(report).split())
    if answer.right:
        stored = STORED[answer.check]
        assert str(report) == stored["text/plain"]
        assert report.html() == stored["text/html"]


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.check)
def test_exercise_left_as_it_is_reads_not_attempted(part: Part, lanes: Lanes) -> None:
    """The blanked answer is no failure and no error: it has not been attempted."""
    report = examined(lanes, JOBS[part])
    assert report.verdict is Verdict.NOT_ATTEMPTED, str(report)


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
