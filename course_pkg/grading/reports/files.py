"""Writes tables; each file is written completely or not at all."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path

from course_pkg.files import write_atomically


def put_table(path: Path, rows: Sequence[Sequence[str]], encoding: str = "utf-8") -> None:
    """Write rows to a CSV file (RFC 4180).

    The caller must apply clean.cell() to each text from a student.
    """
    buffer = io.StringIO()
    csv.writer(buffer).writerows(rows)
    write_atomically(path, buffer.getvalue(), encoding)
