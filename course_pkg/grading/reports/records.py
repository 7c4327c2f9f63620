"""The record of a grade, `results/<student>/NN.json`; all reports are made from these records."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade, grade_from
from course_pkg.state import write_json

RESULTS = "results"


def record_path(out: Path, student: str, chapter: str, origin: str = "") -> Path:
    """Return the path of a grade's record; if `chapter` is empty, the file name depends on `origin`."""
    name = clean.file_name(chapter) if chapter else f"none-{hashlib.sha256(origin.encode()).hexdigest()[:10]}"
    return out / RESULTS / clean.file_name(student or "nobody") / f"{name}.json"


def write_record(out: Path, grade: Grade) -> Path:
    """Write the record of a grade, completely or not at all; return the path of the file."""
    path = record_path(out, grade.student, grade.chapter, grade.origin)
    code = {clean.line(part): clean.code(text) for part, text in grade.code.items()}
    write_json(path, {**clean.record(grade.as_dict()), "code": code})
    return path


def read_grades(out: Path) -> list[Grade]:
    """Return the grades in the folder `out`, sorted by student and chapter."""
    paths = sorted(path for path in (out / RESULTS).glob("*/*.json") if not path.name.startswith("."))
    grades = [_read(path, f"record {number} of {len(paths)}") for number, path in enumerate(paths, 1)]
    return sorted(grades, key=lambda grade: (grade.student, grade.chapter, grade.origin))


def _read(path: Path, which: str) -> Grade:
    """Return the grade in a record; error messages contain `which` in place of the student's name."""
    try:
        return grade_from(json.loads(path.read_text("utf-8")))
    except (OSError, ValueError, TypeError, KeyError, AttributeError) as error:
        raise GradingError(
            f"In {path.parents[1]}, this version of the course cannot read {which} ({path.name}): "
            f"{type(error).__name__}. Delete this file, and grade again. The number of a record is its "
            "position in the sorted list of all paths."
        ) from error
