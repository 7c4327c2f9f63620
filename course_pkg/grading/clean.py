"""Whatever comes from a submission, made harmless for a page, a table, XML and the name of a file.

The one place for it. A text that was cleaned stays as it is when it is cleaned again.
"""

from __future__ import annotations

import hashlib
import re
import unicodedata
from html import escape
from typing import Any

LONG = 4_000  # characters of a text of many lines
SHORT = 300  # of one line
NAME = 60  # of a file's name
LINES = 200
ITEMS = 1_000  # of a list in a record

ANSI = re.compile(
    r"\x1b\][^\x07\x1b]*(?:\x07|\x1b\\)?"  # what sets a title, or makes a link
    r"|(?:\x1b\[|\x9b)[0-?]*[ -/]*[@-~]?"  # colours, movements
    r"|\x1b[PX^_][^\x1b]*(?:\x1b\\)?"  # strings for a device
    r"|\x1b[ -/]*[0-~]?"
)
UNSEEN = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f"  # control characters; tab, line feed and return are dealt with
    "\u00ad\u061c\u180e\u200b\u200e\u200f\u2060-\u206f\ufeff\ufff9-\ufffb"  # what turns or hides letters
    "\u202a-\u202e\U000e0000-\U000e007f]"
)
ILLEGAL = re.compile("[\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff]")  # halves of pairs, and what is no character
BREAKS = re.compile("\r\n?|[\u2028\u2029]")
FORMULA = "=+-@\uff1d\uff0b\uff0d\uff20"  # with the wide forms that some spreadsheets take for the same
DEVICES = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|com\d|lpt\d)(\..*)?", re.IGNORECASE)
PLAIN_NAME = re.compile(r"[a-z0-9][a-z0-9._-]*")
MARKED = re.compile(r"-[0-9a-f]{10}")  # how file_name() ends the name of what had to be changed


def text(value: object, limit: int = LONG) -> str:
    """Return a text of at most `limit` characters and LINES lines that shows what it is."""
    whole = str(value)
    kept = BREAKS.sub("\n", ANSI.sub("", whole[: 4 * limit + 1000]))
    kept = ILLEGAL.sub("\ufffd", UNSEEN.sub("", kept))
    lines = kept.split("\n")
    if len(kept) <= limit and len(lines) <= LINES and len(whole) <= 4 * limit + 1000:
        return kept
    mark = " … (cut)"
    return "\n".join(lines[:LINES])[: limit - len(mark)].removesuffix(mark) + mark


def line(value: object, limit: int = SHORT) -> str:
    """Return the same as one line."""
    return " ".join(text(value, limit).split())


def html(value: object, limit: int = LONG) -> str:
    """Return a text for a page: no markup in it."""
    return escape(text(value, limit), quote=True)


def cell(value: object, limit: int = SHORT) -> str:
    """Return one line for a table: no spreadsheet takes it for a formula."""
    kept = line(value, limit)
    return f"'{kept}" if kept.startswith(tuple(FORMULA)) else kept


def data(value: Any) -> Any:  # noqa: ANN401 -- plain data of any shape
    """Return plain data with every text in it cleaned, and no list of endless length."""
    if isinstance(value, str):
        return text(value)
    if isinstance(value, dict):
        return {line(key): data(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [data(item) for item in value[:ITEMS]]
    return value


def identity(name: str) -> str:
    """Return the name of a student as it stands in records; another name stays another one."""
    known = unicodedata.normalize("NFC", name)
    kept = line(known, 120)
    return kept if kept == known else f"{kept}~{_mark(name)}".strip()


def file_name(name: str) -> str:
    """Return the name of a file or folder for `name`: plain, never one of a device, never out of its folder.

    Names that differ stay apart, also where capitals do not count: whatever had to be changed ends in a mark
    of its own.
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
