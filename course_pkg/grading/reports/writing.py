"""Write all reports of a class."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Sequence
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports import formats
from course_pkg.grading.reports.gradebook import Book
from course_pkg.grading.roster.class_list import ClassList

Writer = Callable[[Book, Path], None]


def write_reports(grades: Sequence[Grade], out: Path, class_list: ClassList | None = None) -> None:
    """Write every report about `grades` into the folder `out`.

    `class_list` tells who the students are, and who is missing.

    Each module in `formats` writes one report with its function `write(book, out)`; a new format needs only
    such a module.
    """
    book = Book(grades, class_list)
    try:
        out.mkdir(parents=True, exist_ok=True)
        for write in _writers():
            write(book, out)
    except OSError as error:
        raise GradingError(
            f"The reports cannot be written into {out}: {error.strerror or error}. Give another folder with "
            "--out; the grades are not lost."
        ) from error


def _writers() -> list[Writer]:
    names = sorted(module.name for module in pkgutil.iter_modules(formats.__path__))
    return [importlib.import_module(f"{formats.__name__}.{name}").write for name in names]
