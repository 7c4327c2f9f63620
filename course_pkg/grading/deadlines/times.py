"""Finds the time of a submission in a table, or in the files that a platform adds to a download.

A table such as times.csv has the columns student and submitted, and optionally chapter and file. A times.csv
in the folder of the submissions is used even without an option. Moodle's grading worksheet contains the time
in the column "Last modified (submission)". The name of the student's folder contains the participant number,
which identifies the student's row. For Gradescope, the time is the value of `:created_at` in
submission_metadata.yml. For nbgrader, the time is in submitted/STUDENT/ASSIGNMENT/timestamp.txt. This file is
read only with `--times nbgrader`.
"""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import datetime, timezone, tzinfo
from pathlib import Path, PurePosixPath

from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.deadlines.csv_table import Row, read_rows
from course_pkg.grading.deadlines.moments import moment_of
from course_pkg.grading.grade import Submission
from course_pkg.grading.intake.archive import one_file
from course_pkg.grading.intake.naming import (
    GRADESCOPE,
    METADATA,
    MOODLE,
    TIMES,
    gradescope_records,
    number_of,
)

NBGRADER, GRADESCOPE_WORD = "nbgrader", "gradescope"
STAMP, STAMP_LIMIT = "timestamp.txt", 200  # The size is in bytes.
METADATA_LIMIT = 64 << 20  # The size is in bytes.
IDENTIFIER, MODIFIED = "identifier", "last modified (submission)"
SUBMITTED = ("submitted", "time", "created_at")
When = Callable[[Submission], datetime | None]


def times_of(option: str, source: Path, zone: tzinfo | None) -> When:
    """Return a function that returns the time of a submission, or None if the time is unknown.

    `option` is the value of --times: the path of a table, "nbgrader", "gradescope", or "". With "", the times
    come from times.csv in the folder of the submissions, or from Gradescope's metadata. `zone` applies to
    times without a time zone. Raises GradingError if the table cannot be used.
    """
    if not option and (source / TIMES).is_file():
        option = str(source / TIMES)
    if option in ("", GRADESCOPE_WORD):
        return _Gradescope(source).find
    if option == NBGRADER:
        return _Nbgrader(source).find
    path = Path(option)
    head, rows = read_rows(path, "table of times")
    if MODIFIED in head and IDENTIFIER in head:
        return _worksheet(rows, zone).find
    if "student" in head and set(SUBMITTED) & set(head):
        return _table(rows, zone).find
    raise GradingError(
        f"{path.name}, line 1: a column is missing. The table of times needs the columns "
        "student,submitted or student,chapter,submitted. Moodle's grading worksheet needs the "
        "columns Identifier and Last modified (submission). If Moodle has written these names in "
        "another language, switch Moodle to English."
    )


@dataclass(frozen=True)
class _Entry:
    """A row of a table: a time for a chapter and a file.

    An empty chapter means all chapters, and an empty file means all files.
    """

    chapter: str
    file: str
    moment: datetime


@dataclass(frozen=True)
class _Table:
    """A table of times; it contains the rows of each student.

    If a submission has several times, the latest time counts, because all files are graded.
    """

    rows: Mapping[str, Sequence[_Entry]]

    def find(self, submission: Submission) -> datetime | None:
        rows = [
            each for each in self.rows.get(submission.student, ()) if each.chapter in ("", submission.chapter)
        ]
        files = [each.moment for each in rows if each.file and _has(submission, each.file)]
        if files:
            return max(files)
        general = {each.chapter: each.moment for each in rows if not each.file}
        return general.get(submission.chapter, general.get(""))


def _has(submission: Submission, file: str) -> bool:
    """Return whether the submission contains the file `file`.

    `file` is a path, relative to the folder of all submissions or to the student's folder.
    """
    if file in _paths(submission.origin, submission.student) and submission.content:
        return True
    folders = [path for each in submission.packages for path in _paths(each.origin, submission.student)]
    return any(f"{file}/".startswith(f"{folder}/") for folder in folders)


def _paths(origin: str, student: str) -> tuple[str, ...]:
    """Return a file's paths relative to the folder of all submissions and to the student's folder."""
    parts = origin.split("/")
    place = next((index for index, part in enumerate(parts[:-1]) if clean.identity(part) == student), None)
    return (origin,) if place is None else (origin, "/".join(parts[place + 1 :]))


