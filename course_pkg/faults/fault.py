"""One fault: how it is caused, what shows it, and the texts about it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course_pkg.faults.stage import Stage

HANG = 2.0  # s after which a waiting program is taken to wait for ever
START = 2.0  # s more for a command, which has to start first
TIMEOUT = 10.0  # s for a program that ends by itself


@dataclass(frozen=True)
class Fault:
    """One fault. Students see only `story`; `diagnosis` and `remedy` are the right choices.

    `play` causes it on a stage. `visitor` shows it: the text of a Python program, or a command line after
    "$ ". `look` names the kind of symptom, a word for the family and one more for the closest faults, so that
    the wrong diagnoses belong to faults with a similar symptom. The faults named in `unlike` are not offered,
    since they would be right here, too.
    """

    name: str
    group: str
    look: str
    story: str
    play: Callable[[Stage], None]
    visitor: str
    diagnosis: str
    remedy: str
    reason: str
    chapter: str
    hangs: bool = False
    unlike: tuple[str, ...] = ()

    @property
    def timeout(self) -> float:
        """For how many s its symptom is watched."""
        return (HANG + START if self.is_command else HANG) if self.hangs else TIMEOUT

    @property
    def is_command(self) -> bool:
        """Whether the visitor is a command line and no Python."""
        return self.visitor.startswith("$ ")
