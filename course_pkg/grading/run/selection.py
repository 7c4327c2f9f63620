"""The selection of a run: which students, chapters and parts are graded.

The results of students, chapters and parts that are not selected do not change.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from course_pkg.checking.parts import find
from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.grade import IN_PACKAGES, Grade, Submission

# PLATFORM_ID matches the number that Moodle and Canvas add to the end of a student's name.
PLATFORM_ID = re.compile(r"_\d+$")


@dataclass(frozen=True)
class Selection:
    """The options --student, --part and --chapters; an empty tuple means all students, parts or chapters."""

    students: tuple[str, ...] = ()
    chapters: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()

    @property
    def again(self) -> bool:
        """Whether the selected notebooks are graded again even if nothing has changed."""
        return bool(self.students or self.parts)

    @property
    def everything(self) -> bool:
        """Whether everything is selected, because no option was given."""
        return not (self.students or self.chapters or self.parts)

    def covers(self, student: str, chapter: str) -> bool:
        """Return whether this run grades a student's submission for a chapter; an unknown chapter is ""."""
        if self.students and student not in self.students:
            return False
        return not self.chapters or chapter in ("", *self.chapters)

    def only(self, graded: Sequence[Grade]) -> Selection:
        """Return a selection that contains exactly the students and chapters of the grades `graded`."""
        students, chapters = {each.student for each in graded}, {each.chapter for each in graded}
        return replace(self, students=tuple(students), chapters=tuple(chapters))

    def of(self, submissions: Sequence[Submission]) -> list[Submission]:
        """Return the selected submissions."""
        return [each for each in submissions if self.covers(each.student, each.chapter)]

    def parts_of(self, chapter: str) -> tuple[str, ...]:
        """Return the selected parts of a chapter."""
        return tuple(each for each in self.parts if each.partition(".")[0] == chapter)

    def for_students(self, submissions: Sequence[Submission]) -> Selection:
        """Return the selection with the students' full names.

        Raises GradingError if a name matches no student, or several students.
        """
        known = sorted({each.student for each in submissions if each.student})
        return replace(self, students=tuple(_student(name, known) for name in self.students))


def selection(students: Sequence[str], chapters: Sequence[str], parts: Sequence[str]) -> Selection:
    """Return the selection for these options; a part also selects its chapter.

    Raises UnknownCheck if a part does not exist, and GradingError if --chapters does not contain the part's
    chapter.
    """
    checks = tuple(dict.fromkeys(find(two_digits(part)).check for part in parts))
    asked = tuple(dict.fromkeys(check.partition(".")[0] for check in checks))
    if chapters and (outside := [check for check in checks if check.partition(".")[0] not in chapters]):
        raise GradingError(
            f"--part {outside[0]} is not in --chapters {','.join(chapters)}. Give only one of the "
            "two options."
        )
    return Selection(tuple(students), asked or tuple(chapters), checks)


def two_digits(number: str) -> str:
    """Return the id of a chapter or part with two digits for the chapter, such as "05.1" for "5.1"."""
    chapter, dot, rest = number.strip().partition(".")
    return f"{chapter.zfill(2)}{dot}{rest}"


def merged(base: Grade, again: Grade) -> Grade:
    """Return the grade `base` with the new reports of the grade `again`.

    The grade `again` contains only the selected parts.
    """
    fresh = {report.check: report for report in again.reports}
    reports = [fresh.pop(report.check, report) for report in base.reports]
    reports = sorted([*reports, *fresh.values()], key=lambda report: list(map(int, report.check.split("."))))
    packaged = [note for note in base.notes if note.startswith(IN_PACKAGES)]
    return replace(
        base,
        reports=tuple(reports),
        notes=(*packaged, *(note for note in again.notes if not note.startswith(IN_PACKAGES))),
        late=again.late,
        origin=again.origin,
        key=again.key if base.key == again.key else "",
        private=tuple(dict.fromkeys([*base.private, *again.private])),
        sandboxed=base.sandboxed and again.sandboxed,
        absent=False,
    )


def _student(name: str, known: Sequence[str]) -> str:
    """Return the full name of the student with the name `name`.

    `name` may lack the number that a platform adds to a name.
    """
    identity = clean.identity(name)
    if identity in known:
        return identity
    wanted = identity.casefold()
    found = [each for each in known if wanted in (each.casefold(), PLATFORM_ID.sub("", each).casefold())]
    if len(found) == 1:
        return found[0]
    how = f"fits {len(found)} students" if found else "is not the name of a student who handed in something"
    raise GradingError(
        f"--student {clean.line(name, 80)} {how}. Give a name from the column `student` of "
        "grades.csv. These names are also the names of the folders."
    )
