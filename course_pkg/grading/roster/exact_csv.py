"""Changes cells of a CSV file without a change of any other byte.

The csv module cannot be used, because it does not preserve quotes, line endings and the byte order mark. The
format is RFC 4180, with any character as the separator.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

BREAK = r"\r\n|\n|\r"


@dataclass
class Record:
    """One record of the file.

    `cells` contains the cells in their original form, and `end` is the line break.
    """

    cells: list[str]
    end: str
    line: int

    def value(self, place: int) -> str:
        """Return the value of the cell with the index `place`, without quotes."""
        written = self.cells[place]
        if len(written) >= 2 and written[0] == written[-1] == '"':
            return written[1:-1].replace('""', '"')
        return written

    def put(self, place: int, value: str, separator: str) -> None:
        """Write a value into the cell with the index `place`.

        The new cell is quoted if the old cell was quoted, or if the value needs quotes.
        """
        quotes = self.cells[place].startswith('"') or re.search(f'[{re.escape(separator)}"\r\n]', value)
        self.cells[place] = '"' + value.replace('"', '""') + '"' if quotes else value

    @property
    def blank(self) -> bool:
        """Whether the line is empty."""
        return self.cells == [""]


def records(text: str, separator: str) -> Iterator[Record]:
    """Yield the records of a CSV file.

    Moodle is written in PHP, and PHP's CSV writer does not double a quote that comes after a backslash.
    Therefore, a quote ends a cell only if a separator or a line break follows it.
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
        assert found, "every text begins with a cell, which can be empty"
        cells.append(found["cell"])
        line += len(re.findall(BREAK, found[0]))
        at = found.end()
        if found["end"] != separator:
            yield Record(cells, found["end"], first)
            cells, first = [], line


def text_of(found: list[Record], separator: str) -> str:
    """Return the text of the records; if no cell has changed, this text is the original text."""
    return "".join(separator.join(record.cells) + record.end for record in found)