@dataclass(frozen=True)
class _Worksheet:
    """The times of submissions; the keys are Moodle's participant numbers."""

    times: Mapping[str, datetime]

    def find(self, submission: Submission) -> datetime | None:
        _, number = number_of(submission.student, [submission.origin], MOODLE)
        return self.times.get(number)


def _worksheet(rows: list[Row], zone: tzinfo | None) -> _Worksheet:
    found = {}
    for row in rows:
        number = "".join(filter(str.isdigit, row.get(IDENTIFIER)))
        if number and row.get(MODIFIED) not in ("", "-"):
            found[number] = _moment(row, row.get(MODIFIED), zone)
    return _Worksheet(found)


def _table(rows: list[Row], zone: tzinfo | None) -> _Table:
    found: dict[str, list[_Entry]] = {}
    for row in rows:
        student, chapter = row.get("student"), row.get("chapter")
        if not student or (chapter and not (chapter.isdecimal() and len(chapter) <= 2)):
            raise GradingError(
                f"{row.where}: the student is missing, or the chapter is not a number. Write a "
                "student in each row, and a chapter such as 05."
            )
        moment = _moment(row, row.get(*SUBMITTED), zone)
        entry = _Entry(chapter.zfill(2) if chapter else "", row.get("file"), moment)
        known = found.setdefault(clean.identity(student), [])
        if any((each.chapter, each.file) == (entry.chapter, entry.file) for each in known):
            raise GradingError(
                f"{row.where}: this submission is in the table twice. Keep only one of the two rows."
            )
        known.append(entry)
    return _Table(found)


def _moment(row: Row, written: str, zone: tzinfo | None) -> datetime:
    """Return the submission time that a row of the table contains.

    An error message never contains a cell, because a cell can contain a student's name.
    """
    moment = moment_of(written, zone)
    if moment is not None:
        return moment
    if moment_of(written, timezone.utc) is not None:
        raise GradingError(
            f"{row.where}: the time has no time zone. Give the time zone of the table, such as "
            "--time-zone Europe/Berlin."
        )
    raise GradingError(
        f"{row.where}: this is not a time. Write 2026-11-01T23:59+01:00, or use Moodle's format: "
        "Sunday, 1 November 2026, 11:59 PM."
    )


@dataclass
class _Gradescope:
    """The times in Gradescope's metadata, which students cannot change."""

    source: Path
    known: dict[str, dict[str, datetime]] = field(default_factory=dict)

    def find(self, submission: Submission) -> datetime | None:
        parts = PurePosixPath(submission.origin).parts
        place = next((index for index, part in enumerate(parts[:2]) if GRADESCOPE.fullmatch(part)), None)
        if place is None:
            return None
        path = "/".join((*parts[:place], METADATA))
        if path not in self.known:
            self.known[path] = self._read(path)
        return self.known[path].get(parts[place])

    def _read(self, path: str) -> dict[str, datetime]:
        content = _content(self.source, path, METADATA_LIMIT)
        records = gradescope_records(content) if content else {}
        written = {folder: str(record.get(":created_at", "")) for folder, record in records.items()}
        found = {folder: moment_of(text, timezone.utc) for folder, text in written.items()}
        return {folder: moment for folder, moment in found.items() if moment}


@dataclass
class _Nbgrader:
    """The times in timestamp.txt; `nbgrader submit` writes this file, and the student can change it."""

    source: Path

    def find(self, submission: Submission) -> datetime | None:
        parts = PurePosixPath(submission.origin).parts
        places = (index for index, part in enumerate(parts) if clean.identity(part) == submission.student)
        place = next(places, None)
        if place is None or len(parts) < place + 3:
            return None
        content = _content(self.source, "/".join((*parts[: place + 2], STAMP)), STAMP_LIMIT)
        return moment_of(content.decode("utf-8", "replace"), timezone.utc)


def _content(source: Path, path: str, limit: int) -> bytes:
    """Return at most `limit` bytes of a file in a folder or zip, or b"" if the file cannot be read."""
    with suppress(GradingError, OSError, KeyError, ValueError, RuntimeError, zipfile.BadZipFile):
        if source.is_dir():
            return one_file(source / path).read()[:limit]
        with zipfile.ZipFile(source) as archive, archive.open(path) as file:
            return file.read(limit)
    return b""
