"""What a student committed to, on disk: one JSON file a kind, written whole or not at all."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any, ClassVar, Generic, Protocol, TypeVar

from course_pkg.errors import PredictionsBroken
from course_pkg.state import state_folder, write_json


class Keyed(Protocol):
    """A dataclass with a key such as "05.reply_none"."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    @property
    def key(self) -> str:
        """The chapter and the name of the question."""


Row = TypeVar("Row", bound=Keyed)


class Store(Generic[Row]):
    """The records of one kind, by key, in a file of the course's state or at `path`."""

    row: type[Row]
    file: ClassVar[str]
    what: ClassVar[str]

    def __init__(self, path: Path | None = None) -> None:
        self.path = path or state_folder() / self.file

    def read(self) -> dict[str, Row]:
        """All records; none when there is no file yet. Raises PredictionsBroken."""
        try:
            rows = json.loads(self.path.read_text(encoding="utf-8"))
            return {key: self.row(**row) for key, row in rows.items()}
        except FileNotFoundError:
            return {}
        except (OSError, ValueError, TypeError, AttributeError) as error:
            raise PredictionsBroken(
                f"{self.path} does not hold {self.what} as the course writes them ({error}). "
                "Move the file away to start afresh."
            ) from error

    def write(self, record: Row) -> None:
        """Keep a record in place of the one with its key."""
        records = {**self.read(), record.key: record}
        write_json(self.path, {key: asdict(each) for key, each in records.items()})
