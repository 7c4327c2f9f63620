"""What crosses the outer wall: the work for one part, and how it ended."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from course_pkg.examiner.report import Report, report_from

SETTLING = 25.0  # s for the cells before and after the answer, nodes that start included
ANSWER = 20.0  # s for a student's cell


@dataclass(frozen=True)
class PartJob:
    """One part: the cells to run, and the check to carry out after them.

    `before` and `after` are the reference's; `answers` are the student's cells, the part's own the last.
    """

    check: str
    before: str
    answers: tuple[str, ...]
    after: str
    seed: int
    deadline: float  # s, of the check itself
    settling: float = SETTLING
    patience: float = ANSWER

    @property
    def limit(self) -> float:
        """Return after how many seconds everything of this part is ended."""
        return self.settling + self.patience * len(self.answers) + self.deadline

    def as_dict(self) -> dict[str, Any]:
        """Return the job as plain data."""
        return asdict(self)


def job_from(data: dict[str, Any]) -> PartJob:
    """Return the job that `data`, made by `as_dict`, describes."""
    return PartJob(**{**data, "answers": tuple(data["answers"])})


@dataclass(frozen=True)
class PartOutcome:
    """How a part ended: the judge's record, if it made one, and what the student's side said meanwhile."""

    record: dict[str, Any] | None
    ending: str  # why there is no record, in words; empty where there is one
    said: tuple[dict[str, Any], ...] = ()  # never believed: errors of cells, for feedback
    took: float = 0.0  # s
    lost: bool = False  # with the process that runs submissions: nobody knows what the answer is worth

    @property
    def report(self) -> Report | None:
        """The judge's report, where there is a record."""
        if self.record is None:
            return None
        fields = Report.__dataclass_fields__
        return report_from({key: value for key, value in self.record.items() if key in fields})

    def as_dict(self) -> dict[str, Any]:
        """Return the outcome as plain data."""
        return asdict(self)


def outcome_from(data: dict[str, Any]) -> PartOutcome:
    """Return the outcome that `data`, made by `as_dict`, describes."""
    return PartOutcome(**{**data, "said": tuple(data["said"])})
