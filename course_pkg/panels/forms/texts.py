"""A message's texts as a form holds them: one text where one control suffices."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from course_pkg.interfaces import Field, Kind

Texts = dict[str, Any]

CONTROLS = 16  # more elements than this are edited as one line of text, not as controls of their own
_NANO = 10**9


def compact(fields: Sequence[Field], texts: Texts) -> Texts:
    """Return the tree of texts with each time in seconds, and each long array of plain values as one line."""
    return {field.name: _compact(field, texts[field.name]) for field in fields}


def _compact(field: Field, texts: Any) -> Any:  # noqa: ANN401 - a tree of texts
    if field.kind in (Kind.TIME, Kind.DURATION):
        return _seconds(int(texts["secs"]), int(texts["nsecs"]))
    if field.kind is Kind.MESSAGE:
        return compact(field.fields, texts)
    if field.kind is not Kind.ARRAY:
        return texts
    if len(texts) > CONTROLS and _item(field).kind in (Kind.INTEGER, Kind.FLOAT, Kind.BOOL):
        return f"[{', '.join(texts)}]"
    return [_compact(_item(field), each) for each in texts]


def _item(field: Field) -> Field:
    assert field.item is not None, "an array has an element"
    return field.item


def _seconds(secs: int, nsecs: int) -> str:
    total = secs * _NANO + nsecs
    whole, part = divmod(abs(total), _NANO)
    fraction = f"{part:09d}".rstrip("0")
    return f"{'-' if total < 0 else ''}{whole}{'.' if fraction else ''}{fraction}"
