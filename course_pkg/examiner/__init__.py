"""The checks: each is a node of its own that looks at a student's work from outside.

A notebook calls `check("05.1")` and `results("05")`. An author declares a check with `part`, and works
with the `Exam` that it is given; `says` makes a pattern for its hints.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from course_pkg.examiner.desk import check
    from course_pkg.examiner.exam import Exam, Its
    from course_pkg.examiner.ledger import says
    from course_pkg.examiner.parts import part
    from course_pkg.examiner.scripted import HangUp, Late, Refuse, Silence
    from course_pkg.examiner.summary import results

__all__ = ["Exam", "HangUp", "Its", "Late", "Refuse", "Silence", "check", "part", "results", "says"]


def __getattr__(name: str) -> Any:  # noqa: ANN401 -- PEP 562: a module's attribute is of any type
    """Look names up on first use: the notebook's need no rospy of the examiner's."""
    homes = {
        "Exam": "exam",
        "HangUp": "scripted",
        "Its": "exam",
        "Late": "scripted",
        "Refuse": "scripted",
        "Silence": "scripted",
        "check": "desk",
        "part": "parts",
        "results": "summary",
        "says": "ledger",
    }
    if name not in homes:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{homes[name]}"), name)
