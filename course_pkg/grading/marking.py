"""Grades a submission: builds the graded notebook, runs each part, and reads the check runner's reports."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from course_pkg.authoring.cells import Notebook, code_cells, exercise_of
from course_pkg.checking.parts import Part
from course_pkg.checking.report import Report, Verdict
from course_pkg.errors import WorkerFailed
from course_pkg.grading.extras import Extras
from course_pkg.grading.grade import IN_PACKAGES, Grade, Package, Submission
from course_pkg.grading.plan import PartPlan, Plan, course_digest
from course_pkg.grading.rebuild.context import needed
from course_pkg.grading.rebuild.rebuilder import Rebuilt
from course_pkg.sandbox.job import PartJob, PartResult, WorkFile

Run = Callable[[PartJob], PartResult]
LONGEST_CODE = 20_000  # LONGEST_CODE is the maximum number of characters of a part's code in the feedback.
# TRIES is the maximum number of runs of a part. The course runs a part again if a sandbox worker fails. An
# answer cannot cause this failure.
TRIES = 2


@dataclass(frozen=True)
class Answers:
    """A student's answers for a chapter: files in submitted packages, and cells of the notebook.

    A submitted package replaces the package that the cells of the notebook write into src. If the package
    contains all files of a part, the check uses the package and the notebook's cells do not run. The reason
    is that the student may have changed the files in an editor. If the package lacks a file, the cell that
    writes this file is used. `problem` says why there is no notebook.
    """

    packages: tuple[Package, ...]
    notebook: Rebuilt | None
    problem: str = ""

    def in_packages(self, part: Part) -> bool:
        """Return whether the packages contain all files that the part needs."""
        asked = part.package_files
        here = all(self._has(name, paths) for name, paths in asked.items())
        return here and len(part.needs) == sum(map(len, asked.values())) > 0

    def files(self, part: Part) -> tuple[WorkFile, ...]:
        """Return all files of the packages that the part needs; their paths begin with src."""
        named = [each for each in self.packages if each.name in part.package_files]
        return tuple(file.below(f"src/{each.name}") for each in named for file in each.files)

    def code(self, planned: PartPlan) -> str:
        """Return the student's code for a part: files of a package, or the cell of the notebook."""
        part = planned.part
        if self.in_packages(part):
            named = {f"src/{name}/{path}" for name, paths in part.package_files.items() for path in paths}
            files = [file for file in self.files(part) if file.path in named]
            text = "\n".join(f"# {each.path}\n{each.data.decode('utf-8', 'replace')}" for each in files)
        else:
            text = self.notebook.answers.get(planned.exercise, "") if self.notebook else ""
        return text[:LONGEST_CODE]

    def lacking(self, part: Part) -> list[str]:
        """Return a sentence for each submitted package that lacks a file that the part needs."""
        named = {each.name for each in self.packages}
        return [
            f"The package {name} in this submission has no {' and no '.join(paths)}."
            for name, paths in part.package_files.items()
            if name in named and not self._has(name, paths)
        ]

    def _has(self, name: str, paths: Sequence[str]) -> bool:
        return any(each.name == name and each.has(paths) for each in self.packages)


def key_of(submission: Submission, extras: Extras, validate: str, *, sandboxed: bool) -> str:
    """Return the key of a submission's grade: a digest of all data that affect the grade."""
    digest = hashlib.sha256(submission.digest.encode())
    for text in (course_digest(), extras.digest, str(sandboxed), validate):
        digest.update(b"\0" + text.encode())
    return digest.hexdigest()[:32]


def mark(submission: Submission, plan: Plan, run: Run, secret: str, key: str, *, sandboxed: bool) -> Grade:
    """Return the grade of one submission.

    `secret` is the seed for the random inputs of the checks. Students do not know this seed. Each run of
    `course grade` with the same results folder uses the same seed.
    """
    grade = Grade(
        submission.student,
        submission.chapter,
        (),
        late=submission.late,
        sandboxed=sandboxed,
        key=key,
        origin=submission.origin,
        private=tuple(each.part.check for each in plan.parts if each.private),
    )
    rebuilt = None if submission.problem else plan.rebuilder.rebuild(submission.content)
    problem = rebuilt.problem if rebuilt else submission.problem
    if problem and not submission.packages:
        return _nothing(grade, plan, problem)
    answers = Answers(submission.packages, None if problem else rebuilt, problem)
    reports = [_examined(each, answers, run, _seed(secret, key, each.part.check)) for each in plan.parts]
    code = {each.part.check: text for each in plan.parts if (text := answers.code(each))}
    return replace(grade, reports=tuple(reports), notes=tuple(_notes(plan, answers)), code=code)


