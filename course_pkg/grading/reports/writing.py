"""Write all reports of a class."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Sequence
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports import formats
from course_pkg.grading.reports.asked import Asked
from course_pkg.grading.reports.gradebook import Book
from course_pkg.grading.roster.class_list import ClassList

Writer = Callable[[Book, Path], None]
# Only the reports in WITH_ABSENT contain students who have no submission in this run. The reports for
# platforms do not contain these students, so a platform does not change their points.
WITH_ABSENT = ("class_page", "feedback", "records", "table")
# A platform stores one score from each report in OF_ASSIGNMENT, so these reports contain only the chapters of
# this run.
OF_ASSIGNMENT = ("gradescope", "gradescope_table", "moodle_worksheet")


def write_reports(
    grades: Sequence[Grade],
    out: Path,
    class_list: ClassList | None = None,
    asked: Asked | None = None,
) -> None:
    """Write every report about `grades` into the folder `out`.

    `class_list` contains the students' identities and the missing students. `asked` contains the chapters of
    this run; by default, it contains all chapters that have a grade.
    """
    book = Book(grades, class_list, asked)
    chapters = asked.chapters if asked else ()
    present = [grade for grade in grades if not (grade.absent or grade.nothing)]
    platforms = Book(present, class_list)
    of_run = [grade for grade in present if not chapters or grade.chapter in chapters]
    assignment = Book(of_run, class_list, asked)
    books = {**dict.fromkeys(WITH_ABSENT, book), **dict.fromkeys(OF_ASSIGNMENT, assignment)}
    try:
        out.mkdir(parents=True, exist_ok=True)
        for name, write in _writers():
            write(books.get(name, platforms), out)
    except OSError as error:
        raise GradingError(
            f"The reports cannot be written into {out}: {error.strerror or error}. Give another "
            "folder with --out. No grade is lost."
        ) from error


def _writers() -> list[tuple[str, Writer]]:
    names = sorted(module.name for module in pkgutil.iter_modules(formats.__path__))
    return [(name, importlib.import_module(f"{formats.__name__}.{name}").write) for name in names]
