"""`course grade` and `course grade-one`: what an instructor types."""

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
from course_pkg.grading.intake import submissions
from course_pkg.grading.late import LatePolicy, LateTable, late_policy, late_table
from course_pkg.grading.marking import key_of
from course_pkg.grading.progress import Progress
from course_pkg.grading.queue import Task, executor_of, grade_all
from course_pkg.grading.reports import write_reports
from course_pkg.grading.store import Store, handed_in
from course_pkg.grading.walls import require_walls
from course_pkg.state import write_json

A_CORE = 2  # submissions at once: for most of the time a part waits for answers


@dataclass(frozen=True)
class Options:
    """What was asked for on the command line."""

    source: Path
    out: Path
    chapters: tuple[str, ...] = ()
    jobs: int = 0
    scheduler: str = ""
    fresh: bool = False
    walls: bool = True
    private: Path | None = None
    late: Path | None = None
    policy: str = ""
    validate: str = "missing"  # or "all", "none": whose notebooks nbval runs


def grade(options: Options) -> int:
    """Grade all that was handed in, and write the reports; return 0, whatever the grades."""
    if options.jobs < 0:
        raise GradingError(
            f"--jobs {options.jobs} is no number of notebooks: leave it out, or give 1 or more."
        )
    policy = late_policy(options.policy)
    table = late_table(options.late) if options.late else None
    extras = read_extras(options.private)
    found = _handed_in(options, table)
    if options.walls:
        require_walls()
    store = Store(options.out)
    if options.fresh:
        store.forget()
    began = time.monotonic()
    try:
        grades = list(_graded(options, found, extras, store))
    except KeyboardInterrupt:
        sys.stderr.write("\nStopped. Type the same command again to go on.\n")
        sys.stderr.flush()
        os._exit(130)  # the threads would see their notebooks to the end; what they run ends with them
    _report(_in_order([_with_lateness(each, policy) for each in grades]), options.out)
    took = time.monotonic() - began
    sys.stdout.write(f"{len(grades)} notebooks graded in {took:.0f} s: {options.out / 'class.html'}\n")
    return 0


def _report(grades: Sequence[Grade], out: Path) -> None:
    try:
        write_reports(grades, out)
    except OSError as error:
        raise GradingError(
            f"The reports cannot be written ({error}). Mend that, and type the same command again: "
            "nothing is graded twice."
        ) from error


def grade_one(notebook: Path, out: Path, *, walls: bool = True, private: Path | None = None) -> int:
    """Grade one notebook into the file `out`, with nothing kept besides: for a cluster's array of jobs."""
    found = submissions(notebook)
    if not found:
        raise GradingError(f"{notebook} is no notebook of this course.")
    if walls:
        require_walls()
    key = key_of(found[0], read_extras(private), "missing", walls=walls)
    folder = str(private.resolve()) if private else ""
    task = Task(found[0], os.urandom(16).hex(), key, walls, folder, "missing")
    write_json(out, task.grade())
    return 0


def _handed_in(options: Options, table: LateTable | None) -> list[Submission]:
    found = submissions(options.source, options.chapters)
    if not found:
        raise GradingError(
            f"There is nothing to grade in {options.source}: it should hold STUDENT/NN_topic.ipynb, or be a "
            "zip of that."
        )
    if table and (strangers := table.strangers(found)):
        sys.stderr.write(f"{strangers} in the table of late days handed nothing in: a slip in a name?\n")
    return table.applied(found) if table else found


def _graded(options: Options, found: Sequence[Submission], extras: Extras, store: Store) -> Iterator[Grade]:
    """Yield a grade for each submission: those that are kept, then the others as they come."""
    todo: dict[str, list[Submission]] = {}
    progress = Progress(len(found))
    for submission in found:
        key = key_of(submission, extras, options.validate, walls=options.walls)
        kept = store.find(key, submission)
        if kept is not None:
            yield kept
        else:
            todo.setdefault(key, []).append(submission)
    progress.begin(kept=len(found) - sum(map(len, todo.values())))
    jobs = options.jobs or (0 if options.scheduler else A_CORE * (os.cpu_count() or 1))
    private = str(options.private.resolve()) if options.private else ""
    tasks = [
        Task(alike[0], store.secret, key, options.walls, private, options.validate)
        for key, alike in todo.items()
    ]
    with executor_of(options.scheduler, jobs) as (executor, workers):
        for graded in grade_all(tasks, executor, workers):
            store.keep(graded)
            alike = todo[graded.key]
            progress.more(len(alike))
            yield from (handed_in(graded, each) for each in alike)
    progress.end()


def _with_lateness(graded: Grade, policy: LatePolicy) -> Grade:
    return replace(graded, factor=policy.factor(graded.late))


def _in_order(grades: Sequence[Grade]) -> list[Grade]:
    return sorted(grades, key=lambda each: (each.student, each.chapter, each.origin))
