"""The checks: each is a node of its own that looks at a student's work from outside.

A notebook calls `check("05.1")` and `results("05")`. An author declares a check with `part`, and works
with the `Exam` that it is given; `says` makes a pattern for its hints.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.examiner.desk import check
    from course_pkg.examiner.exam import Exam, Its
    from course_pkg.examiner.ledger import says
    from course_pkg.examiner.parts import part
    from course_pkg.examiner.scripted import HangUp, Late, Refuse, Silence
    from course_pkg.examiner.summary import results

__all__ = ["Exam", "HangUp", "Its", "Late", "Refuse", "Silence", "check", "part", "results", "says"]

__getattr__ = lazily(
    __name__,
    {
        "desk": "check",
        "exam": "Exam Its",
        "ledger": "says",
        "parts": "part",
        "scripted": "HangUp Late Refuse Silence",
        "summary": "results",
    },
)
