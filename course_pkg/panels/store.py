"""Stores the student's predictions, choices and answers on disk, in three JSON files."""

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
    """A dataclass with the attribute `key`, such as "05.reply_none"."""

    __dataclass_fields__: ClassVar[dict[str, Field[object]]]

    @property
    def key(self) -> str:
        """The chapter and a name, separated by a dot."""


Record = TypeVar("Record", bound=Keyed)


class Store(Generic[Record]):
    """All records of one class in the file `path`; by default, the file is in the course's state folder."""

    record: type[Record]
    file: ClassVar[str]
    what: ClassVar[str]

    def __init__(self, path: Path | None = None) -> None:
        self.path = path or state_folder() / self.file

    def read(self) -> dict[str, Record]:
        """Return a dict of all records by key, or {} if the file does not exist yet.

        Raises InvalidPredictions if the file is not valid.
        """
        try:
            records = json.loads(self.path.read_text(encoding="utf-8"))
            return {key: self._checked(self.record(**record)) for key, record in records.items()}
        except FileNotFoundError:
            return {}
        except (OSError, ValueError, TypeError, AttributeError) as error:
            raise InvalidPredictions(
                f"{self.path} does not contain valid {self.what} ({error}). Move this file to "
                "a different folder, and start again."
            ) from error

    def _checked(self, record: Record) -> Record:
        """Return the record if its fields have the declared types. Otherwise, raise TypeError."""
        for each in fields(record):
            if type(getattr(record, each.name)).__name__ != str(each.type).partition("[")[0]:
                raise TypeError(f"{each.name} of {record.key} is not of the type {each.type}")
        return record

    def write(self, record: Record) -> Record:
        """Store a record, and return it; an earlier record with the same key is replaced.

        The file has a lock: if two kernels write records, both records are saved. Raises the same errors as
        `read`, and OSError if the file cannot be written.
        """
        with locked(self.path.parent):
            records = {**self.read(), record.key: record}
            write_json(self.path, {key: asdict(each) for key, each in records.items()})
        return record


def of_chapter(records: Iterable[Record], chapter: str) -> list[Record]:
    """Return the records of a chapter, or all records if `chapter` is "", sorted by key.

    For example, the record `05.reply_none` belongs to the chapter `05`.
    """
    chosen = (each for each in records if not chapter or each.key.startswith(f"{chapter}."))
    return sorted(chosen, key=lambda each: each.key)
