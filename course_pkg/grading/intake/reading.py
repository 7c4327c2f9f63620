"""Reads a student's notebook in any version of the notebook format; the file can be damaged."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from course_pkg.errors import GradingError
from course_pkg.types.fields import Plain

# BRACKETS is the maximum number of lists and objects in a file. Without a limit, a file of 20 MiB with short
# lists would need half a GB of memory.
BRACKETS = 500_000
CELLS = 50_000
PREFIXES = {
    b"<!doctype": "the file is a web page with the notebook; download the notebook itself from that page",
    b"<html": "the file is a web page with the notebook; download the notebook itself from that page",
    b"<<<<<<<": (
        "the file contains the conflict marks of a git merge; resolve the conflict and keep one of "
        "the two versions"
    ),
    b"%pdf": "the file is a PDF of the notebook; hand in the .ipynb file itself",
    b"pk\x03\x04": "the file is a zip file with the name of a notebook; hand in the .ipynb file itself",
}
# A damaged notebook in an old format causes the errors in WRONG.
WRONG = (
    KeyError,
    AttributeError,
    TypeError,
    ValueError,
    IndexError,
    RecursionError,
)


@dataclass(frozen=True)
class StudentCell:
    """The data of one notebook cell that grading needs."""

    id: str
    kind: str  # The value is "code", "markdown" or "raw".
    source: str
    exercise: str = ""  # `exercise` is the id of the exercise in the metadata of the cell.
    check: str = ""  # `check` is the id of the part that the cell checks.
    tags: tuple[str, ...] = ()


def read_cells(content: bytes) -> list[StudentCell]:
    """Return the cells of a notebook.

    Raise GradingError with a short reason if the content is not a notebook.
    """
    cells = _all_cells(_parsed(content))
    if not isinstance(cells, list):
        raise GradingError(
            "the file is not a notebook, because it has no cells; hand in the .ipynb file in which you worked"
        )
    if len(cells) > CELLS:
        raise GradingError(f"the file has more than {CELLS} cells; hand in the notebook in which you worked")
    return list(_cells(cells))


def slimmed(cells: Sequence[StudentCell]) -> bytes:
    """Return a notebook with only the data that grading needs.

    The result contains no outputs, because the outputs of all students' notebooks would fill the memory.
    """
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


def _parsed(content: bytes) -> dict[str, Plain]:
    start = content[:4096].removeprefix(b"\xef\xbb\xbf").lstrip()[:16].lower()
    if not start:
        raise GradingError("the file is empty; save the notebook again, and hand in the notebook again")
    if content.count(b"{") + content.count(b"[") > BRACKETS:
        raise GradingError(
            f"the file contains more than {BRACKETS} lists and objects; clear the outputs of the notebook"
        )
    try:
        data = json.loads(content)
    except (ValueError, RecursionError) as error:
        why = next((words for prefix, words in PREFIXES.items() if start.startswith(prefix)), "")
        raise GradingError(
            why
            or (
                "the file is not a notebook, because it is not JSON; hand in the .ipynb file in which you "
                "worked"
            )
        ) from error
    if not isinstance(data, dict):
        raise GradingError(
            "the file is JSON, but it has no cells; hand in the .ipynb file in which you worked"
        )
    return data


def _all_cells(data: dict[str, Plain]) -> object:
    """Return a notebook's cells; in notebooks up to format version 3, the cells are in the list "worksheets".

    This module does not use nbformat. Its validation of a long notebook takes seconds and writes the whole
    notebook to a log.
    """
    sheets = data.get("worksheets")
    if "cells" in data or not isinstance(sheets, list):
        return data.get("cells")
    lists = [sheet.get("cells") for sheet in sheets if isinstance(sheet, dict)]
    return [cell for cells in lists if isinstance(cells, list) for cell in cells]


def _cells(cells: list[Plain]) -> Iterator[StudentCell]:
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
