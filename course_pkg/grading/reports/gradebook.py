"""The grades of a class, sorted for the reports."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from course_pkg.checking.report import Report, Verdict
from course_pkg.grading import clean
from course_pkg.grading.grade import NO_TIME, Grade
from course_pkg.grading.reports.asked import Asked, Column
from course_pkg.grading.roster.class_list import ClassList, Lists, origins_of
from course_pkg.grading.roster.people import Person

WITHOUT_SANDBOX = (
    "The code of this submission ran without a sandbox. It had access to the machine, to its check "
    "and to other submissions, so the points may be wrong."
)

ABSENT = "These results are from an earlier run. In the latest run, nothing was handed in for this chapter."


class Book:
    """The grades of a class, by student and chapter.

    A grade gets a note if the submission's code ran without a sandbox. A grade from an earlier run gets a
    note if the student submitted nothing for the chapter in the latest run.
    """

    def __init__(
        self, grades: Sequence[Grade], class_list: ClassList | None = None, asked: Asked | None = None
    ) -> None:
        self._asked = asked or Asked()
        self.class_list = class_list or Lists().matched(origins_of(grades))
        marked = [_with_warning(grade) for grade in grades]
        self.grades = tuple(sorted(marked, key=lambda grade: (grade.student, grade.chapter, grade.origin)))
        self.students = tuple(sorted({grade.student for grade in self.grades}))
        self.columns = tuple(_columns(self.grades, self._asked.columns))
        self.chapters = tuple(sorted({column.chapter for column in self.columns}))
        self.sandboxed = all(grade.sandboxed for grade in self.grades)
        self._by_student: dict[str, list[Grade]] = {student: [] for student in self.students}
        for grade in self.grades:
            self._by_student[grade.student].append(grade)

    def person(self, student: str) -> Person | None:
        """Return the identity of a student, or None if only the name of the folder is known."""
        return self.class_list.people.get(student)

    @property
    def identified(self) -> list[str]:
        """The students that a platform can identify. A platform's file has rows only for them."""
        return [student for student in self.students if student and student not in self.class_list.unclear]

    def of(self, student: str) -> list[Grade]:
        """Return the grades of a student, in the order of the chapters."""
        return self._by_student.get(student, [])

    def grade(self, student: str, chapter: str) -> Grade | None:
        """Return a student's grade for a chapter, or None if there is no grade."""
        return next((grade for grade in reversed(self.of(student)) if grade.chapter == chapter), None)

    def columns_of(self, chapter: str) -> list[Column]:
        """Return the parts of a chapter."""
        return [column for column in self.columns if column.chapter == chapter]

    def possible(self, chapter: str) -> float:
        """Return the highest possible points of a chapter."""
        return round(sum(column.possible for column in self.columns_of(chapter)), 2)

    def earned(self, student: str) -> float:
        """Return all points of a student after the deduction for lateness."""
        return round(sum(grade.earned for grade in self.of(student)), 2)

    def counted(self, student: str) -> list[str]:
        """Return the chapters that count for a student, even if the student has no submission."""
        return self._asked.counted(student, self._by_student.get(student, []), self.chapters)

    def possible_for(self, student: str) -> float:
        """Return the highest possible points of a student in all chapters that count."""
        return round(sum(map(self.possible, self.counted(student))), 2)

    @property
    def total(self) -> float:
        """The highest possible points of all chapters."""
        return round(sum(column.possible for column in self.columns), 2)


def report_of(grade: Grade | None, check: str) -> Report | None:
    """Return the report on a part, or None if there is no such report."""
    return next((report for report in grade.reports if report.check == check), None) if grade else None


def name_of(student: str) -> str:
    """Return a student's name as text for a report."""
    return clean.line(student, 120) or "(nobody)"


def points(value: float) -> str:
    """Return points as text for a report, such as "2", "1.5" or "0.33"."""
    return f"{value:.2f}".rstrip("0").rstrip(".")


def about_lateness(grade: Grade) -> str:
    """Return a message that tells a student how late the submission was, or "" if it was in time."""
    if grade.late <= 0:
        return ""
    late = f"Handed in {_duration(grade.late)} late"
    return f"{late}: {grade.factor:.0%} of the points count." if grade.factor < 1 else f"{late}."


def _duration(days: float) -> str:
    """Return a duration for a report, such as "2 days", "3.5 hours" or "10 minutes".

    A duration is never shown as 0.
    """
    units = ((days, "day"), (days * 24, "hour"), (days * 24 * 60, "minute"))
    value, unit = next((each for each in units if each[0] >= 1), units[-1])
    shown = points(max(value, 0.01) if unit == "day" else max(1.0, round(value, 1)))
    return f"{shown} {unit if shown == '1' else f'{unit}s'}"


