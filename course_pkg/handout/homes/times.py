"""times.csv contains the time of the last change of each collected file.

The grader compares these times with the deadlines.

The columns are student, chapter, file and time. The column `file` contains a path relative to the folder of
submissions. The column `time` contains the file's modification time in ISO 8601 with a time zone. A package
has a row for each of its files, and a row for its folder with the time of its newest file. If several
chapters require the package, the table has these rows for each chapter.
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
        """The student, and the notebook or the package to which the file belongs."""
        return self.student, "/".join(self.file.split("/")[:2])


def iso_time(nanoseconds: int) -> str:
    """Return a time (ns since 1970) in ISO 8601, with seconds and this machine's time zone."""
    return datetime.fromtimestamp(nanoseconds / 1e9).astimezone().isoformat(timespec="seconds")


class TimesTable:
    """The table of times in a folder of submissions."""

    def __init__(self, folder: Path) -> None:
        """Read the table.

        Raises HandoutError if the folder contains files, but no valid table of times.
        """
        self._path = folder / TIMES
        self._rows = self._read(folder)

    def replace(self, units: Collection[tuple[str, str]], rows: Iterable[Row]) -> None:
        """Replace the rows of the notebooks and packages in `units` by the new rows, and write the table."""
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
            pass  # If the file has another format, the code below raises an error.
        raise HandoutError(
            f"Nothing was collected, because {folder} contains no {TIMES} with the columns "
            f"{', '.join(COLUMNS)}. Give a new folder, an empty folder, or a folder that `course collect` "
            "created."
        )
