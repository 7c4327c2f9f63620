"""The home folders of students: their owners, and the students whom an instructor selected."""

from __future__ import annotations

import csv
import io
import os
import pwd
import stat
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from course_pkg.errors import HandoutError
from course_pkg.grading.tables import delimiter_of

COLUMN = "username"  # A roster has this column.
LARGEST = 4 << 20  # LARGEST is the maximum size of a list of students (bytes).


@dataclass(frozen=True)
class Home:
    """A student's home folder, and the user with the rights to read the folder."""

    student: str
    path: Path
    uid: int = -1
    gid: int = -1
    problem: str = ""  # `problem` says why the folder cannot be read.


def homes_in(folder: Path, students: list[str] | None = None) -> list[Home]:
    """Return the homes in the folder `folder`, sorted by name.

    If `students` is None, all homes are returned. Otherwise, only the homes of these students are returned.

    Hidden folders, links and `lost+found` are not home folders. Raises HandoutError if `folder` cannot be
    listed.
    """
    if students is not None:
        return [_home(folder / name, name) for name in sorted(set(students))]
    try:
        names = sorted(item.name for item in os.scandir(folder) if item.is_dir(follow_symlinks=False))
    except OSError as error:
        raise HandoutError(
            f"{folder} cannot be listed ({error.strerror}). With --homes, give the folder that "
            "contains the home folders."
        ) from error
    found = (
        _home(folder / name, name) for name in names if not name.startswith(".") and name != "lost+found"
    )
    return [home for home in found if home.uid != 0]  # The user root is not a student.


def groups_of(home: Home) -> list[int]:
    """Return the ids of all groups of the home's owner."""
    try:
        return os.getgrouplist(pwd.getpwuid(home.uid).pw_name, home.gid)
    except KeyError:  # The owner is a user of a container and has no account on this machine.
        return [home.gid]


def read_students(path: Path) -> list[str]:
    """Return the user names in a file.

    The file has one name per line, or it is a CSV file with the column `username`.

    Raises HandoutError if the file cannot be read, or if a name is not a valid user name.
    """
    try:
        with path.open("rb") as file:
            text = file.read(LARGEST).decode("utf-8-sig")
    except (OSError, ValueError) as error:
        raise HandoutError(f"The list of students {path} cannot be read: {error}.") from error
    found = []
    for number, name in _names(path, text):
        if "/" in name or name.startswith((".", "-")) or not name.isprintable():
            raise HandoutError(
                f"{path.name}, line {number}: this is not the name of a user. Correct this line."
            )
        found.append(name)
    if not found:
        raise HandoutError(f"{path} contains no student. Write one user name in each line.")
    return found


def _names(path: Path, text: str) -> Iterator[tuple[int, str]]:
    """Yield each name and the number of its line."""
    first = text.partition("\n")[0]
    if not set(",;\t") & set(first) and first.strip().lower() != COLUMN:
        yield from (
            (number, line.strip()) for number, line in enumerate(text.splitlines(), 1) if line.strip()
        )
        return
    rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter_of(text)))
    head = [name.strip().lower() for name in rows[0]]
    if COLUMN not in head:
        raise HandoutError(
            f"{path.name}, line 1: there is no column {COLUMN}. Give this name to the column with "
            "the students' user names."
        )
    place = head.index(COLUMN)
    for number, row in enumerate(rows[1:], 2):
        if len(row) > place and row[place].strip():
            yield number, row[place].strip()


def _home(path: Path, student: str) -> Home:
    try:
        status = path.lstat()
    except OSError as error:
        return Home(student, path, problem=f"there is no home folder {path} ({error.strerror})")
    if not stat.S_ISDIR(status.st_mode):
        return Home(student, path, problem=f"{path} is a link or a file, not a home folder")
    if status.st_uid == 0:
        return Home(student, path, 0, 0, f"{path} belongs to root, so it is not read as a student's home")
    return Home(student, path, status.st_uid, status.st_gid)
