"""canvas.csv and canvas/NN.csv, which the gradebook of Canvas imports (Grades, Import).

The layout of the files is from the source code of Canvas. The file lib/gradebook_exporter.rb writes the
columns Student, ID, SIS User ID, SIS Login ID and Section. It also writes one column for each assignment, and
the row " Points Possible". The file lib/gradebook_importer.rb finds a student by the ID (the Canvas user id).
Without an ID, the importer uses the SIS User ID, the SIS Login ID or the name. The importer finds an
assignment by the assignment's name, with or without the number in parentheses. If Canvas does not know the
name, the importer offers to create the assignment. The row " Points Possible" sets the points of the
assignment. An empty cell removes the student's grade. The grade of a student without a row does not change.
Therefore, canvas.csv has no row for a student without a grade, and canvas/NN.csv has rows only for students
who submitted the chapter.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from course_pkg.grading import clean
from course_pkg.grading.reports.files import put_table
from course_pkg.grading.reports.gradebook import Book, name_of, points

HEAD = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]
SIS = "sis user id"  # A roster that was exported from Canvas has this column.


def write(book: Book, out: Path) -> None:
    """Write canvas.csv with all chapters, and canvas/NN.csv for each chapter."""
    _put(out / "canvas.csv", book, book.chapters)
    folder = out / "canvas"
    files = {folder / f"{clean.file_name(chapter)}.csv": chapter for chapter in book.chapters}
    for path, chapter in files.items():
        _put(path, book, [chapter])
    # This loop deletes the files of an earlier run that graded other chapters.
    for path in set(folder.glob("*.csv")) - files.keys():
        path.unlink()


def _put(path: Path, book: Book, chapters: Sequence[str]) -> None:
    suffix = "" if book.sandboxed else ", run without a sandbox"
    blank = [""] * (len(HEAD) - 1)
    rows = [
        [*HEAD, *(f"Chapter {clean.line(chapter)}{suffix}" for chapter in chapters)],
        ["    Points Possible", *blank, *(points(book.possible(chapter)) for chapter in chapters)],
    ]
    for student in book.identified:
        grades = [book.grade(student, chapter) for chapter in chapters]
        if any(grades):
            cells = ["" if grade is None else points(grade.earned) for grade in grades]
            rows.append([*_identity(book, student), *cells])
    put_table(path, rows)


def _identity(book: Book, student: str) -> list[str]:
    person = book.person(student)
    if person is None:
        return [clean.cell(name_of(student)), "", "", clean.cell(name_of(student)), ""]
    number = person.id if re.fullmatch(r"\d{1,19}", person.id) else ""
    # A Canvas user id is a number. Any other id is an id of the student information system (SIS).
    further = [person.more.get(SIS, "" if number else person.id), person.username, person.section]
    return [clean.cell(person.name or name_of(student)), number, *map(clean.cell, further)]
