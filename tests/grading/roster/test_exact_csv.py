"""Tests of the editor for CSV files: a change of one cell changes no other byte of the file."""

from __future__ import annotations

import csv
import io
import random

import pytest

from course_pkg.grading.roster.exact_csv import Record, records, text_of

FILES = [
    "",
    "a",
    "a,b\n1,2\n",
    "a,b\r\n1,\r\n,",
    'a,b\r"1","2"\r',
    'a,"b\r\nb",c\n"x ""y"" z",2,"3"',
    "\ufeffa,b\n\n1,2\n\n",
    'a,b\n"unfinished,2\n3,4\n',
    'a,b\n"a \\"PHP\\" quote, 1",2\n',
]


@pytest.mark.parametrize("text", FILES)
def test_unchanged_is_unchanged(text: str) -> None:
    """A file that is read and written again has the same bytes."""
    assert text_of(list(records(text, ",")), ",") == text


def test_it_reads_as_the_csv_module_does() -> None:
    """If a file follows RFC 4180, the values are equal to the values from Python's csv module."""
    draw = random.Random(4)  # noqa: S311 -- the files are the same each time
    for _ in range(300):
        rows = [
            ["".join(draw.choices('ab,;"\r\n \u00fc', k=draw.randrange(6))) for _ in range(3)] for _ in "ab"
        ]
        buffer = io.StringIO()
        csv.writer(buffer, quoting=draw.choice([csv.QUOTE_ALL, csv.QUOTE_MINIMAL])).writerows(rows)
        found = list(records(buffer.getvalue(), ","))
        assert [[each.value(place) for place in range(3)] for each in found] == rows
        assert text_of(found, ",") == buffer.getvalue()


def test_quotes_of_php() -> None:
    """A quote after a backslash does not end a CSV cell."""
    [_, row] = records(FILES[-1], ",")
    assert [row.value(0), row.value(1)] == ['a \\"PHP\\" quote, 1', "2"]


def test_lines_are_counted_in_the_file() -> None:
    """Each CSV record contains the number of its first line in the file."""
    assert [each.line for each in records('a\n"1\n2"\nb\n', ",")] == [1, 2, 4]


@pytest.mark.parametrize(
    ("before", "value", "after"),
    [
        ("", "7.5", "7.5"),
        ('""', "7.5", '"7.5"'),
        ("", "7,5", '"7,5"'),
        ("old", 'say "x"', '"say ""x"""'),
        ("old", "two\nlines", '"two\nlines"'),
    ],
)
def test_how_a_cell_is_written(before: str, value: str, after: str) -> None:
    """A changed cell has quotes if the old cell had quotes or if the new value needs quotes."""
    record = Record([before, "x"], "\n", 1)
    record.put(0, value, ",")
    assert record.cells == [after, "x"]
    assert record.value(0) == value