def of_points(earned: float, possible: float) -> str:
    """Return the score as text, such as "1.5 of 2 points"."""
    return f"{points(earned)} of {points(possible)} {'point' if possible == 1 else 'points'}"


def attention(book: Book, student: str) -> list[str]:
    """Return why an instructor should examine a student's work, with the most serious reason first."""
    grades = book.of(student)
    return [
        *(clean.line(problem) for grade in grades if (problem := _problem(grade))),
        *(reason for grade in grades if (reason := _about(grade))),
        *(reason for grade in grades for reason in _inconclusive(grade)),
        *(
            (
                f"{report.check}: the answer has changed since its review. The points from the review "
                "still count."
            )
            for grade in grades
            for report in grade.reports
            if report.review and report.review.outdated
        ),
    ]


def not_handed_in(book: Book, student: str) -> str:
    """Return a sentence about the chapters that a student has not submitted, or ""."""
    there = {grade.chapter for grade in book.of(student)}
    missing = [chapter for chapter in book.counted(student) if chapter not in there]
    if not missing:
        return ""
    word = "chapter" if len(missing) == 1 else "chapters"
    return f"Nothing was handed in for {word} {', '.join(missing)}."


def notes(book: Book, student: str) -> list[str]:
    """Return the notes about a student's notebooks that attention() does not report."""
    known = (ABSENT, NO_TIME)  # attention() already reports these notes.
    found = (note for grade in book.of(student) for note in grade.notes if note not in known)
    return list(dict.fromkeys(clean.line(note) for note in found))


def reviews(book: Book, student: str) -> list[str]:
    """For each part that an instructor has reviewed, return a line about the review."""
    return [
        clean.line(f"{report.check}: {' '.join(report.about_review())}", 600)
        for grade in book.of(student)
        for report in grade.reports
        if report.review
    ]


def needs_look(grade: Grade) -> bool:
    """Return whether an instructor should examine this submission."""
    outdated = any(report.review and report.review.outdated for report in grade.reports)
    return bool(_problem(grade) or _about(grade) or _inconclusive(grade) or outdated)


def _problem(grade: Grade) -> str:
    """Return the problem of a submission, or "" if an instructor has reviewed all its parts."""
    return "" if grade.reports and all(report.review for report in grade.reports) else grade.problem


def _about(grade: Grade) -> str:
    if grade.absent:
        return (
            f"Chapter {grade.chapter}: the results are from an earlier run. This time, nothing was handed in."
        )
    undecided = [
        report for report in grade.reports if report.verdict is Verdict.UNDECIDED and not report.review
    ]
    if grade.problem or not grade.reports:
        return ""
    if undecided:
        why = next((report.note for report in undecided if report.note), "no reason was recorded")
        return f"{', '.join(report.check for report in undecided)} not examined: {clean.line(why, 160)}"
    if NO_TIME in grade.notes:
        return f"Chapter {grade.chapter}: {NO_TIME}"
    reviewed = any(report.review for report in grade.reports)
    return "" if grade.earned or reviewed else f"The student has 0 points in chapter {grade.chapter}."


def _inconclusive(grade: Grade) -> list[str]:
    """Return a sentence for each part with a check that could not finish."""
    return [
        f"{report.check} has 0 points, because the check could not finish. Look at the answer. "
        f"{clean.line(report.note, 160)}"
        for report in grade.reports
        if report.inconclusive and not report.review
    ]


def _with_warning(grade: Grade) -> Grade:
    warnings = [ABSENT] if grade.absent else []
    warnings += [] if grade.sandboxed else [WITHOUT_SANDBOX]
    others = [note for note in grade.notes if note not in (ABSENT, WITHOUT_SANDBOX)]
    return replace(grade, notes=(*warnings, *others))


def _columns(grades: Sequence[Grade], asked: Sequence[Column]) -> list[Column]:
    found = {column.check: column for column in asked}
    for grade in grades:
        for report in grade.reports:
            known = found.get(report.check, Column(report.check, grade.chapter, "", 0))
            possible = max(known.possible, report.possible)
            found[report.check] = Column(report.check, known.chapter, known.goal or report.goal, possible)
    return sorted(found.values(), key=lambda column: (column.chapter, _numbers(column.check)))


def _numbers(check: str) -> list[tuple[int, str]]:
    return [(int(part), "") if part.isdecimal() else (1 << 30, part) for part in check.split(".")]
