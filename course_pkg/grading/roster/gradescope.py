"""Reads the data about students from the metadata of a Gradescope export."""

from __future__ import annotations

from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.intake.archive import opened
from course_pkg.grading.intake.naming import METADATA, gradescope_records, gradescope_submitters
from course_pkg.grading.roster.people import Person


def gradescope_people(source: Path) -> dict[str, Person]:
    """Return the data about each student; the keys are students' names, as in the grades.

    The result is empty if there are no metadata.

    `source` is a folder or a zip.
    """
    found: dict[str, Person] = {}
    try:
        with opened(source) as entries:
            for entry in entries:
                if entry.parts[-1:] == (METADATA,) and len(entry.parts) < 3:
                    found |= _people(entry.read())
    except GradingError:  # Another function reports unreadable files.
        return found
    return found


def _people(content: bytes) -> dict[str, Person]:
    """Return the data about each student; `content` is the content of Gradescope's metadata file."""
    records = gradescope_records(content)
    return {
        clean.identity(student): Person(
            name=_text(record, ":name"), id=_text(record, ":sid"), email=_text(record, ":email")
        )
        for folder, students in gradescope_submitters(content).items()
        for student, record in zip(students, records[folder].get(":submitters") or [], strict=False)
        if isinstance(record, dict)
    }


def _text(record: dict[object, object], name: str) -> str:
    value = record.get(name)
    return clean.line(value, 200) if isinstance(value, str) and value not in ("~", "null") else ""