def _notes(plan: Plan, answers: Answers) -> Iterator[str]:
    if packaged := [each.part.check for each in plan.parts if answers.in_packages(each.part)]:
        yield f"{IN_PACKAGES}: {', '.join(packaged)}."
    yield from answers.notebook.notes if answers.notebook else [answers.problem]


def _nothing(grade: Grade, plan: Plan, problem: str) -> Grade:
    reports = [_not_attempted(each, problem) for each in plan.parts]
    return replace(grade, reports=tuple(reports), problem=problem)


def _not_attempted(planned: PartPlan, note: str) -> Report:
    part = planned.part
    return Report(part.check, Verdict.NOT_ATTEMPTED, part.goal, 0, part.points, note=note)


def _examined(planned: PartPlan, answers: Answers, run: Run, seed: int) -> Report:
    part, exercise, notebook = planned.part, planned.exercise, answers.notebook
    files = answers.files(part)
    cells: tuple[str, ...] = ()
    if not answers.in_packages(part):
        if notebook is None:
            return _not_attempted(planned, " ".join([answers.problem, *answers.lacking(part)]))
        if exercise in notebook.missing:
            return _not_attempted(planned, " ".join([notebook.missing[exercise], *answers.lacking(part)]))
        if exercise in notebook.untouched:
            return _not_attempted(planned, " ".join(["The cell was not changed.", *answers.lacking(part)]))
        answer = notebook.answers[exercise]
        cells = (*needed(answer, planned.before, _above(notebook.notebook, exercise)), answer)
    job = PartJob(
        part.check, planned.before, cells, planned.after, seed, part.deadline, files=files, hidden=part.hidden
    )
    return _reported(planned, _run(job, run))


def _run(job: PartJob, run: Run) -> PartResult:
    """Run a part.

    If the check gave no verdict, run the part again, except after a long run of the answer.
    """
    for _ in range(TRIES):
        try:
            result = run(job)
        except WorkerFailed as error:
            result = PartResult(None, str(error), lost=True)
        decided = result.report is not None and result.report.verdict is not Verdict.UNDECIDED
        if decided or result.took > job.limit / 2:
            break
    return result


def _above(notebook: Notebook, exercise: str) -> Sequence[str]:
    """Return the sources of the code cells above an exercise."""
    sources = []
    for cell in code_cells(notebook):
        if exercise_of(cell) == exercise:
            break
        sources.append(cell["source"])
    return sources


def _reported(planned: PartPlan, result: PartResult) -> Report:
    """Return the check runner's report; if the part failed, add the error that the student's cell raised."""
    part, report = planned.part, result.report
    if report is None:
        verdict = Verdict.UNDECIDED if result.lost else Verdict.FAILED
        note = f"There are no points, because {result.ending}."
        return Report(part.check, verdict, part.goal, 0, part.points, note=note)
    if report.verdict is Verdict.PASSED:
        return report
    if report.verdict is Verdict.UNDECIDED:
        # The part counts as failed, because a student's answer can prevent the check from finishing.
        note = f"There are no points, because the check could not finish: {report.note}"
        return Report(part.check, Verdict.FAILED, part.goal, 0, part.points, note=note, inconclusive=True)
    errors = [each.get("error", "") for each in result.messages if each.get("cell", "").startswith("answer")]
    note = " ".join(filter(None, [report.note, *(f"The cell raised {error}" for error in errors[-1:])]))
    return replace(report, note=note)


def _seed(secret: str, key: str, check: str) -> int:
    return int.from_bytes(hashlib.sha256(f"{secret}\0{key}\0{check}".encode()).digest()[:4], "big")
