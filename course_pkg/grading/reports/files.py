"""Files that are there whole or not at all."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Sequence
from pathlib import Path


def put(path: Path, text: str, encoding: str = "utf-8") -> None:
    """Write `text` to `path`, making the folders above it; a reader never meets half of it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        draft.write_text(text, encoding, newline="")
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def put_table(path: Path, rows: Sequence[Sequence[str]], encoding: str = "utf-8") -> None:
    """Write rows of cells that are clean as CSV (RFC 4180)."""
    buffer = io.StringIO()
    csv.writer(buffer).writerows(rows)
    put(path, buffer.getvalue(), encoding)
