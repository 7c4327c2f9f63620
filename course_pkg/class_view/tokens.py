"""The file with one token for each student, for a class without a hub."""

from __future__ import annotations

import csv
import hmac
import io
import secrets
from collections.abc import Iterable, Mapping
from pathlib import Path

from course_pkg.errors import ClassViewError, GradingError
from course_pkg.files import write_atomically
from course_pkg.grading.roster.people import read_roster

FILE = "tokens.csv"
COLUMNS = ("username", "name", "token")


def names_from(roster: Path | None, students: int) -> dict[str, str]:
    """Return a dict from usernames to names.

    The names come from the roster. Without a roster, the function generates `students` usernames. Without a
    roster, the function generates usernames; their number is `students`.

    Raises ClassViewError if a student has no username.
    """
    if roster is None:
        return {name: name for name in (f"student{number:02}" for number in range(1, students + 1))}
    try:
        people = read_roster(roster)
    except GradingError as error:
        raise ClassViewError(str(error)) from error
    if missing := [person.line for person in people if not person.username]:
        lines = ", ".join(map(str, missing[:5])) + (" and others" if len(missing) > 5 else "")
        raise ClassViewError(
            f"{roster.name}: the column username is missing or empty in the lines {lines}. Write the "
            "usernames into this column."
        )
    return {person.username: person.name or person.username for person in people}


class Tokens:
    """The students' names and tokens in a file; after each change of the file, it is read again.

    Raises ClassViewError if the file cannot be used.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._state: tuple[int, int] | None = None
        self._students: dict[str, str] = {}
        self.names: Mapping[str, str] = {}
        self.refresh()

    def complete(self, names: Mapping[str, str]) -> None:
        """Add the students that have no token yet, and write the file. Existing tokens do not change."""
        tokens = {student: token for token, student in self._students.items()}
        rows = {**self.names, **names}
        self._write(
            [(each, name, tokens.get(each) or secrets.token_urlsafe(24)) for each, name in rows.items()]
        )

    def remove(self, student: str) -> bool:
        """Remove a student from the file; return whether the student was in it."""
        rows = [(each, self.names[each], token) for token, each in self._students.items() if each != student]
        if len(rows) == len(self._students):
            return False
        self._write(rows)
        return True

    def student_of(self, token: str) -> str | None:
        """Return the student who owns a token, or None if no student owns it."""
        self.refresh()
        given = token.encode()
        found = [each for known, each in self._students.items() if hmac.compare_digest(known.encode(), given)]
        return found[0] if found else None

    def refresh(self) -> None:
        """Read the file if it has changed."""
        try:
            status = self.path.stat()
            state = (status.st_mtime_ns, status.st_size)
            if state == self._state:
                return
            rows = list(csv.DictReader(io.StringIO(self.path.read_text("utf-8-sig"))))
            self._students = {
                row["token"]: row["username"] for row in rows if row["token"] and row["username"]
            }
            self.names = {row["username"]: row["name"] or row["username"] for row in rows}
            self._state = state
        except FileNotFoundError:
            self._students, self.names, self._state = {}, {}, None
        except (OSError, ValueError, KeyError, csv.Error) as error:
            raise ClassViewError(
                f"{self.path} cannot be read ({error}). The file needs the columns "
                f"{', '.join(COLUMNS)}. Delete the file to get new tokens."
            ) from error

    def _write(self, rows: Iterable[tuple[str, str, str]]) -> None:
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerows([COLUMNS, *rows])
        try:
            write_privately(self.path, text.getvalue())
        except OSError as error:
            raise ClassViewError(f"{self.path} cannot be written ({error.strerror}).") from error
        self.refresh()


def write_privately(path: Path, text: str) -> None:
    """Write a file that only this user can read, in a folder that only this user can open.

    Raises OSError if the file cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    path.parent.chmod(0o700)
    write_atomically(path, text)
    path.chmod(0o600)
