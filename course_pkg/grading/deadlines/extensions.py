"""The extensions of students: the column `extension_days` of the roster."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from course_pkg.errors import GradingError
from course_pkg.grading.roster.people import Person

COLUMN = "extension_days"
FOLDED = "extension days"  # read_roster() replaces each underscore in a column's name by a space.


@dataclass(frozen=True)
class Extensions:
    """The additional days of each student; the keys are the students' names in the grades."""

    by_student: Mapping[str, float] = field(default_factory=dict)

    def days(self, student: str) -> float:
        """Return how many days are added to a student's deadlines."""
        return self.by_student.get(student, 0.0)


def extensions_of(people: Mapping[str, Person]) -> Extensions:
    """Return the deadline extension of each student in the roster; an empty cell means no extension.

    Raises GradingError if a value is not a number of days.
    """
    return Extensions({student: days for student, person in people.items() if (days := _days(person))})


def _days(person: Person) -> float:
    written = person.more.get(FOLDED, "")
    try:
        days = float(written.replace(",", ".")) if written else 0.0
    except ValueError:
        days = math.nan
    if not 0 <= days < 10_000:
        raise GradingError(
            f"Line {person.line} of the roster: the value in the column {COLUMN} is not a number of days. "
            "Write a number of at least 0, or leave this cell empty."
        )
    return days
