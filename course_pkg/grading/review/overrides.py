"""overrides.csv: the points and comments of an instructor.

An instructor can edit overrides.csv on the review page or in a spreadsheet.

The columns are student, chapter, part, points, comment and answer. When the course writes the file, it does
not change additional columns and empty lines. A part is written as "Part 05.10", because a spreadsheet would
change 05.10 to 5.1. The column answer contains a digest of the reviewed code, or is empty.
"""

from __future__ import annotations

import codecs
import csv
import hashlib
import io
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.files import write_atomically
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.run.selection import two_digits
from course_pkg.grading.tables import UTF_16, delimiter_of, table_bytes

FILE = "overrides.csv"
COLUMNS = ("student", "chapter", "part", "points", "comment", "answer")
LARGEST = 20_000_000  # The size is in bytes.
POINTS = re.compile(r"\d{1,6}([.,]\d{1,2})?")
PREFIX = "Part "
LONG = 4_000  # LONG is the maximum number of characters of a comment.
Key = tuple[str, str]  # The tuple contains the student and the part.


@dataclass(frozen=True)
class Override:
    """One row: an instructor's points, comment, or both."""

    student: str
    part: str
    points: float | None = None  # If `points` is None, the points of the check are used.
    comment: str = ""
    answer: str = ""
    # `line` is the number of the line in the file, counted from 1.
    line: int = field(default=0, compare=False)
    # `bare` is True if the row contains the part without the word "Part".
    bare: bool = field(default=False, compare=False)

    @property
    def key(self) -> Key:
        """The student and the part."""
        return self.student, self.part


@dataclass(frozen=True)
class Overrides:
    """The contents of overrides.csv, including additional columns and empty lines."""

    path: Path
    rows: Mapping[Key, Override] = field(default_factory=dict)
    head: tuple[str, ...] = COLUMNS
    lines: tuple[tuple[str, ...], ...] = ()  # The tuple contains the cells of all lines after the first line.
    # `places` contains, for each student and part, the index of the row in `lines`.
    places: Mapping[Key, int] = field(default_factory=dict)
    delimiter: str = ","
    digest: str = ""  # `digest` is a digest of the file's bytes.

    def require_students(self, names: Collection[str]) -> None:
        """Raise GradingError if a row is about a student who is not in `names`."""
        for row in self.rows.values():
            if row.student not in names:
                raise self._wrong(row, f"there is no submission of the student {clean.line(row.student, 80)}")

    def require_parts(self, grades: Sequence[Grade]) -> None:
        """Raise GradingError if a row is about an unknown student or part, or has too many points."""
        self.require_students({grade.student for grade in grades})
        known = {(grade.student, report.check): report for grade in grades for report in grade.reports}
        for row in self.rows.values():
            report = known.get(row.key)
            if report is None:
                raise self._wrong(row, f"the submission has no part {row.part}")
            if row.bare and (row.student, f"{row.part}0") in known:
                raise self._wrong(
                    row,
                    f"a spreadsheet may have changed {row.part}0 to {row.part}; write {PREFIX}{row.part} or "
                    f"{PREFIX}{row.part}0",
                )
            if row.points is not None and row.points > report.possible:
                raise self._wrong(
                    row, f"{row.points:g} points are more than the maximum of {report.possible:g} points"
                )

    def changed(self, changes: Mapping[Key, Override | None]) -> bytes:
        """Return the new content of the file. A key with the value None in `changes` removes its row."""
        lines: list[tuple[str, ...] | None] = list(self.lines)
        for key, row in changes.items():
            place = self.places.get(key)
            if place is not None:
                lines[place] = self._cells(row, self.lines[place]) if row else None
            elif row:
                lines.append(self._cells(row, ()))
        buffer = io.StringIO()
        writer = csv.writer(buffer, delimiter=self.delimiter)
        writer.writerows([self.head, *(line for line in lines if line is not None)])
        return buffer.getvalue().encode("utf-8-sig")

    def _cells(self, row: Override, old: Sequence[str]) -> tuple[str, ...]:
        points = "" if row.points is None else f"{row.points:.2f}".rstrip("0").rstrip(".")
        new = {
            "student": _protected(row.student),
            "chapter": row.part.partition(".")[0],
            "part": f"{PREFIX}{row.part}",
            "points": points.replace(".", ",") if self.delimiter == ";" else points,
            "comment": _protected(row.comment),
            "answer": row.answer,
        }
        padded = [*old, *[""] * (len(self.head) - len(old))]
        names = [_name(cell) for cell in self.head]
        cells = [new.get(name, cell) for name, cell in zip(names, padded, strict=False)]
        return (*cells, *padded[len(names) :])

    def _wrong(self, row: Override, problem: str) -> GradingError:
        return _wrong(self.path, row.line, problem)


