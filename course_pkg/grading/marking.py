"""From a submission to its grade: rebuilt, run part by part behind walls, worth what the judge recorded."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import replace

from course_pkg.authoring.cells import Notebook, code_cells, exercise_of
from course_pkg.errors import WardFailed
from course_pkg.examiner.report import Report, Verdict
from course_pkg.grading.context import needed
from course_pkg.grading.extras import Extras
from course_pkg.grading.grade import Grade, Submission
from course_pkg.grading.plan import PartPlan, Plan, course_digest
from course_pkg.grading.rebuild import Rebuilt
from course_pkg.grading.ward.job import PartJob, PartOutcome

Run = Callable[[PartJob], PartOutcome]
TRIES = 2  # of a part whose place to run in was lost: that is never the answer's doing alone


def key_of(submission: Submission, extras: Extras, validate: str, *, walls: bool) -> str:
    """Return the name that this grade is kept under: of all that it depends on, and of nothing else."""
    digest = hashlib.sha256(submission.content)
    for text in (
        submission.chapter,
        submission.problem,
        course_digest(),
        extras.digest,
        str(walls),
        validate,
    ):
        digest.update(b"\0" + text.encode())
    return digest.hexdigest()[:32]


def mark(
    submission: Submission, plan: Plan, extras: Extras, run: Run, secret: str, key: str, *, walls: bool
) -> Grade:
    """Return the grade of one submission. `secret` makes inputs that nobody knows, the same if run again."""
    grade = Grade(
        submission.student,
        submission.chapter,
        (),
        late=submission.late,
        walls=walls,
        key=key,
        origin=submission.origin,
        private=tuple(each.part.check for each in plan.parts if each.private),
    )
    if submission.problem:
        return _nothing(grade, plan, extras, submission.problem)
    rebuilt = plan.rebuilder.rebuild(submission.content)
    if rebuilt.problem:
        return _nothing(grade, plan, extras, rebuilt.problem)
    reports = [
        extras.weighed(_examined(each, rebuilt, run, _seed(secret, key, each.part.check)))
        for each in plan.parts
    ]
    return replace(grade, reports=tuple(reports), notes=rebuilt.notes)


def _nothing(grade: Grade, plan: Plan, extras: Extras, problem: str) -> Grade:
    reports = [extras.weighed(_not_attempted(each, problem)) for each in plan.parts]
    return replace(grade, reports=tuple(reports), problem=problem)


def _not_attempted(planned: PartPlan, note: str) -> Report:
    part = planned.part
    return Report(part.check, Verdict.NOT_ATTEMPTED, part.goal, 0, part.points, note=note)


def _examined(planned: PartPlan, rebuilt: Rebuilt, run: Run, seed: int) -> Report:
    exercise = planned.exercise
    if exercise in rebuilt.missing:
        return _not_attempted(planned, rebuilt.missing[exercise])
    if exercise in rebuilt.untouched:
        return _not_attempted(planned, "The cell is as it was handed out.")
    answer = rebuilt.answers[exercise]
    above = needed(answer, planned.before, _above(rebuilt.notebook, exercise))
    job = PartJob(
        planned.part.check, planned.before, (*above, answer), planned.after, seed, planned.part.deadline
    )
    return _reported(planned, _run(job, run))


def _run(job: PartJob, run: Run) -> PartOutcome:
    """Run a part, once more where the first run came to nothing; an answer that hangs would hang again."""
    for _ in range(TRIES):
        try:
            outcome = run(job)
        except WardFailed as error:
            outcome = PartOutcome(None, str(error), lost=True)
        decided = outcome.report is not None and outcome.report.verdict is not Verdict.UNDECIDED
        if decided or outcome.took > job.limit / 2:
            break
    return outcome


def _above(notebook: Notebook, exercise: str) -> Sequence[str]:
    """Return the sources of the code cells above an exercise, its own not among them."""
    sources = []
    for cell in code_cells(notebook):
        if exercise_of(cell) == exercise:
            break
        sources.append(cell["source"])
    return sources


def _reported(planned: PartPlan, outcome: PartOutcome) -> Report:
    """Return the judge's report, with what the student's cell said for itself where it did not pass."""
    part, report = planned.part, outcome.report
    if report is None:
        verdict = Verdict.UNDECIDED if outcome.lost else Verdict.FAILED
        note = f"Nothing earned: {outcome.ending}."
        return Report(part.check, verdict, part.goal, 0, part.points, note=note)
    if report.verdict is Verdict.PASSED:
        return report
    said = [
        str(each.get("error", "")) for each in outcome.said if str(each.get("cell", "")).startswith("answer")
    ]
    note = " ".join(filter(None, [report.note, *(f"The cell raised {words}" for words in said[-1:])]))
    return replace(report, note=note)


def _seed(secret: str, key: str, check: str) -> int:
    return int.from_bytes(hashlib.sha256(f"{secret}\0{key}\0{check}".encode()).digest()[:4], "big")
