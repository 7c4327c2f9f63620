"""The values of a field: the default value, the check of a value, and the conversion for genpy."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Collection, Mapping, Sequence
from numbers import Integral, Real
from typing import TypeAlias

import genpy
from genpy.rostime import TVal

from course_pkg.errors import FieldError
from course_pkg.types.fields import Field, Kind, MessageClass, Plain, elements, members
from course_pkg.types.numbers import float32

# This is a value in the representation that genpy uses.
Genpy: TypeAlias = "Plain | genpy.Message | TVal | Sequence[Genpy]"


def default(field: Field) -> Plain:
    """Return the value that a field has in ROS if it is not set."""
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        return [default(field.item) for _ in range(field.length or 0)]
    if field.fields or field.kind is Kind.MESSAGE:
        return {part.name: default(part) for part in field.fields}
    scalars: dict[Kind, Plain] = {Kind.INTEGER: 0, Kind.FLOAT: 0.0, Kind.BOOL: False, Kind.STRING: ""}
    return scalars[field.kind]


def check(field: Field, value: object, path: str) -> Plain:
    """Convert a value to the type of the field, and return the converted value.

    Raises FieldError if the value is not valid for the field.
    """
    if field.kind is Kind.ARRAY:
        return _check_array(field, value, path)
    if field.kind is Kind.MESSAGE or field.fields:
        return check_fields(field.fields, value, path, allowed(field))
    checkers: dict[Kind, Callable[[Field, object, str], Plain]] = {
        Kind.INTEGER: _check_integer,
        Kind.FLOAT: _check_float,
        Kind.BOOL: _check_bool,
        Kind.STRING: _check_string,
    }
    return checkers[field.kind](field, value, path)


def check_fields(fields: tuple[Field, ...], values: object, path: str, expected: str) -> dict[str, Plain]:
    """Return the checked values of a message's fields, in the order of the fields.

    Raises FieldError if a value is not valid for its field.
    """
    if isinstance(values, (genpy.Message, TVal)):
        values = {name: getattr(values, name) for name in values.__slots__}
    require_names(fields, values, path, expected)
    assert isinstance(values, Mapping)
    return {field.name: check(field, values[field.name], member_path(path, field.name)) for field in fields}


def require_names(fields: tuple[Field, ...], values: object, path: str, expected: str) -> None:
    """Raise FieldError if `values` is not a mapping with exactly the names of the fields."""
    if not isinstance(values, Mapping):
        raise FieldError(path, values, expected, f"{brief(values)} is not a set of named fields")
    names = [field.name for field in fields]
    known = f"the fields {', '.join(names)}" if names else "no fields"
    for name in values:
        if name not in names:
            raise FieldError(
                member_path(path, str(name)), values[name], known, "no such field", _closest(name, names)
            )
    for field in fields:
        if field.name not in values:
            raise FieldError(member_path(path, field.name), None, allowed(field), "this field is missing")


def to_genpy(field: Field, value: Plain) -> Genpy:
    """Return a checked value in the representation that genpy uses."""
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        if field.is_bytes:
            return bytes(each for each in elements(value) if isinstance(each, int))
        if field.item.kind.is_scalar:
            return list(elements(value))
        return [to_genpy(field.item, each) for each in elements(value)]
    if field.kind is Kind.MESSAGE:
        assert field.cls is not None
        return build(field.cls, field.fields, members(value))
    if field.kind in (Kind.TIME, Kind.DURATION):
        make = genpy.Time if field.kind is Kind.TIME else genpy.Duration
        return make(members(value)["secs"], members(value)["nsecs"])
    return value


def build(cls: MessageClass, fields: tuple[Field, ...], values: Mapping[str, Plain]) -> genpy.Message:
    """Return a message of class `cls` with these checked values."""
    message = cls()
    for field in fields:
        setattr(message, field.name, to_genpy(field, values[field.name]))
    return message


def allowed(field: Field) -> str:
    """Return a description of a field's valid values, for example "an int8 from -128 to 127"."""
    if field.kind is Kind.INTEGER:
        return f"{_article(field.type)} {field.type} from {field.low} to {field.high}"
    if field.kind is Kind.FLOAT:
        limit = "3.4e38" if field.type == "float32" else "1.8e308"
        return f"a {field.type} from -{limit} to {limit}, such as 1.5"
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        count = "a list" if field.length is None else f"a list of exactly {field.length} elements"
        return f"{count}, each {allowed(field.item)}"
    if field.kind in (Kind.TIME, Kind.DURATION):
        return f"a {field.type} with secs and nsecs"
    if field.kind is Kind.MESSAGE:
        names = ", ".join(part.name for part in field.fields)
        return f"{_article(field.type)} {field.type} with {f'the fields {names}' if names else 'no fields'}"
    return "true or false" if field.kind is Kind.BOOL else "a string"


