"""results/<student>/NN.json: the stored records of the grades."""

from __future__ import annotations

from pathlib import Path

from course_pkg.grading.reports.gradebook import Book
from course_pkg.grading.reports.records import write_record


def write(book: Book, out: Path) -> None:
    """Write the record of each grade."""
    for grade in book.grades:
        write_record(out, grade)
