"""The checks: each check is a separate node that examines a student's work from outside the kernel.

A notebook calls `check("05.1")`. An author declares a check with the decorator `part`; the check receives a
`CheckContext`. The function `matches` returns a condition for a hint. The condition `ANYTHING` matches every
value.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.checking.assertions import ANYTHING, matches
    from course_pkg.checking.context import CheckContext, Its
    from course_pkg.checking.parts import part
    from course_pkg.checking.peers.scripted_server import HangUp, Late, Refuse, Silence
    from course_pkg.checking.processes.client import check

__all__ = [
    "ANYTHING",
    "CheckContext",
    "HangUp",
    "Its",
    "Late",
    "Refuse",
    "Silence",
    "check",
    "matches",
    "part",
]

__getattr__ = lazily(
    __name__,
    {
        "processes.client": "check",
        "context": "CheckContext Its",
        "assertions": "ANYTHING matches",
        "parts": "part",
        "peers.scripted_server": "HangUp Late Refuse Silence",
    },
)
