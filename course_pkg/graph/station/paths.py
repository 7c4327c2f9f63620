"""Where in a message a number stands: `data`, `pose.position.x`, `position[0]`."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from typing import Any

import genpy

from course_pkg.interfaces import Field, Kind, MessageType

ELEMENTS = 8  # of an array, as many as can be picked
MOST = 200  # numbers of a message; in arrays of arrays there may be thousands

_NUMBERS = (Kind.INTEGER, Kind.FLOAT, Kind.BOOL)


def numbers(message: MessageType) -> list[str]:
    """Return the paths of all numbers in a message; of an array, those of its first elements."""
    return list(islice((path for field in message.fields for path in _paths(field, field.name)), MOST))


def extractor(message: MessageType, path: str) -> Callable[[bytes], float]:
    """Return what finds the number at a path in a message's bytes; NaN where it is not there.

    Raises ValueError for a path that the type does not have.
    """
    if path not in numbers(message):
        raise ValueError(f"{message.name} has no number {path!r}")
    steps = [int(step) if step.isdigit() else step for step in re.findall(r"\w+", path)]
    cls = message.cls

    def extract(body: bytes) -> float:
        try:
            return float(_walk(cls().deserialize(body), steps))
        except (genpy.DeserializationError, IndexError, TypeError, ValueError):
            return math.nan

    return extract


def _walk(value: Any, steps: Sequence[int | str]) -> Any:  # noqa: ANN401 -- a message, and what it holds
    for step in steps:
        value = value[step] if isinstance(step, int) else getattr(value, step)
    return value


def _paths(field: Field, path: str) -> Iterator[str]:
    if field.kind in _NUMBERS:
        yield path
    elif field.kind is Kind.ARRAY and field.item is not None:
        for index in range(min(ELEMENTS, ELEMENTS if field.length is None else field.length)):
            yield from _paths(field.item, f"{path}[{index}]")
    elif field.kind is Kind.MESSAGE:
        for each in field.fields:
            yield from _paths(each, f"{path}.{each.name}")
