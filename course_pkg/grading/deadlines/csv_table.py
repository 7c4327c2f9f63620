"""Reads a CSV table in which the first line contains the names of the columns."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from course_pkg.grading.tables import table_rows


@dataclass(frozen=True)
class Row:
    """The values of a row; the keys are the names of the columns in lower case.

    Error messages contain the line number of the row in the file.
    """

    where: str  # `where` is the file and the line, such as "times.csv, line 3".
    values: dict[str, str]

    def get(self, *columns: str) -> str:
        """Return the first value in the columns `columns` that is not empty, or ""."""
        return next((value for name in columns if (value := self.values.get(name, ""))), "")


def read_rows(path: Path, what: str) -> tuple[list[str], list[Row]]:
    """Return the names of the columns in lower case, and the rows that are not empty."""
    lines = table_rows(path, what)
    head = [name.strip().lower() for name in lines[0]] if lines else []
    rows = [
        Row(f"{path.name}, line {number}", dict(zip(head, map(str.strip, cells), strict=False)))
        for number, cells in enumerate(lines[1:], 2)
        if any(cell.strip() for cell in cells)
    ]
    return head, rows
