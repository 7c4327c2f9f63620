"""What is kept of the answers to the cases."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.panels.store import Store


@dataclass(frozen=True)
class CaseRecord:
    """One case, by the name of its fault: how often it was answered, and how.

    `first` is whether the first answer was right, `solved` whether any was, `shown` whether the answer was
    looked at before that.
    """

    key: str
    tries: int = 0
    first: bool = False
    solved: bool = False
    shown: bool = False

    @property
    def state(self) -> str:
        """How it stands: "new", "wrong", "shown" or "solved"."""
        if self.solved:
            return "solved"
        return "shown" if self.shown else "wrong" if self.tries else "new"


class CaseStore(Store[CaseRecord]):
    """The records in one file, by fault."""

    row = CaseRecord
    file = "cases.json"
    what = "answers to cases"
