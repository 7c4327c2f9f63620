"""The results in an SQLite database. A result is on the disk before `add` returns."""

from __future__ import annotations

import sqlite3
import time
from collections.abc import Iterable
from pathlib import Path

from course_pkg.class_view.results import Result
from course_pkg.errors import ClassViewError

FILE = "results.sqlite"
VERSION = 1
MOST = 10_000  # The database stores at most this number of results for one student.
DAY = 86_400.0  # The time is in s.
TABLE = """
CREATE TABLE results (
  number INTEGER PRIMARY KEY,
  student TEXT NOT NULL, id TEXT NOT NULL, part TEXT NOT NULL, verdict TEXT NOT NULL,
  time REAL NOT NULL, hint TEXT NOT NULL, received REAL NOT NULL,
  UNIQUE (student, id)
) STRICT
"""


class TooMany(Exception):
    """A student has sent more results than the database stores for one student."""


class Storage:
    """The database in the folder `folder`; a missing folder or database is created.

    Raises ClassViewError if the database cannot be used. The methods raise sqlite3.Error if the disk cannot
    be written.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / FILE
        try:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            self.path.touch(0o600)
            self._database = sqlite3.connect(self.path, timeout=10, isolation_level=None)
            self._prepare()
        except (OSError, sqlite3.Error) as error:
            raise ClassViewError(
                f"{self.path} cannot be used ({error}). Correct the permissions of this file, or "
                "move the file away if it is damaged."
            ) from error

    def close(self) -> None:
        """Close the database."""
        self._database.close()

    def add(self, results: Iterable[Result]) -> list[Result]:
        """Store the results, and return the new results.

        Raises TooMany if a student has sent too many results.

        If one result cannot be stored, none of the results is stored.
        """
        new, received = [], time.time()
        with self._database:
            self._database.execute("BEGIN IMMEDIATE")
            for each in results:
                row = (each.student, each.id, each.check, each.verdict, each.time, each.hint, received)
                added = self._database.execute(
                    "INSERT OR IGNORE INTO results (student, id, part, verdict, time, hint, received) "
                    "VALUES (?, ?, ?, ?, ?, ?, ?)",
                    row,
                )
                if added.rowcount:
                    new.append(each)
            for student in {each.student for each in new}:
                query = "SELECT count(*) FROM results WHERE student = ?"
                if self._database.execute(query, (student,)).fetchone()[0] > MOST:
                    raise TooMany
        return new

    def read(self) -> list[Result]:
        """Return all results in the order in which they arrived."""
        rows = self._database.execute(
            "SELECT student, id, part, verdict, time, hint FROM results ORDER BY number"
        )
        return [Result(*row) for row in rows]

    def delete(self, student: str) -> int:
        """Delete the results of a student; return their number."""
        deleted = self._database.execute("DELETE FROM results WHERE student = ?", (student,)).rowcount
        self._forget()
        return deleted

    def delete_old(self, days: float) -> int:
        """Delete all results of each student whose last result is older than `days` days.

        Return the number of deleted results.
        """
        deleted = self._database.execute(
            "DELETE FROM results WHERE student IN "
            "(SELECT student FROM results GROUP BY student HAVING max(received) < ?)",
            (time.time() - days * DAY,),
        ).rowcount
        if deleted:
            self._forget()
        return deleted

    def changes_by_others(self) -> int:
        """Return a number that changes when another process changes the database."""
        return int(self._database.execute("PRAGMA data_version").fetchone()[0])

    def _forget(self) -> None:
        """Remove the deleted rows from the write-ahead log, which is a separate file."""
        self._database.execute("PRAGMA wal_checkpoint(TRUNCATE)")

    def _prepare(self) -> None:
        run = self._database.execute
        (version,) = run("PRAGMA user_version").fetchone()
        (tables,) = run("SELECT count(*) FROM sqlite_master").fetchone()
        if version != VERSION and tables:
            raise ClassViewError(
                f"{self.path} was written by another version of the course, or by another program. "
                "Move this file away, or choose a different folder with the option --data."
            )
        for setting in ("journal_mode=WAL", "synchronous=FULL", "secure_delete=ON"):
            run(f"PRAGMA {setting}")
        if not tables:
            with self._database:
                run("BEGIN IMMEDIATE")
                run(TABLE)
                run(f"PRAGMA user_version={VERSION}")
