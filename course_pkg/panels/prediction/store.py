"""What is kept of a prediction."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.panels.store import Store


@dataclass(frozen=True)
class Record:
    """One question with what was predicted and, once it has been compared, what really happened.

    Times are ISO 8601 in UTC, "" for not yet. `answer` is the latest, `first` the one that stood when the
    two were compared, so that a change of mind afterwards can be told.
    """

    key: str
    question: str
    answer: str = ""
    answered: str = ""
    actual: str = ""
    compared: str = ""
    first: str = ""

    @property
    def changed_after(self) -> bool:
        """Whether the answer was given or changed when the result was already known."""
        return bool(self.compared and self.answer != self.first)


class PredictionStore(Store[Record]):
    """The records in one file, by key."""

    row = Record
    file = "predictions.json"
    what = "predictions"