def read_overrides(out: Path) -> Overrides:
    """Return the overrides in the folder `out`; without a file, the result is empty.

    Raises GradingError with the line number if the file is not a table of overrides.
    """
    path = out / FILE
    if not path.exists():
        return Overrides(path)
    content = table_bytes(path, "table of reviewed points", LARGEST)
    digest = hashlib.sha256(content).hexdigest()
    text = _decoded(path, content)
    delimiter = delimiter_of(text)
    numbered = list(_records(path, text, delimiter))
    if not numbered:
        return Overrides(path, digest=digest)
    (_, head), *others = numbered
    names = [_name(cell) for cell in head]
    for column in COLUMNS:
        if names.count(column) != 1:
            problem = "occurs twice" if column in names else "is missing"
            raise _wrong(path, 1, f"the column {column} {problem}; the columns are {', '.join(COLUMNS)}")
    rows: dict[Key, Override] = {}
    places: dict[Key, int] = {}
    for place, (number, cells) in enumerate(others):
        if any(cell.strip() for cell in cells):
            row = _row(path, number, dict(zip(names, cells, strict=False)))
            if row.key in rows:
                raise _wrong(path, number, f"line {rows[row.key].line} has the same student and part")
            rows[row.key], places[row.key] = row, place
    lines = tuple(tuple(cells) for _, cells in others)
    return Overrides(path, rows, tuple(head), lines, places, delimiter, digest)


def save(current: Overrides, changes: Mapping[Key, Override | None]) -> Overrides:
    """Write the changes to overrides.csv, completely or not at all; return the new contents.

    Raises OSError if the file cannot be written.
    """
    write_atomically(current.path, current.changed(changes))
    return read_overrides(current.path.parent)


def points_of(text: str) -> float | None:
    """Return points that an instructor typed, such as "1.5" or "1,5", or None for an empty text.

    Raises ValueError if the text is not a number with at most two decimals.
    """
    shown = text.strip()
    if not shown:
        return None
    if not POINTS.fullmatch(shown):
        raise ValueError(f"{clean.line(shown, 40)} is not a number of points, such as 1 or 1.5")
    return float(shown.replace(",", "."))


def _decoded(path: Path, content: bytes) -> str:
    try:
        return content.decode("utf-16" if content.startswith(UTF_16) else "utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.removeprefix(codecs.BOM_UTF8)[: error.start].count(b"\n") + 1
        raise _wrong(path, line, "the text is not UTF-8; save the file as CSV in UTF-8") from error


def _records(path: Path, text: str, delimiter: str) -> Iterator[tuple[int, list[str]]]:
    """Yield each record of the CSV file: the line number at which the record begins, and the cells."""
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True)
    line = 1
    try:
        for cells in reader:
            yield line, cells
            line = reader.line_num + 1
    except csv.Error as error:
        raise _wrong(path, line, str(error)) from error


def _row(path: Path, line: int, cells: Mapping[str, str]) -> Override:
    student, part = clean.identity(_plain(cells.get("student", ""))), _part(path, line, cells.get("part", ""))
    chapter = two_digits(cells.get("chapter", ""))
    if cells.get("chapter", "").strip() and chapter != part.partition(".")[0]:
        raise _wrong(path, line, f"part {part} is not in chapter {clean.line(chapter, 20)}")
    try:
        points = points_of(cells.get("points", ""))
    except ValueError as error:
        raise _wrong(path, line, str(error)) from error
    bare = not cells.get("part", "").strip().startswith(PREFIX)
    comment = clean.text(_plain(cells.get("comment", "")), LONG).strip()
    return Override(student, part, points, comment, cells.get("answer", "").strip(), line, bare)


def _part(path: Path, line: int, cell: str) -> str:
    """Return the id of the part in a cell, such as "05.2" for "Part 05.2" or "5.2"."""
    named = cell.strip()
    part = two_digits(named.removeprefix(PREFIX.strip()))
    if not re.fullmatch(r"\d\d(\.\d+){1,2}", part):
        raise _wrong(path, line, f"{clean.line(named, 40) or 'an empty cell'} is not a part, such as 05.2")
    return part


def _name(cell: str) -> str:
    return cell.strip().lower()


def _protected(text: str) -> str:
    """Add a quote before a text that a spreadsheet would read as a formula; `_plain` removes the quote."""
    return f"'{text}" if text.lstrip("'").startswith(tuple(clean.FORMULA)) else text


def _plain(cell: str) -> str:
    return cell[1:] if cell.startswith("'") and cell.lstrip("'").startswith(tuple(clean.FORMULA)) else cell


def _wrong(path: Path, line: int, problem: str) -> GradingError:
    return GradingError(f"{path}, line {line}: {problem}. Correct this line. Nothing was changed.")
