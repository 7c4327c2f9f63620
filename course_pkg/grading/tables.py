"""Reads an instructor's CSV tables, in UTF-8 or UTF-16, with commas, semicolons or tabs between the cells."""

from __future__ import annotations

import codecs
import csv
import io
from pathlib import Path

from course_pkg.errors import GradingError

LARGEST = 1_000_000  # The size is in bytes.
SPREADSHEET = b"PK\x03\x04"  # Files in the formats .xlsx and .ods begin with these bytes.
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def table_bytes(path: Path, what: str, largest: int = LARGEST) -> bytes:
    """Return the content of the file at the path `path`.

    `what` describes the file in error messages, such as "table of late days".

    Raises GradingError if the file cannot be read, has more than `largest` bytes, or is not CSV but a
    spreadsheet.
    """
    try:
        with path.open("rb") as file:
            content = file.read(largest + 1)
    except OSError as error:
        raise GradingError(
            f"The {what} {path.name} cannot be read: {error.strerror or error}. Correct the path, or the "
            f"permissions of the file {path}."
        ) from error
    if len(content) > largest:
        raise GradingError(f"{path.name} is too large for a {what} (the limit is {largest} bytes).")
    if content.startswith(SPREADSHEET):
        raise _unreadable(path, what, "it is a spreadsheet and not a CSV file")
    return content


def table_rows(path: Path, what: str) -> list[list[str]]:
    """Return the rows of the CSV file at the path `path`; the separator is a comma, a semicolon or a tab.

    Raises GradingError in the same cases as table_bytes(). Also raises it if the file is not CSV in UTF-8, or
    in UTF-16 with a byte order mark.
    """
    content = table_bytes(path, what)
    try:
        whole = content.decode("utf-16" if content.startswith(UTF_16) else "utf-8-sig")
        return list(csv.reader(io.StringIO(whole, newline=""), delimiter=delimiter_of(whole), strict=True))
    except (ValueError, csv.Error) as error:
        raise _unreadable(path, what, str(error)) from error


def delimiter_of(text: str) -> str:
    """Return the separator of a CSV text: the most frequent of comma, semicolon and tab in the first line."""
    first = text.partition("\n")[0]
    return max(",;\t", key=first.count)


def _unreadable(path: Path, what: str, why: str) -> GradingError:
    return GradingError(f"The {what} {path.name} cannot be read: {why}. Save the file as CSV in UTF-8.")
