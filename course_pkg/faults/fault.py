"""One fault: its cause, the program that shows its symptom, and the texts that describe it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course_pkg.faults.stage import Stage

HANG = 2.0  # s; a program that still waits after this time is assumed to wait for ever
START = 2.0  # s; the extra time for a command, because its process has to start first
TIMEOUT = 10.0  # s; the time limit for a program that ends by itself


@dataclass(frozen=True)
class Fault:
    """One fault. At first, students see only `story`; `diagnosis` and `remedy` are the correct choices.

    The function `play` causes the fault on a stage (see the module `stage`). `visitor` shows the symptom: it
    is the text of a Python program, or "$ " and a command line. `look` names the kind of symptom: its first
    word names a group of similar symptoms, and its second word, if any, names a smaller group of very similar
    symptoms. The wrong diagnoses that a student can choose belong to faults with a similar `look`. The
    diagnoses of the faults in `unlike` are never offered as wrong choices, because they would also be
    correct.
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
        """The time limit in s for the visitor."""
        return (HANG + START if self.is_command else HANG) if self.hangs else TIMEOUT

    @property
    def is_command(self) -> bool:
        """Whether the visitor is a command line, and not a Python program."""
        return self.visitor.startswith("$ ")
