"""Convert values to strings that people can read and type, and convert such strings to values.

A string tree has the structure of a message, with a string instead of each number, string or bool. An array
may also be one string (`[1, 2, 3]` or `1, 2, 3`). A message may also be one string (`{x: 1, y: 2}`). Both
strings are in YAML's flow style. A time or duration may be a number of seconds (`1.5`).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from decimal import Decimal

import yaml

from course_pkg.errors import FieldError
from course_pkg.types.fields import Field, Kind, Plain, StringTree, elements, members
from course_pkg.types.numbers import float32, nearest_number, parse_float, parse_integer
from course_pkg.types.values import allowed, brief, check, member_path, require_length, require_names

_TRUE = frozenset({"true", "yes", "on", "1"})
_FALSE = frozenset({"false", "no", "off", "0"})
_SECONDS = re.compile(r"([+-]?)(\d*)(?:\.(\d{1,9})0*)?", re.ASCII)


def format_value(field: Field, value: Plain) -> StringTree:
    """Convert a value into a string tree: nested dicts and lists of strings."""
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        # This code has to be fast, because an image has a million elements.
        if field.item.kind is Kind.INTEGER:
            return list(map(str, elements(value)))
        return [format_value(field.item, each) for each in elements(value)]
    if field.kind is Kind.MESSAGE or field.fields:
        return {part.name: format_value(part, members(value)[part.name]) for part in field.fields}
    if field.kind is Kind.FLOAT:
        assert isinstance(value, (int, float))
        return repr(float32(value) if field.type == "float32" else float(value))
    if field.kind is Kind.BOOL:
        return "true" if value else "false"
    return str(value)


def parse_value(field: Field, text: StringTree, path: str) -> Plain:
    """Convert a string tree into a value of the field.

    Raises FieldError if a string is not valid for its field.
    """
    if field.kind is Kind.ARRAY:
        return _parse_array(field, text, path)
    if field.kind in (Kind.TIME, Kind.DURATION) and isinstance(text, str) and "{" not in text:
        return _parse_seconds(field, text, path)
    if field.kind is Kind.MESSAGE or field.fields:
        return parse_fields(field.fields, text, path, allowed(field))
    if not isinstance(text, str):
        # `text` may also be a value that needs no conversion, such as a number.
        return check(field, text, path)
    if field.kind is Kind.STRING:
        return check(field, text, path)
    return _parse_bool(field, text, path) if field.kind is Kind.BOOL else _parse_number(field, text, path)


def parse_fields(fields: tuple[Field, ...], tree: StringTree, path: str, expected: str) -> dict[str, Plain]:
    """Convert the string tree of a message into a dict, in the order of the fields.

    Raises FieldError if a string is not valid for its field.
    """
    if isinstance(tree, str):
        tree = _parse_flow(tree, "{", "}", path, expected)
    require_names(fields, tree, path, expected)
    assert isinstance(tree, Mapping)
    return {
        field.name: parse_value(field, tree[field.name], member_path(path, field.name)) for field in fields
    }


def _parse_array(field: Field, tree: StringTree, path: str) -> Sequence[Plain]:
    assert field.item is not None
    if isinstance(tree, str):
        tree = _parse_flow(tree, "[", "]", path, allowed(field))
    if not isinstance(tree, (list, tuple)):
        return elements(check(field, tree, path))
    require_length(field, tree, path)
    return [parse_value(field.item, each, f"{path}[{index}]") for index, each in enumerate(tree)]


def _parse_flow(text: str, opening: str, closing: str, path: str, expected: str) -> StringTree:
    """Return the strings in a YAML flow list or dict; `text` may omit the outer brackets."""
    whole = text.strip()
    if not whole.startswith(opening):
        whole = f"{opening}{whole}{closing}"
    try:
        # BaseLoader reads every scalar as a string; each field then parses its own string.
        tree: StringTree = yaml.load(whole, Loader=yaml.BaseLoader)  # noqa: S506 - it constructs only strings
    except yaml.YAMLError as error:
        reason = getattr(error, "problem", None) or "it cannot be read"
        problem = f"{brief(text)} is not well formed ({reason})"
        raise FieldError(path, text, expected, problem, f"write it as {opening}…{closing}") from error
    return tree


def _parse_seconds(field: Field, text: str, path: str) -> Mapping[str, Plain]:
    found = _SECONDS.fullmatch(text.strip())
    if not found or not (found[2] or found[3]):
        raise FieldError(path, text, allowed(field), f"{brief(text)} is not a number of seconds")
    nanoseconds = int(Decimal(f"{found[1]}{found[2] or 0}.{found[3] or 0}").scaleb(9))
    secs, nsecs = divmod(nanoseconds, 10**9)
    return members(check(field, {"secs": secs, "nsecs": nsecs}, path))


def _parse_bool(field: Field, text: str, path: str) -> bool:
    word = text.strip().lower()
    if word in _TRUE or word in _FALSE:
        return word in _TRUE
    raise FieldError(path, text, allowed(field), f"{brief(text)} is neither true nor false")


def _parse_number(field: Field, text: str, path: str) -> int | float:
    whole = field.kind is Kind.INTEGER
    stripped = text.strip()
    try:
        number = parse_integer(stripped) if whole else parse_float(stripped)
    except ValueError:
        raise _not_a_number(field, text, path) from None
    checked = check(field, number, path)
    assert isinstance(checked, (int, float))
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
