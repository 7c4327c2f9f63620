"""Computes how late each submission is, and chooses the attempt that counts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import datetime

from course_pkg.errors import GradingError
from course_pkg.grading.deadlines.deadline import Deadlines
from course_pkg.grading.deadlines.moments import shown
from course_pkg.grading.grade import NO_TIME, Grade, Submission

LAST, BEST = "last", "best"


@dataclass(frozen=True)
class Lateness:
    """The deadlines of a run, and the function `when`, which returns the time of a submission."""

    deadlines: Deadlines
    when: Callable[[Submission], datetime | None]

    def applied(self, submissions: Sequence[Submission]) -> list[Submission]:
        """Return the submissions; each submission contains its late days.

        Raises GradingError if there is a deadline, but no submission has a time.
        """
        found = [self._dated(each) for each in submissions]
        due = [each for each in found if self._due(each) is not None]
        if due and all(NO_TIME in each.notes for each in due):
            raise GradingError(
                "--deadline needs the submission times, but no submission time is known. Use --times with "
                "Moodle's grading worksheet or with a table student,submitted. For nbgrader, use "
                "--times nbgrader."
            )
        return found

    def _due(self, submission: Submission) -> datetime | None:
        graded = submission.chapter and (submission.content or submission.packages)
        return self.deadlines.due(submission.student, submission.chapter) if graded else None

    def _dated(self, submission: Submission) -> Submission:
        due = self._due(submission)
        if due is None:
            return submission
        when = self.when(submission)
        if when is None:
            return replace(submission, notes=(*submission.notes, NO_TIME))
        late = self.deadlines.days_late(submission.student, submission.chapter, when)
        if not late:
            return submission
        days = self.deadlines.extensions.days(submission.student)
        extended = f", with an extension of {days:g} {'day' if days == 1 else 'days'}" if days else ""
        at = shown(when.astimezone(due.tzinfo))
        note = f"This chapter was handed in at {at}. The deadline was {shown(due)}{extended}."
        return replace(submission, late=late, notes=(*submission.notes, note))


def attempts_to_grade(
    submissions: Sequence[Submission], attempts: str, when: Callable[[Submission], datetime | None]
) -> list[Submission]:
    """Return all attempts if the best attempt counts; return the last attempts if the last attempt counts.

    If all attempts have known and different times, the last attempt is the attempt with the latest time.
    Otherwise, the last attempt is the attempt with the highest number or the newest file.
    """
    chosen = []
    for each in submissions:
        others = [replace(other, packages=each.packages) for other in each.attempts]
        if not others:
            chosen.append(each)
        elif attempts == BEST:
            chosen += [replace(other, attempts=()) for other in (each, *others)]
        else:
            chosen.append(_latest([*others, each], when))
    return chosen


def best_attempts(grades: Sequence[Grade]) -> list[Grade]:
    """Return the grade with the most points for each student and chapter.

    If two attempts have the same points, the later attempt is used.
    """
    by_chapter: dict[tuple[str, str, str], list[Grade]] = {}
    for grade in grades:
        by_chapter.setdefault((grade.student, grade.chapter, grade.chapter or grade.origin), []).append(grade)
    return list(_best(by_chapter.values()))


def _best(groups: Iterable[list[Grade]]) -> Iterator[Grade]:
    for group in groups:
        best = max(group, key=lambda grade: grade.earned)
        others = [grade.origin for grade in group if grade is not best]
        if others:
            note = _about(len(group), best.origin, others, "has the most points and counts")
            best = replace(best, notes=(*_without_note(best.notes), note))
        yield best


def _latest(given: Sequence[Submission], when: Callable[[Submission], datetime | None]) -> Submission:
    """Return the last attempt of a student for a chapter.

    If a time is unknown or two times are equal, return the last item of `given`.
    """
    times = [when(each) for each in given]
    stamps = [moment.timestamp() for moment in times if moment]
    if len(set(stamps)) < len(given):
        return given[-1]
    last = given[stamps.index(max(stamps))]
    if last is given[-1]:
        return last
    others = [each.origin for each in given if each is not last]
    note = _about(len(given), last.origin, others, "was handed in last and was graded")
    return replace(last, attempts=(), notes=(*_without_note(last.notes), note))


def _about(count: int, chosen: str, others: Sequence[str], why: str) -> str:
    return (
        f"This chapter was handed in {count} times: {chosen} {why}. These files do not count: "
        f"{', '.join(others[:3])}."
    )


def _without_note(notes: Sequence[str]) -> list[str]:
    return [
        note for note in notes if not (note.startswith("This chapter was handed in ") and " times: " in note)
    ]
