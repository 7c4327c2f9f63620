"""Makes strings from a submission safe for a page, a table, XML, or the name of a file.

Cleaning a string twice gives the same result as cleaning it once.
"""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections.abc import Mapping, Sequence
from html import escape

from course_pkg.types.fields import Plain

LONG = 4_000  # LONG is the maximum number of characters of a text with several lines.
SHORT = 300  # SHORT is the maximum number of characters of one line.
NAME = 60  # NAME is the maximum number of characters of a file name.
CODE = 20_000  # CODE is the maximum number of characters of the student's code for one part.
LINES = 200
ITEMS = 1_000  # ITEMS is the maximum number of entries of a list in a record.

ANSI = re.compile(
    # The next line matches escape sequences that set the title of the terminal or make a link.
    r"\x1b\][^\x07\x1b]*(?:\x07|\x1b\\)?"
    # The next line matches escape sequences that set colours or move the cursor.
    r"|(?:\x1b\[|\x9b)[0-?]*[ -/]*[@-~]?"
    r"|\x1b[PX^_][^\x1b]*(?:\x1b\\)?"  # This part matches strings that control the terminal.
    r"|\x1b[ -/]*[0-~]?"
)
UNSEEN = re.compile(
    # The next line contains all control characters except tab, line feed and carriage return.
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f"
    # The next two lines contain characters that change the direction of the text, or are invisible.
    "\u00ad\u061c\u180e\u200b\u200e\u200f\u2060-\u206f\ufeff\ufff9-\ufffb"
    "\u202a-\u202e\U000e0000-\U000e007f]"
)
# ILLEGAL matches halves of surrogate pairs, and code points that are not characters.
ILLEGAL = re.compile("[\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff]")
BREAKS = re.compile("\r\n?|[\u2028\u2029]")
# In a spreadsheet, a formula begins with a character in `FORMULA`. The last four characters are full-width
# characters; only some spreadsheets accept them.
FORMULA = "=+-@\uff1d\uff0b\uff0d\uff20"
DEVICES = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|com\d|lpt\d)(\..*)?", re.IGNORECASE)
PLAIN_NAME = re.compile(r"[a-z0-9][a-z0-9._-]*")
# This is the pattern of the suffix that file_name() appends to each changed name.
MARKED = re.compile(r"-[0-9a-f]{10}")


def text(value: object, limit: int = LONG) -> str:
    """Return the value as readable text, with at most `limit` characters and `LINES` lines."""
    whole = str(value)
    kept = BREAKS.sub("\n", ANSI.sub("", whole[: 4 * limit + 1000]))
    kept = ILLEGAL.sub("\ufffd", UNSEEN.sub("", kept))
    lines = kept.split("\n")
    if len(kept) <= limit and len(lines) <= LINES and len(whole) <= 4 * limit + 1000:
        return kept
    mark = " … (cut)"
    return "\n".join(lines[:LINES])[: limit - len(mark)].removesuffix(mark) + mark


def line(value: object, limit: int = SHORT) -> str:
    """Return the value as readable text on one line."""
    return " ".join(text(value, limit).split())


def code(value: object, limit: int = CODE) -> str:
    """Return the readable text of an answer, with at most `limit` characters and any number of lines."""
    lines = BREAKS.sub("\n", str(value)[:limit]).split("\n")
    return "\n".join(ILLEGAL.sub("\ufffd", UNSEEN.sub("", ANSI.sub("", line))) for line in lines)


def html(value: object, limit: int = LONG) -> str:
    """Return the value as text for an HTML page; characters such as < are escaped."""
    return escape(text(value, limit), quote=True)


def cell(value: object, limit: int = SHORT) -> str:
    """Return the value as one line for a cell of a table; no spreadsheet reads it as a formula."""
    kept = line(value, limit)
    return f"'{kept}" if kept.startswith(tuple(FORMULA)) else kept


def record(fields: Mapping[str, Plain]) -> dict[str, Plain]:
    """Return the fields with cleaned keys and values; a list in the result has at most `ITEMS` items."""
    return {line(key): _value(item) for key, item in fields.items()}


def _value(value: Plain) -> Plain:
    if isinstance(value, str):
        return text(value)
    if isinstance(value, Mapping):
        return record(value)
    if isinstance(value, Sequence):
        return [_value(item) for item in value[:ITEMS]]
    return value


def identity(name: str) -> str:
    """Return a student's name in a form for records; different names give different results."""
    known = unicodedata.normalize("NFC", name)
    kept = line(known, 120)
    return kept if kept == known else f"{kept}~{_mark(name)}".strip()


def file_name(name: str) -> str:
    """Return a safe file name for the name `name`.

    The returned name is never the name of a device or a path to another folder.

    Different names get different file names: each changed name gets a suffix. Even a file system that ignores
    case distinguishes these file names.
    """
    if PLAIN_NAME.fullmatch(name) and _may_stand(name):
        return name
    letters = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode().lower()
    kept = re.sub(r"[^a-z0-9]+", "-", letters).strip("-")[: NAME - 11].strip("-")
    return f"{kept or 'student'}-{_mark(name)}"


def _may_stand(name: str) -> bool:
    ends_well = not name.endswith(".") and ".." not in name
    return len(name) <= NAME and ends_well and not DEVICES.fullmatch(name) and not MARKED.search(name[-11:])


def _mark(name: str) -> str:
    return hashlib.sha256(name.encode("utf-8", "surrogatepass")).hexdigest()[:10]
