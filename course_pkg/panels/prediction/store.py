"""Predictions on disk: one JSON file for each checkout of the course, written whole or not at all."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from course_pkg.errors import PredictionsBroken
from course_pkg.state import state_folder, write_json


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


class PredictionStore:
    """The records in one file, by key."""

    def __init__(self, path: Path | None = None) -> None:
        self.path = path or state_folder() / "predictions.json"

    def read(self) -> dict[str, Record]:
        """All records; none when there is no file yet. Raises PredictionsBroken."""
        try:
            rows = json.loads(self.path.read_text(encoding="utf-8"))
            return {key: Record(**row) for key, row in rows.items()}
        except FileNotFoundError:
            return {}
        except (OSError, ValueError, TypeError, AttributeError) as error:
            raise PredictionsBroken(
                f"{self.path} does not hold predictions as the course writes them ({error}). "
                "Move the file away to start afresh."
            ) from error

    def write(self, record: Record) -> None:
        """Keep a record in place of the one with its key."""
        records = {**self.read(), record.key: record}
        write_json(self.path, {key: asdict(each) for key, each in records.items()})
