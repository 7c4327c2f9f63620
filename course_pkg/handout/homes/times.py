"""times.csv: when each collected file was last changed, so that a deadline can be computed.

Its columns are student, chapter, file and time. The file is a path in the folder of submissions, and the time
is that of the file (mtime) in ISO 8601 with its time zone. A package has a row for each of its files, and one
for its folder with the time of its newest file; if several chapters ask for it, each has these rows.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Collection, Iterable
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

from course_pkg.errors import HandoutError
from course_pkg.files import write_atomically
from course_pkg.grading.intake.naming import TIMES

COLUMNS = ["student", "chapter", "file", "time"]


class Row(NamedTuple):
    """One collected file or package: its path in the folder of submissions, and its time."""

    student: str
    chapter: str
    file: str
    time: str

    @property
    def unit(self) -> tuple[str, str]:
        """The student, and the notebook or package that the file belongs to; it is collected as a whole."""
        return self.student, "/".join(self.file.split("/")[:2])


def iso_time(nanoseconds: int) -> str:
    """Return a time in ns since 1970 in ISO 8601, with seconds and this machine's time zone."""
    return datetime.fromtimestamp(nanoseconds / 1e9).astimezone().isoformat(timespec="seconds")


class TimesTable:
    """The table in a folder of submissions."""

    def __init__(self, folder: Path) -> None:
        """Read it.

        Raises HandoutError if the folder contains files and has no such table.
        """
        self._path = folder / TIMES
        self._rows = self._read(folder)

    def replace(self, units: Collection[tuple[str, str]], rows: Iterable[Row]) -> None:
        """Replace the rows of the notebooks and packages `units` by `rows`, and write the table."""
        kept = [row for row in self._rows if row.unit not in units]
        self._rows = sorted([*kept, *rows])
        text = io.StringIO(newline="")
        table = csv.writer(text, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(self._rows)
        write_atomically(self._path, text.getvalue())

    def _read(self, folder: Path) -> list[Row]:
        try:
            if not folder.exists() or all(path.name.startswith(".") for path in folder.iterdir()):
                return []
            with self._path.open(encoding="utf-8", newline="") as file:
                lines = list(csv.reader(file))
            if lines and lines[0] == COLUMNS:
                return [Row(*line) for line in lines[1:] if len(line) == len(COLUMNS)]
        except (OSError, ValueError, csv.Error):
            pass  # the message is the same
        raise HandoutError(
            f"{folder} exists, and `course collect` did not make it (it has no {TIMES} with the columns "
            f"{', '.join(COLUMNS)}), so nothing was collected. Give a new or an empty folder."
        )
