"""One fault: its cause, the program that shows its symptom, and the texts that describe it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course_pkg.faults.stage import Stage

HANG = 2.0  # A program that still runs after this time in s probably waits for ever.
START = 2.0  # A command gets this additional time in s, because its process has to start first.
TIMEOUT = 10.0  # A program that should end has to end within this time in s.


@dataclass(frozen=True)
class Fault:
    """One fault.

    Students first see only the text `story`. Later, they choose a diagnosis and a remedy; `diagnosis` and
    `remedy` are the correct choices. The function `play` causes the fault on a stage (see the module
    `stage`). `visitor` is a program or command that shows the symptom: the text of a Python program, or "$ "
    and a command line.

    `look` describes the symptom in one or two words. The first word names a group of symptoms, and the second
    word a subgroup of very similar symptoms. Students choose between the correct diagnosis and wrong
    diagnoses. The wrong diagnoses belong to other faults with a similar `look`. `unlike` contains faults with
    diagnoses that would also be correct; these diagnoses are not offered as wrong choices.
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
        """The time limit in s for the program or command that shows the symptom."""
        return (HANG + START if self.is_command else HANG) if self.hangs else TIMEOUT

    @property
    def is_command(self) -> bool:
        """Whether `visitor` is a command line, and not a Python program."""
        return self.visitor.startswith("$ ")
