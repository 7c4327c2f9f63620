"""A student's notebook as it was handed in: any version, any disorder, read within bounds."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from course_pkg.errors import GradingError

BRACKETS = 500_000  # lists and objects in the file: 20 MiB of them would be half a GB in memory
CELLS = 50_000
PREFIXES = {
    b"<!doctype": "it is a web page: the page around the notebook was saved; use Download there",
    b"<html": "it is a web page: the page around the notebook was saved; use Download there",
    b"<<<<<<<": "two versions of it were merged and the marks of git were left in it; take one of the two",
    b"%pdf": "it is a PDF of the notebook; hand in the .ipynb itself",
    b"pk\x03\x04": "it is a zip under a notebook's name; hand in the .ipynb itself",
}
WRONG = (
    KeyError,
    AttributeError,
    TypeError,
    ValueError,
    IndexError,
    RecursionError,
)  # of a broken old notebook


@dataclass(frozen=True)
class StudentCell:
    """One cell, as far as grading looks at it."""

    id: str
    kind: str  # "code", "markdown", "raw"
    source: str
    exercise: str = ""  # the part that its metadata say it answers
    check: str = ""  # or checks
    tags: tuple[str, ...] = ()


def read_cells(content: bytes) -> list[StudentCell]:
    """Return the cells of a notebook; raise GradingError, in half a sentence, for what is none."""
    cells = _all_cells(_parsed(content))
    if not isinstance(cells, list):
        raise GradingError("it is no notebook, as it has no cells; hand in the .ipynb that you worked in")
    if len(cells) > CELLS:
        raise GradingError(f"it has more than {CELLS} cells; hand in the notebook that you worked in")
    return list(_cells(cells))


def slimmed(cells: Sequence[StudentCell]) -> bytes:
    """Return a notebook of what grading looks at: a class's outputs and pictures would fill the memory."""
    kept = [
        {
            "id": cell.id,
            "cell_type": cell.kind,
            "source": cell.source,
            "metadata": {"course": {"exercise": cell.exercise, "check": cell.check}, "tags": list(cell.tags)},
        }
        for cell in cells
    ]
    return json.dumps({"cells": kept, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}).encode()


def _parsed(content: bytes) -> dict[str, Any]:
    start = content[:4096].removeprefix(b"\xef\xbb\xbf").lstrip()[:16].lower()
    if not start:
        raise GradingError("it is empty; save the notebook once more, and hand it in again")
    if content.count(b"{") + content.count(b"[") > BRACKETS:
        raise GradingError(f"it holds more than {BRACKETS} lists and objects; clear its outputs")
    try:
        data = json.loads(content)
    except (ValueError, RecursionError) as error:
        why = next((words for prefix, words in PREFIXES.items() if start.startswith(prefix)), "")
        raise GradingError(
            why or "it is no notebook, being not JSON; hand in the .ipynb that you worked in"
        ) from error
    if not isinstance(data, dict):
        raise GradingError("it is JSON, but nothing with cells; hand in the .ipynb that you worked in")
    return data


def _all_cells(data: dict[str, Any]) -> object:
    """Return the cells of any format: up to version 3 they lie in worksheets.

    nbformat's own upgrade would first hold an old notebook to its schema, which takes seconds for a long one
    and writes what it holds to a log.
    """
    sheets = data.get("worksheets")
    if "cells" in data or not isinstance(sheets, list):
        return data.get("cells")
    lists = [sheet.get("cells") for sheet in sheets if isinstance(sheet, dict)]
    return [cell for cells in lists if isinstance(cells, list) for cell in cells]


def _cells(cells: list[Any]) -> Iterator[StudentCell]:
    for cell in cells:
        if isinstance(cell, dict):
            metadata = cell.get("metadata")
            metadata = metadata if isinstance(metadata, dict) else {}
            course, tags = metadata.get("course"), metadata.get("tags")
            course = course if isinstance(course, dict) else {}
            yield StudentCell(
                _text(cell.get("id")),
                _text(cell.get("cell_type")),
                _joined(cell.get("source", cell.get("input"))),
                _text(course.get("exercise")),
                _text(course.get("check")),
                tuple(tag for tag in tags if isinstance(tag, str)) if isinstance(tags, list) else (),
            )


def _text(value: object) -> str:
    return value if isinstance(value, str) else ""


def _joined(source: object) -> str:
    if isinstance(source, list):
        return "".join(part for part in source if isinstance(part, str))
    return _text(source)
