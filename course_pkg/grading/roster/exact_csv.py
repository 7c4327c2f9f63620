"""A CSV file in which single cells can be changed without a change of any other byte.

The csv module returns only the values of cells, so quotes, line endings and the byte order mark would be
lost. The format is RFC 4180, with any character as the separator.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

BREAK = r"\r\n|\n|\r"


@dataclass
class Record:
    """One record: `cells` as in the file, the line break `end` after them, and its line number."""

    cells: list[str]
    end: str
    line: int

    def value(self, place: int) -> str:
        """Return the value of a cell."""
        written = self.cells[place]
        if len(written) >= 2 and written[0] == written[-1] == '"':
            return written[1:-1].replace('""', '"')
        return written

    def put(self, place: int, value: str, separator: str) -> None:
        """Write a value into a cell; it gets quotes if the cell had quotes, or if the value needs them."""
        quotes = self.cells[place].startswith('"') or re.search(f'[{re.escape(separator)}"\r\n]', value)
        self.cells[place] = '"' + value.replace('"', '""') + '"' if quotes else value

    @property
    def blank(self) -> bool:
        """Whether the line is empty."""
        return self.cells == [""]


def records(text: str, separator: str) -> Iterator[Record]:
    """Yield the records of a CSV file.

    Moodle is written in PHP, which does not double a quote after a backslash. So a quote ends a cell only if
    a separator or a line break follows.
    """
    ends = rf"{re.escape(separator)}|{BREAK}|\Z"
    cell = re.compile(
        rf'(?P<cell>"[^"]*(?:(?:""|"(?!{ends}))[^"]*)*"(?={ends})|[^{re.escape(separator)}\r\n]*)(?P<end>{ends})'
    )
    cells: list[str] = []
    line = first = 1
    at = 0
    while at < len(text) or cells:
        found = cell.match(text, at)
        assert found, "every text begins with a cell, if only an empty one"
        cells.append(found["cell"])
        line += len(re.findall(BREAK, found[0]))
        at = found.end()
        if found["end"] != separator:
            yield Record(cells, found["end"], first)
            cells, first = [], line


def text_of(found: list[Record], separator: str) -> str:
    """Return the text of the records; if no cell was changed, this is the original text."""
    return "".join(separator.join(record.cells) + record.end for record in found)
