"""One thing that goes wrong: how it is caused, what is seen of it, and what there is to say about it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from course_pkg.faults.stage import Stage

HANG = 2.0  # s after which a program that waits is taken to wait for ever
START = 2.0  # s more for a command, which has its start before it
PATIENCE = 10.0  # s for one that comes to an end by itself


@dataclass(frozen=True)
class Fault:
    """One fault. `story` is all that a student is told; `diagnosis` and `remedy` are what they choose.

    `play` causes it on a stage. `visitor` is what shows it: the text of a Python program, or a command line.
    `look` names what symptoms have in common, a word for the family and one more for those that are closest,
    so that wrong diagnoses come from faults that look alike. Those named in `unlike` are not offered, since
    they would be true here, too.
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
    def patience(self) -> float:
        """How long its symptom is watched, in s."""
        return (HANG + START if self.is_command else HANG) if self.hangs else PATIENCE

    @property
    def is_command(self) -> bool:
        """Whether the visitor is a command line and no Python."""
        return self.visitor.startswith("$ ")
