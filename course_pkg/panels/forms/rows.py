"""A message as the lines of a table: one line for each value, short enough to send and to read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Any, TypedDict

from course_pkg.interfaces import Field

LIMIT = 200
ELEMENTS = 32


class Row(TypedDict):
    """One line; `text` is empty where the value stands in the lines below, one `depth` further in."""

    depth: int
    name: str
    type: str
    text: str


def rows(fields: Sequence[Field], texts: Mapping[str, Any], limit: int = LIMIT) -> list[Row]:
    """Return the lines for fields given as their tree of texts, at most `limit` of them."""
    lines = list(islice(_fields(fields, texts, 0), limit + 1))
    if len(lines) > limit:
        lines[limit - 1 :] = [Row(depth=0, name="…", type="", text="more than is shown here")]
    return lines


def summary(lines: Sequence[Row], width: int = 72) -> str:
    """Return the values of a table in one line of at most `width` characters."""
    line = ", ".join(f"{row['name']} {row['text']}" for row in lines if row["text"])
    return line if len(line) <= width else line[: width - 1] + "…"


def _fields(fields: Sequence[Field], texts: Mapping[str, Any], depth: int) -> Iterator[Row]:
    for field in fields:
        yield from _value(field, field.name, texts[field.name], depth)


def _value(field: Field, name: str, text: Any, depth: int) -> Iterator[Row]:  # noqa: ANN401 - a tree of texts
    if isinstance(text, list) and field.item is not None:
        yield from _elements(field.item, Row(depth=depth, name=name, type=field.type, text=""), text)
    elif isinstance(text, Mapping):
        yield Row(depth=depth, name=name, type=field.type, text="")
        yield from _fields(field.fields, text, depth + 1)
    else:
        yield Row(depth=depth, name=name, type=field.type, text=text)


def _elements(item: Field, row: Row, texts: list[Any]) -> Iterator[Row]:
    if all(isinstance(text, str) for text in texts):
        more = f", … ({len(texts)} in all)" if len(texts) > ELEMENTS else ""
        yield {**row, "text": f"[{', '.join(texts[:ELEMENTS])}{more}]"}
        return
    yield row
    for index, text in enumerate(texts[:ELEMENTS]):
        yield from _value(item, f"[{index}]", text, row["depth"] + 1)
    if len(texts) > ELEMENTS:
        yield Row(depth=row["depth"] + 1, name="…", type="", text=f"{len(texts)} elements in all")
