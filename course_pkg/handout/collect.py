"""`course collect`: copies students' work from their home folders into a folder for `course grade`."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from course_pkg.checking.parts import chapters as all_chapters
from course_pkg.checking.parts import notebook_of, parts_of
from course_pkg.errors import HandoutError
from course_pkg.grading import clean
from course_pkg.grading.intake.naming import TIMES
from course_pkg.handout.homes.listing import Home, homes_in, read_students
from course_pkg.handout.homes.reading import read_home
from course_pkg.handout.homes.storing import store
from course_pkg.handout.homes.times import Row, TimesTable, iso_time
from course_pkg.handout.homes.work import WorkFile
from course_pkg.handout.selection import chosen_chapters
from course_pkg.setup.stamps import locked

LOCK = ".lock"
# The maximum time in ns between a file's modification time and its last change on disk. If the difference is
# larger, an instructor should examine the file.
SET_BACK = 60 * 10**9


@dataclass(frozen=True)
class Options:
    """The options of the command line."""

    folder: str  # `folder` is the path of the course's folder in each home folder.
    out: Path
    homes: Path = Path("/home")
    students: Path | None = None
    chapters: tuple[str, ...] = ()


@dataclass
class Collected:
    """The current result of the collection, with messages for the instructor."""

    notebooks: int = 0
    packages: int = 0
    students: int = 0
    nothing: list[str] = field(default_factory=list)  # These are the names of students.
    problems: list[str] = field(default_factory=list)
    set_back: list[str] = field(default_factory=list)


class Wanted:
    """The notebooks and packages of the chapters to collect."""

    def __init__(self, chapters: Sequence[str]) -> None:
        self.notebooks = {notebook_of(chapter): chapter for chapter in chapters}
        # This dict maps each chapter of the course to the packages that the chapter requires.
        self._asking: dict[str, set[str]] = {}
        for chapter in all_chapters():
            for name in (name for part in parts_of(chapter) for name in part.package_files):
                self._asking.setdefault(name, set()).add(chapter)
        self.packages = frozenset(
            name for name, asking in self._asking.items() if not asking.isdisjoint(chapters)
        )

    def chapters_of(self, file: WorkFile) -> list[str]:
        """Return the chapter of a notebook.

        For a file of a package, return all chapters that require this package.
        """
        return sorted(self._asking[file.asked]) if file.package else [self.notebooks[file.path]]


def collect(options: Options) -> int:
    """Collect the work, and print a summary. Return 1 if no work was found, and 0 otherwise.

    Raises HandoutError, and collects nothing, if an option is wrong.
    """
    folder = _course_folder(options.folder)
    wanted = Wanted(chosen_chapters(listed=options.chapters))
    homes = homes_in(options.homes, read_students(options.students) if options.students else None)
    # If the folder contains files but no times.csv, this call raises an error. At this point, nothing has
    # been changed.
    TimesTable(options.out)
    if os.geteuid() != 0:
        sys.stderr.write(
            "You are not root, so the command collects only files that your own account can read.\n"
        )
    found, out = Collected(), options.out
    try:
        out.mkdir(parents=True, exist_ok=True, mode=0o700)
        with locked(
            out / LOCK,
            lambda: _note(
                "Another collection is running. This command waits until the other collection has ended."
            ),
        ):
            table = TimesTable(out)
            # This call writes times.csv first, so a user can repeat an interrupted collection.
            table.replace((), ())
            for home in homes:
                _collect_one(home, folder, wanted, out, table, found)
    except OSError as error:
        raise HandoutError(
            f"The work cannot be stored in {out} ({error.strerror}). Correct this problem, and type "
            "the command again."
        ) from error
    for line in _report(found, options, len(homes)):
        sys.stdout.write(f"{line}\n")
    return 0 if found.students else 1


def _collect_one(
    home: Home, folder: str, wanted: Wanted, out: Path, table: TimesTable, found: Collected
) -> None:
    files, problems = (
        ([], [home.problem]) if home.problem else read_home(home, folder, wanted.notebooks, wanted.packages)
    )
    student = home.student
    found.problems += [clean.line(f"{student}: {problem}") for problem in problems]
    if not files:
        found.nothing.append(student)
        return
    store(out / student, files)
    rows = list(_rows(student, files, wanted))
    table.replace({row.unit for row in rows}, rows)
    found.students += 1
    found.notebooks += sum(not file.package for file in files)
    found.packages += len({file.package for file in files if file.package})
    found.set_back += [
        (
            f"{student}/{file.place}: the time of the file is {iso_time(file.modified)}, but the "
            f"file was written or moved at {iso_time(file.changed)}"
        )
        for file in files
        if file.changed - file.modified > SET_BACK
    ]


def _rows(student: str, files: Sequence[WorkFile], wanted: Wanted) -> Iterator[Row]:
    """Yield the rows of times.csv: one per file, and one per package with the time of its newest file."""
    newest: dict[str, WorkFile] = {}
    for file in files:
        for chapter in wanted.chapters_of(file):
            yield Row(student, chapter, f"{student}/{file.place}", iso_time(file.modified))
        if file.package and file.modified >= newest.get(file.package, file).modified:
            newest[file.package] = file
    for package, file in newest.items():
        for chapter in wanted.chapters_of(file):
            yield Row(student, chapter, f"{student}/{package}", iso_time(file.modified))


def _report(found: Collected, options: Options, homes: int) -> Iterator[str]:
    if not found.students:
        yield (
            f"Nothing was found in {homes} home folders below {options.homes}. Check that "
            f"{options.folder} is the course's folder in each home folder."
        )
    else:
        yield (
            f"{_count(found.notebooks, 'notebook')} and {_count(found.packages, 'package')} of "
            f"{_count(found.students, 'student')} are in {options.out}. The submission times are in "
            f"{options.out / TIMES}."
        )
    if found.nothing:
        yield f"No work was found for {_count(len(found.nothing), 'student')}: {', '.join(found.nothing)}"
    for title, lines in (
        ("Not collected:", found.problems),
        (
            (
                "The times of these files are too early, because the files were written or moved later. "
                "The owner of a file can change its time:"
            ),
            found.set_back,
        ),
    ):
        yield from [title, *(f"  {line}" for line in lines)] if lines else []
    if found.students:
        yield f"Grade this work with: ./course grade {options.out}"


def _course_folder(given: str) -> str:
    """Return the path of the course's folder, relative to a home folder."""
    path = Path(given)
    if path.is_absolute() or ".." in path.parts or not path.parts:
        raise HandoutError(
            f"{given} is not a folder inside a home folder. Give the folder's path below the home "
            "folder, such as ros-course."
        )
    return path.as_posix()


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _note(text: str) -> None:
    sys.stderr.write(f"{text}\n")
