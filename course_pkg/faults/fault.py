"""One fault: its cause, the program that shows its symptom, and the texts about it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course_pkg.faults.stage import Stage

HANG = 2.0  # s; a program that still waits after this time is assumed to wait for ever
START = 2.0  # s; the extra time for a command, because its process has to start first
TIMEOUT = 10.0  # s; the time limit for a program that ends by itself


@dataclass(frozen=True)
class Fault:
    """One fault. At first students see only `story`; `diagnosis` and `remedy` are the correct choices.

    `play` causes the fault on a stage. `visitor` shows the symptom: it is the text of a Python program, or
    "$ " and a command line. `look` names the kind of symptom: a word for the group of similar symptoms, and
    sometimes a second word for very similar symptoms. The wrong diagnoses that a student can choose belong to
    faults with a similar `look`. The diagnoses of the faults in `unlike` are never offered as wrong choices,
    because they would be correct, too.
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
        """The time limit for the visitor in s."""
        return (HANG + START if self.is_command else HANG) if self.hangs else TIMEOUT

    @property
    def is_command(self) -> bool:
        """Whether the visitor is a command line, and not a Python program."""
        return self.visitor.startswith("$ ")