def member_path(path: str, name: str) -> str:
    """Return the path of a field inside the field at the path `path`."""
    return f"{path}.{name}" if path else name


def brief(value: object) -> str:
    """Return the representation of a value, shortened for an error message."""
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}…"


def _check_array(field: Field, value: object, path: str) -> list[Plain]:
    assert field.item is not None
    if field.is_bytes and isinstance(value, (bytes, bytearray)):
        value = list(value)
    if hasattr(value, "tolist"):
        # tolist() is much faster than converting each NumPy number separately.
        value = value.tolist()
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Collection):
        raise FieldError(path, value, allowed(field), f"{brief(value)} is not a list")
    items = list(value)
    require_length(field, items, path)
    if _all_valid(field.item, items):
        return items
    return [check(field.item, each, f"{path}[{index}]") for index, each in enumerate(items)]


def require_length(field: Field, items: Sequence[object], path: str) -> None:
    """Raise FieldError if a list does not have the length that its array field requires."""
    if field.length is not None and len(items) != field.length:
        raise FieldError(path, items, allowed(field), f"{len(items)} elements were given")


def _all_valid(item: Field, items: list[float]) -> bool:
    """Return whether all elements are valid numbers; this is fast even for large arrays, such as an image."""
    if item.kind is Kind.INTEGER and items and set(map(type, items)) == {int}:
        assert item.low is not None
        assert item.high is not None
        return bool(min(items) >= item.low and max(items) <= item.high)
    return item.type == "float64" and set(map(type, items)) == {float} and not any(map(math.isnan, items))


def _check_integer(field: Field, value: object, path: str) -> int:
    if isinstance(value, bool) or not isinstance(value, Integral):
        hint = f"write {int(value)}" if isinstance(value, float) and value.is_integer() else ""
        raise FieldError(path, value, allowed(field), f"{brief(value)} is not an integer", hint)
    number = int(value)
    assert field.low is not None
    assert field.high is not None
    if not field.low <= number <= field.high:
        raise FieldError(path, value, allowed(field), f"{brief(number)} is out of range")
    return number


def _check_float(field: Field, value: object, path: str) -> float:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise FieldError(path, value, allowed(field), f"{brief(value)} is not a number")
    try:
        number = float(value)
        if field.type == "float32":
            return float32(number)
    except OverflowError:
        raise FieldError(path, value, allowed(field), f"{brief(value)} is out of range") from None
    return math.nan if math.isnan(number) else number


def _check_bool(field: Field, value: object, path: str) -> bool:
    if isinstance(value, bool) or (isinstance(value, Integral) and value in (0, 1)):
        return bool(value)
    if hasattr(value, "item") and isinstance(value.item(), bool):
        return bool(value)
    raise FieldError(path, value, allowed(field), f"{brief(value)} is neither true nor false")


def _check_string(field: Field, value: object, path: str) -> str:
    if not isinstance(value, str):
        raise FieldError(path, value, allowed(field), f"{brief(value)} is not a string")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise FieldError(
            path,
            value,
            allowed(field),
            f"character {error.start + 1} is half of a surrogate pair, which is not possible in UTF-8",
        ) from None
    return str(value)


def _article(word: str) -> str:
    # The article of "int8" is "an", and the article of "uint8" is "a".
    return "an" if word[0] in "aeiAEI" else "a"


def _closest(name: object, names: list[str]) -> str:
    lower = {each.lower(): each for each in names}
    found = difflib.get_close_matches(str(name).lower(), lower, n=1)
    return f"did you mean {lower[found[0]]}?" if found else ""
