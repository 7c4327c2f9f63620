"""The student's predictions, choices and answers on disk: one JSON file for each kind."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Generic, Protocol, TypeVar

from course_pkg.errors import InvalidPredictions
from course_pkg.state import locked, state_folder, write_json

if TYPE_CHECKING:
    from dataclasses import Field


class Keyed(Protocol):
    """A dataclass with a key such as "05.reply_none"."""

    __dataclass_fields__: ClassVar[dict[str, Field[object]]]

    @property
    def key(self) -> str:
        """The chapter and the name, with a dot between them."""


Record = TypeVar("Record", bound=Keyed)


class Store(Generic[Record]):
    """The records of one kind, by key, in the file `path`; by default in the state folder of the course."""

    record: type[Record]
    file: ClassVar[str]
    what: ClassVar[str]

    def __init__(self, path: Path | None = None) -> None:
        self.path = path or state_folder() / self.file

    def read(self) -> dict[str, Record]:
        """Return all records by key, or {} if there is no file yet. Raises InvalidPredictions."""
        try:
            records = json.loads(self.path.read_text(encoding="utf-8"))
            return {key: self._checked(self.record(**record)) for key, record in records.items()}
        except FileNotFoundError:
            return {}
        except (OSError, ValueError, TypeError, AttributeError) as error:
            raise InvalidPredictions(
                f"{self.path} does not contain valid {self.what} ({error}). "
                "Move the file to another folder to start again without them."
            ) from error

    def _checked(self, record: Record) -> Record:
        """Return `record` if its fields have the declared types. Otherwise, raise TypeError."""
        for each in fields(record):
            if type(getattr(record, each.name)).__name__ != str(each.type).partition("[")[0]:
                raise TypeError(f"{each.name} of {record.key} is not of the type {each.type}")
        return record

    def write(self, record: Record) -> Record:
        """Store a record in place of the record with the same key, and return it.

        The whole file is replaced while a lock is held. So a record that another kernel writes at the same
        time is not lost. Raises the same errors as `read`, and OSError if the file cannot be written.
        """
        with locked(self.path.parent):
            records = {**self.read(), record.key: record}
            write_json(self.path, {key: asdict(each) for key, each in records.items()})
        return record


def of_chapter(records: Iterable[Record], chapter: str) -> list[Record]:
    """Return the records of a chapter, or all records if `chapter` is "", sorted by key.

    The chapter `05` has, for example, the record `05.reply_none`.
    """
    chosen = (each for each in records if not chapter or each.key.startswith(f"{chapter}."))
    return sorted(chosen, key=lambda each: each.key)
