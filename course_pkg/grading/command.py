"""The commands `course grade` and `course grade-one`, for instructors."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading.deadlines.deadline import Deadlines, deadlines
from course_pkg.grading.deadlines.extensions import extensions_of
from course_pkg.grading.deadlines.late import LatePolicy, LateTable, late_policy, late_table
from course_pkg.grading.deadlines.lateness import LAST, Lateness, attempts_to_grade, best_attempts
from course_pkg.grading.deadlines.moments import zone_of
from course_pkg.grading.deadlines.times import times_of
from course_pkg.grading.extras import Extras, read_extras
from course_pkg.grading.flags.finding import wanted_kinds, with_flags
from course_pkg.grading.grade import Grade, Submission, grade_from
from course_pkg.grading.intake.folders import require_other_folder
from course_pkg.grading.intake.naming import NOTEBOOK
from course_pkg.grading.intake.submissions import submissions
from course_pkg.grading.marking import key_of
from course_pkg.grading.points import read_points
from course_pkg.grading.queue import Task, grade_all, pool_of
from course_pkg.grading.reports import write_reports
from course_pkg.grading.reports.asked import Asked, columns_of
from course_pkg.grading.reports.records import RESULTS
from course_pkg.grading.required import require_references
from course_pkg.grading.review.applying import about_reviews, reviewed
from course_pkg.grading.review.overrides import read_overrides
from course_pkg.grading.roster.class_list import ClassList, Lists, origins_of, read_lists
from course_pkg.grading.run.changes import changes, described, worth_changes, write_changes
from course_pkg.grading.run.earlier import Earlier, read_earlier
from course_pkg.grading.run.regrade import Regrade
from course_pkg.grading.run.selection import Selection, selection
from course_pkg.grading.run.summary import about_empty, about_flags, about_rest, last_line, status_of
from course_pkg.grading.store import Store, handed_in
from course_pkg.sandbox.linux.bubblewrap import require_sandbox
from course_pkg.setup.progress import Progress
from course_pkg.state import write_json

# A_CORE is the number of submissions that each processor core grades at the same time. The number is more
# than 1, because a check mostly waits.
A_CORE = 2


@dataclass(frozen=True)
class Options:
    """The options of the command line."""

    source: Path
    out: Path
    chapters: tuple[str, ...] = ()
    students: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    jobs: int = 0
    scheduler: str = ""
    fresh: bool = False
    sandboxed: bool = True
    private: Path | None = None
    deadlines: tuple[str, ...] = ()
    times: str = ""
    time_zone: str = ""
    grace_minutes: float = 0.0
    attempts: str = LAST
    late: Path | None = None
    late_per_day: float | None = None  # The deduction is in percent.
    late_max_days: float | None = None
    roster: Path | None = None
    moodle_worksheet: Path | None = None
    points: Path | None = None
    # nbval runs the notebooks of all students ("all"), of students with missing points ("missing"), or of no
    # student.
    validate: str = "missing"
    flags: tuple[str, ...] = ()  # Only these kinds of flags are reported; an empty tuple means all kinds.


def grade(options: Options) -> int:
    """Grade the selected submissions, and write the reports; return the exit status (see run/summary.py)."""
    if options.jobs < 0:
        raise GradingError(
            f"--jobs {options.jobs} is not a valid number of notebooks. Leave out this option, or give a "
            "number of at least 1."
        )
    require_references(options.chapters)
    policy = late_policy(options.late, options.late_per_day, options.late_max_days, options.deadlines)
    table = late_table(options.late) if options.late else None
    lists = read_lists(options.roster, options.moodle_worksheet)
    require_other_folder(options.source, options.out)
    kinds = wanted_kinds(options.flags)
    extras = read_extras(options.private)
    points = read_points(options.points or extras.points)
    selected = selection(options.students, options.chapters, options.parts)
    found = _handed_in(options, selected)
    due = _deadlines(options, found, lists)
    everyone = _dated(options, found, due, table)
    selected = selected.for_students(everyone)
    if options.sandboxed:
        require_sandbox()
    store, earlier = Store(options.out), read_earlier(options.out)
    overrides = read_overrides(options.out)
    overrides.require_students(
        {each.student for each in everyone} | {each.student for each in earlier.grades}
    )
    if options.fresh and selected.everything:
        store.forget()
    began = time.monotonic()
    try:
        found = selected.of(everyone)
        graded = list(_graded(options, found, extras, store, Regrade(selected, earlier, fresh=options.fresh)))
    except KeyboardInterrupt:
        sys.stderr.write("\nThe run was stopped. Type the same command again to continue.\n")
        sys.stderr.flush()
        # os._exit() does not wait for the threads that grade notebooks; it also ends the processes of these
        # threads. It also ends the processes of these threads.
        os._exit(130)
    graded = best_attempts([_with_lateness(points.weighed(each), policy) for each in graded])
    rest = earlier.rest(graded, selected if _is_class(options.source) else selected.only(graded))
    rest = [points.weighed(each) for each in rest]
    overrides.require_parts([*graded, *rest])
    graded, rest = reviewed(graded, overrides), reviewed(rest, overrides)
    class_list = _class_list(lists, options.source, [*everyone, *rest])
    chapters = frozenset({*selected.chapters, *(each.chapter for each in graded)})
    asked = Asked(chapters, columns_of(selected.chapters, points), due.is_over)
    reported = with_flags([*graded, *rest], everyone, kinds)
    _report(_in_order(reported), options.out, class_list, asked)
    earlier.forget_files(graded, selected)
    about = [*class_list.summary(), *about_flags(reported), *about_reviews(reported)]
    sys.stdout.writelines(f"{sentence}\n" for sentence in about)
    _print_end(options.out, earlier, graded, rest, time.monotonic() - began)
    return status_of(graded)


def _print_end(
    out: Path, earlier: Earlier, graded: Sequence[Grade], rest: Sequence[Grade], took: float
) -> None:
    """Print the changes since the last run, the earlier results that did not change, and a summary line."""
    lines = []
    if earlier.grades:
        found = changes(earlier.grades, [*graded, *rest])
        write_changes(found, out)
        lines += [*worth_changes(earlier.grades, [*graded, *rest]), *described(found, out)]
    if earlier.unreadable:
        lines.append(
            f"{earlier.unreadable} files in {out / RESULTS} are not results of this version of the course."
        )
    lines += [*about_empty(graded), *about_rest(rest, out)]
    count = "1 submission" if len(graded) == 1 else f"{len(graded)} submissions"
    lines += [f"The run graded {count} in {took:.0f} s. Open {out / 'class.html'} first.", last_line(graded)]
    sys.stdout.write("\n".join([*lines, ""]))


def _report(grades: Sequence[Grade], out: Path, class_list: ClassList, asked: Asked) -> None:
    try:
        write_reports(grades, out, class_list, asked)
    except OSError as error:
        raise GradingError(
            f"The reports cannot be written ({error}). Correct this problem, and type the same command "
            "again. The submissions that are already graded are not graded again."
        ) from error


def grade_one(
    notebook: Path,
    out: Path,
    *,
    sandboxed: bool = True,
    private: Path | None = None,
    points: Path | None = None,
) -> int:
    """Grade one notebook and write the result into the file `out`.

    Each job in a job array of a cluster calls this function.
    """
    require_references()
    found = submissions(notebook)
    if not found:
        raise GradingError(f"{notebook} is not a notebook of this course.")
    if sandboxed:
        require_sandbox()
    extras = read_extras(private)
    worth = read_points(points or extras.points)
    key = key_of(found[0], extras, "missing", sandboxed=sandboxed)
    folder = str(private.resolve()) if private else ""
    task = Task(found[0], os.urandom(16).hex(), key, sandboxed, folder, "missing")
    write_json(out, worth.weighed(grade_from(task.grade())).as_dict())
    return 0


def _is_class(source: Path) -> bool:
    """Return whether `source` contains the submissions of a class, not only one notebook."""
    return not (source.is_file() and NOTEBOOK.fullmatch(source.name))


def _class_list(lists: Lists, source: Path, handed_in: Iterable[Submission | Grade]) -> ClassList:
    """Return the students who submitted in this or an earlier run, and the missing students of the roster."""
    there = [each for each in handed_in if not each.nothing and not (isinstance(each, Grade) and each.absent)]
    return lists.matched(origins_of(there), source)


def _deadlines(options: Options, found: Sequence[Submission], lists: Lists) -> Deadlines:
    """Return the deadlines, with the extensions in the roster."""
    # This call raises an error for an invalid number of days in the roster, before the grading begins.
    extensions_of({str(each.line): each for each in lists.roster or ()})
    people = _class_list(lists, options.source, found).people
    zone = zone_of(options.time_zone) if options.time_zone else None
    return deadlines(options.deadlines, options.grace_minutes, zone, extensions_of(people))


def _dated(
    options: Options, found: Sequence[Submission], due: Deadlines, table: LateTable | None
) -> list[Submission]:
    """Return the submissions to grade; each of them contains the number of days after its deadline."""
    zone = zone_of(options.time_zone) if options.time_zone else None
    times = options.times or (options.deadlines and options.moodle_worksheet) or ""
    asked = bool(options.deadlines or options.times)  # Without a deadline, times.csv is not read.
    lateness = Lateness(due, times_of(str(times), options.source, zone) if asked else lambda _: None)
    if table and (strangers := table.strangers(found)):
        sys.stderr.write(
            f"These students are in the table of late days, but handed in nothing: {strangers}. "
            "Check the spelling of their names.\n"
        )
    dated = lateness.applied(attempts_to_grade(found, options.attempts, lateness.when))
    return table.applied(dated) if table else dated


def _handed_in(options: Options, selected: Selection) -> list[Submission]:
    found = submissions(options.source, selected.chapters, without=options.out)
    if not found:
        raise GradingError(
            f"There is nothing to grade in {options.source}. Choose a folder that contains "
            "STUDENT/NN_topic.ipynb, or a zip file of this folder."
        )
    return found


def _graded(
    options: Options, found: Sequence[Submission], extras: Extras, store: Store, regrade: Regrade
) -> Iterator[Grade]:
    """Yield a grade for each submission: first the stored grades, then each new grade when it is ready."""
    todo: dict[tuple[str, tuple[str, ...]], list[Submission]] = {}
    progress = Progress(total=len(found), unit="notebooks")
    for submission in found:
        key = key_of(submission, extras, options.validate, sandboxed=options.sandboxed)
        known = None if regrade.again else store.find(key, submission)
        if known is not None:
            yield known
        else:
            todo.setdefault((key, regrade.parts(submission)), []).append(submission)
    if kept := len(found) - sum(map(len, todo.values())):
        progress.advance(kept, kept=True)
        progress.note(f"The grades of {kept} of {len(found)} notebooks come from an earlier run.")
    jobs = options.jobs or (0 if options.scheduler else A_CORE * (os.cpu_count() or 1))
    private = str(options.private.resolve()) if options.private else ""
    tasks = [
        Task(alike[0], store.secret, key, options.sandboxed, private, options.validate, parts)
        for (key, parts), alike in todo.items()
    ]
    with progress.painting(), pool_of(options.scheduler, jobs) as pool:
        for task, graded in grade_all(tasks, pool):
            alike = todo[task.key, task.parts]
            regrade.keep(store, graded, task.parts, alike)
            progress.advance(len(alike))
            yield from (regrade.completed(handed_in(graded, each), task.parts) for each in alike)


def _with_lateness(graded: Grade, policy: LatePolicy) -> Grade:
    return replace(graded, factor=policy.factor(graded.late))


def _in_order(grades: Sequence[Grade]) -> list[Grade]:
    return sorted(grades, key=lambda each: (each.student, each.chapter, each.origin))
