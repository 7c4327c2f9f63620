"""The commands `course grade` and `course grade-one`, for instructors."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading.extras import Extras, read_extras
from course_pkg.grading.grade import Grade, Submission
from course_pkg.grading.intake.submissions import submissions
from course_pkg.grading.late import LatePolicy, LateTable, late_policy, late_table
from course_pkg.grading.marking import key_of
from course_pkg.grading.queue import Task, executor_of, grade_all
from course_pkg.grading.reports import write_reports
from course_pkg.grading.roster.class_list import ClassList, origins_of, read_lists
from course_pkg.grading.store import Store, handed_in
from course_pkg.sandbox.bubblewrap import require_sandbox
from course_pkg.setup.progress import Progress
from course_pkg.state import write_json

A_CORE = 2  # submissions per core at the same time: a check waits for responses most of the time


@dataclass(frozen=True)
class Options:
    """The options of the command line."""

    source: Path
    out: Path
    chapters: tuple[str, ...] = ()
    jobs: int = 0
    scheduler: str = ""
    fresh: bool = False
    sandboxed: bool = True
    private: Path | None = None
    late: Path | None = None
    late_per_day: float | None = None  # percent
    late_max_days: float | None = None
    roster: Path | None = None
    moodle_worksheet: Path | None = None
    validate: str = "missing"  # "all", "none" or "missing": the students whose notebooks nbval runs


def grade(options: Options) -> int:
    """Grade all submissions, and write the reports; return the exit status 0 for any grades."""
    if options.jobs < 0:
        raise GradingError(
            f"--jobs {options.jobs} is not a valid number of notebooks. Leave it out, or give 1 or more."
        )
    policy = late_policy(options.late, options.late_per_day, options.late_max_days)
    table = late_table(options.late) if options.late else None
    lists = read_lists(options.roster, options.moodle_worksheet)
    extras = read_extras(options.private)
    found = _handed_in(options, table)
    if options.sandboxed:
        require_sandbox()
    store = Store(options.out)
    if options.fresh:
        store.forget()
    began = time.monotonic()
    try:
        grades = list(_graded(options, found, extras, store))
    except KeyboardInterrupt:
        sys.stderr.write("\nStopped. Type the same command again to continue.\n")
        sys.stderr.flush()
        # The threads would wait until their notebooks have ended. The processes that they run end with this
        # process.
        os._exit(130)
    class_list = lists.matched(origins_of(grades), options.source)
    _report(_in_order([_with_lateness(each, policy) for each in grades]), options.out, class_list)
    took = time.monotonic() - began
    sys.stdout.write(f"{len(grades)} notebooks graded in {took:.0f} s: {options.out / 'class.html'}\n")
    sys.stdout.writelines(f"{sentence}\n" for sentence in class_list.summary())
    return 0


def _report(grades: Sequence[Grade], out: Path, class_list: ClassList) -> None:
    try:
        write_reports(grades, out, class_list)
    except OSError as error:
        raise GradingError(
            f"The reports cannot be written ({error}). Correct this problem, and type the same command "
            "again. No submission is graded twice."
        ) from error


def grade_one(notebook: Path, out: Path, *, sandboxed: bool = True, private: Path | None = None) -> int:
    """Grade one notebook into the file `out`, and store nothing else; a job array of a cluster uses this."""
    found = submissions(notebook)
    if not found:
        raise GradingError(f"{notebook} is not a notebook of this course.")
    if sandboxed:
        require_sandbox()
    key = key_of(found[0], read_extras(private), "missing", sandboxed=sandboxed)
    folder = str(private.resolve()) if private else ""
    task = Task(found[0], os.urandom(16).hex(), key, sandboxed, folder, "missing")
    write_json(out, task.grade())
    return 0


def _handed_in(options: Options, table: LateTable | None) -> list[Submission]:
    found = submissions(options.source, options.chapters)
    if not found:
        raise GradingError(
            f"There is nothing to grade in {options.source}. Give a folder that contains "
            "STUDENT/NN_topic.ipynb, or a zip of it."
        )
    if table and (strangers := table.strangers(found)):
        sys.stderr.write(
            f"{strangers} in the table of late days handed in nothing. Check the spelling of the names.\n"
        )
    return table.applied(found) if table else found


def _graded(options: Options, found: Sequence[Submission], extras: Extras, store: Store) -> Iterator[Grade]:
    """Yield a grade for each submission: first the grades of earlier runs, then new grades when ready."""
    todo: dict[str, list[Submission]] = {}
    progress = Progress(total=len(found), unit="notebooks")
    for submission in found:
        key = key_of(submission, extras, options.validate, sandboxed=options.sandboxed)
        known = store.find(key, submission)
        if known is not None:
            yield known
        else:
            todo.setdefault(key, []).append(submission)
    if kept := len(found) - sum(map(len, todo.values())):
        progress.advance(kept, kept=True)
        progress.note(f"{kept} of {len(found)} notebooks are graded from an earlier run.")
    jobs = options.jobs or (0 if options.scheduler else A_CORE * (os.cpu_count() or 1))
    private = str(options.private.resolve()) if options.private else ""
    tasks = [
        Task(alike[0], store.secret, key, options.sandboxed, private, options.validate)
        for key, alike in todo.items()
    ]
    with progress.painting(), executor_of(options.scheduler, jobs) as (executor, workers):
        for graded in grade_all(tasks, executor, workers):
            store.keep(graded)
            alike = todo[graded.key]
            progress.advance(len(alike))
            yield from (handed_in(graded, each) for each in alike)


def _with_lateness(graded: Grade, policy: LatePolicy) -> Grade:
    return replace(graded, factor=policy.factor(graded.late))


def _in_order(grades: Sequence[Grade]) -> list[Grade]:
    return sorted(grades, key=lambda each: (each.student, each.chapter, each.origin))
