"""Values as the texts that a person reads and types, and back.

A text tree has a message's shape with a text for every number, string or bool.
In its place, an array may be one text (`[1, 2, 3]` or `1, 2, 3`), a message may
be one text (`{x: 1, y: 2}`), both in YAML's flow style, and a time or duration
may be a number of seconds (`1.5`).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from decimal import Decimal

import yaml

from course_pkg.errors import FieldError
from course_pkg.interfaces.fields import Field, Kind, TextTree, Value
from course_pkg.interfaces.numbers import float32, float_text, nearest_number, read_float, read_integer
from course_pkg.interfaces.values import allowed, brief, check, member, right_length, same_names

_TRUE = frozenset({"true", "yes", "on", "1"})
_FALSE = frozenset({"false", "no", "off", "0"})
_SECONDS = re.compile(r"([+-]?)(\d*)(?:\.(\d{1,9})0*)?", re.ASCII)


def show(field: Field, value: Value) -> TextTree:
    """Return the text tree of a value; a list or dict of texts where the value is one of values."""
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        # An image has a million of them.
        return (
            list(map(str, value))
            if field.item.kind is Kind.INTEGER
            else [show(field.item, each) for each in value]
        )
    if field.kind is Kind.MESSAGE or field.fields:
        return {part.name: show(part, value[part.name]) for part in field.fields}
    if field.kind is Kind.FLOAT:
        return float_text(float32(value) if field.type == "float32" else float(value))
    if field.kind is Kind.BOOL:
        return "true" if value else "false"
    return str(value)


def read(field: Field, text: TextTree, path: str) -> Value:
    """Return the plain value of a text tree. Raises FieldError."""
    if field.kind is Kind.ARRAY:
        return _read_array(field, text, path)
    if field.kind in (Kind.TIME, Kind.DURATION) and isinstance(text, str) and "{" not in text:
        return _read_seconds(field, text, path)
    if field.kind is Kind.MESSAGE or field.fields:
        return read_fields(field.fields, text, path, allowed(field))
    if not isinstance(text, str):
        # A plain value among the texts is as good as its text.
        return check(field, text, path)
    if field.kind is Kind.STRING:
        return check(field, text, path)
    return _read_bool(field, text, path) if field.kind is Kind.BOOL else _read_number(field, text, path)


def read_fields(fields: tuple[Field, ...], texts: TextTree, path: str, expected: str) -> dict[str, Value]:
    """Return the plain values of a message's fields, in their order. Raises FieldError."""
    if isinstance(texts, str):
        texts = _flow(texts, "{", "}", path, expected)
    same_names(fields, texts, path, expected)
    return {field.name: read(field, texts[field.name], member(path, field.name)) for field in fields}


def _read_array(field: Field, text: TextTree, path: str) -> list[Value]:
    assert field.item is not None
    if isinstance(text, str):
        text = _flow(text, "[", "]", path, allowed(field))
    if isinstance(text, Mapping) or not isinstance(text, (list, tuple)):
        return list(check(field, text, path))
    right_length(field, list(text), path)
    return [read(field.item, each, f"{path}[{index}]") for index, each in enumerate(text)]


def _flow(text: str, opening: str, closing: str, path: str, expected: str) -> TextTree:
    """Return the texts in a YAML flow list or dict, the brackets of which may be left out."""
    whole = text.strip()
    if not whole.startswith(opening):
        whole = f"{opening}{whole}{closing}"
    try:
        # BaseLoader makes every scalar a text, so that each field reads its own.
        tree = yaml.load(whole, Loader=yaml.BaseLoader)  # noqa: S506 - it constructs nothing but text
    except yaml.YAMLError as error:
        reason = getattr(error, "problem", None) or "it cannot be read"
        problem = f"{brief(text)} is not well formed ({reason})"
        raise FieldError(path, text, expected, problem, f"write it as {opening}…{closing}") from error
    return tree


def _read_seconds(field: Field, text: str, path: str) -> dict[str, Value]:
    found = _SECONDS.fullmatch(text.strip())
    if not found or not (found[2] or found[3]):
        raise FieldError(path, text, allowed(field), f"{brief(text)} is not a number of seconds")
    nanoseconds = int(Decimal(f"{found[1]}{found[2] or 0}.{found[3] or 0}").scaleb(9))
    secs, nsecs = divmod(nanoseconds, 10**9)
    return dict(check(field, {"secs": secs, "nsecs": nsecs}, path))


def _read_bool(field: Field, text: str, path: str) -> bool:
    word = text.strip().lower()
    if word in _TRUE or word in _FALSE:
        return word in _TRUE
    raise FieldError(path, text, allowed(field), f"{brief(text)} is neither true nor false")


def _read_number(field: Field, text: str, path: str) -> int | float:
    whole = field.kind is Kind.INTEGER
    stripped = text.strip()
    try:
        number = read_integer(stripped) if whole else read_float(stripped)
    except ValueError:
        raise _not_a_number(field, text, path) from None
    checked: int | float = check(field, number, path)
    if not whole and abs(checked) == float("inf") and "inf" not in stripped.lower():
        raise FieldError(path, text, allowed(field), f"{brief(text)} is out of range")
    return checked


def _not_a_number(field: Field, text: str, path: str) -> FieldError:
    wanted = "an integer" if field.kind is Kind.INTEGER else "a number"
    if not text.strip():
        return FieldError(path, text, allowed(field), "nothing is written here")
    meant = nearest_number(text, field.kind is Kind.INTEGER)
    return FieldError(
        path, text, allowed(field), f"{brief(text)} is not {wanted}", f"write {meant}" if meant else ""
    )
