"""Tests of every check with right and wrong answers."""

from __future__ import annotations

import os
import secrets
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet

from course_pkg.authoring.blank import handed_out
from course_pkg.authoring.cells import check_of, code_cells
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.checking.parts import Part, chapters, every_part
from course_pkg.checking.report import Report, Verdict
from course_pkg.sandbox.job import PartJob
from tests.checking.answers.example_answers import Answer, every_answer
from tests.checking.answers.workers import WorkerPool

PARTS = {part.check: part for part in every_part()}
# The answers with the longest deadlines run first, because otherwise some sandboxes would have no work at the
# end.
ANSWERS = sorted(every_answer(), key=lambda answer: -PARTS[answer.check].deadline)
# This dict contains the first right answer to each part.
RIGHT = {answer.check: answer for answer in reversed(ANSWERS) if answer.right}
pytestmark = pytest.mark.timeout(900)  # time limit in s for a test that waits in the queue

# A usual run contains the second right answer (key True) and the first wrong answer (key False) to each part.
# All other answers are slow tests. The first right answer is not included, because it is the solution, which
# test_validation.py checks.
USUAL = {True: (2,), False: (1,)}
# These parts build or start programs.
BUILDS = ("04.1", "04.3", "04.4", "04.5", "07.", "09.", "13.", "14.", "15.")
# These are the first parts of the chapters. All answers to the parts in BUILDS are slow tests, except for the
# parts in FIRST.
FIRST = {f"{chapter}.1" for chapter in chapters()}
# Several sandboxes run on each core, because answers wait for nodes and messages most of the time.
A_CORE = 2
STORED = {
    check: cell["outputs"][0]["data"]
    for path in NotebookStore().solutions()
    for cell in code_cells(read(path))
    if (check := check_of(cell))
}


@cache
def _job(case: Answer | Part) -> PartJob:
    """Return the sandbox job for an answer, or for a part with a blank exercise."""
    answer = RIGHT[case.check] if isinstance(case, Part) else case
    source = handed_out(case.check, answer.source) if isinstance(case, Part) else answer.source
    part = PARTS[case.check]
    seed = secrets.randbits(32)
    return PartJob(
        case.check, answer.before, (source,), answer.after, seed, part.deadline, hidden=part.hidden
    )


@pytest.fixture(scope="session")
def pool(request: pytest.FixtureRequest) -> Iterator[WorkerPool]:
    """Yield the sandboxes that run answers as in grading; the queue contains all answers of this test run."""
    with WorkerPool(A_CORE * (os.cpu_count() or 1)) as pool:
        pool.submit(_job(case) for item in request.session.items if (case := _case(item)) is not None)
        yield pool


@pytest.fixture
def report(request: pytest.FixtureRequest, pool: WorkerPool) -> Report:
    """Return the check runner's record of the answer or of the blank exercise."""
    case = _case(request.node)
    assert case is not None
    outcome = pool.result(_job(case))
    assert not [message for message in outcome.messages if message["cell"] == "before"], outcome
    assert outcome.report is not None, outcome.ending
    return outcome.report


def _case(item: pytest.Item) -> Answer | Part | None:
    """Return the answer or the part that a test of this file examines, or None for any other test."""
    if not isinstance(item, pytest.Function) or item.path != Path(__file__):
        return None
    if "report" not in item.fixturenames:
        return None
    case: Answer | Part = item.callspec.params.get("answer") or item.callspec.params["part"]
    return case


def _params() -> Iterator[ParameterSet]:
    """Yield the answers; an answer that a usual test run omits has the mark `slow`."""
    count: Counter[tuple[str, bool]] = Counter()
    for answer in ANSWERS:
        count[answer.check, answer.right] += 1
        usual = answer.check in FIRST or not answer.check.startswith(BUILDS)
        chosen = usual and count[answer.check, answer.right] in USUAL[answer.right]
        yield pytest.param(answer, marks=() if chosen else pytest.mark.slow, id=_name(answer))


def _name(answer: Answer) -> str:
    return f"{answer.check} {'right' if answer.right else 'wrong'}: {answer.title}"


@pytest.mark.parametrize("answer", list(_params()))
def test_right_passes_and_wrong_is_refused_with_its_hint(answer: Answer, report: Report) -> None:
    """A right answer passes; a wrong answer fails, and the report contains the hint for its mistake.

    The solution contains the text and the HTML of the report on a pass. nbval compares these outputs, so the
    report must not contain the random inputs of the check.
    """
    assert report.verdict is (Verdict.PASSED if answer.right else Verdict.FAILED), str(report)
    text = " ".join(str(report).split())
    assert [part for part in answer.quotes if part not in text] == []
    full = PARTS[answer.check].points
    assert report.points == full if answer.right else report.points < full
    if answer.right:
        stored = STORED[answer.check]
        assert str(report) == stored["text/plain"]
        assert report.html() == stored["text/html"]


@pytest.mark.parametrize(
    "part",
    [
        pytest.param(part, id=check, marks=() if check in FIRST else pytest.mark.slow)
        for check, part in PARTS.items()
    ],
)
def test_blank_exercise_is_not_attempted(part: Part, report: Report) -> None:
    """The result of a blank exercise is "not attempted", and not a failure or an error."""
    assert report.verdict is Verdict.NOT_ATTEMPTED, str(report)
    assert report.points == 0


@pytest.mark.parametrize("part", PARTS.values(), ids=lambda part: part.check)
def test_part_has_enough_answers(part: Part) -> None:
    """Each part has at least two right answers, and wrong answers with at least four different hints."""
    right = [answer for answer in ANSWERS if answer.check == part.check and answer.right]
    hints = {answer.hint for answer in ANSWERS if answer.check == part.check and not answer.right}
    assert len(right) >= 2
    assert len(hints) >= 4


def test_every_answer_belongs_to_a_part() -> None:
    """Each answer belongs to an existing check."""
    assert {answer.check for answer in ANSWERS} <= set(PARTS)
