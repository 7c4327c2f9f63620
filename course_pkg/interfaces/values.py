"""Plain values of a field: the default, the check, to a genpy message and back."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Collection, Mapping
from numbers import Integral, Real

import genpy
from genpy.rostime import TVal

from course_pkg.errors import FieldError
from course_pkg.interfaces.fields import Field, Kind, Value
from course_pkg.interfaces.numbers import float32


def default(field: Field) -> Value:
    """Return the value that ROS gives a field which nobody sets."""
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        return [default(field.item) for _ in range(field.length or 0)]
    if field.fields or field.kind is Kind.MESSAGE:
        return {part.name: default(part) for part in field.fields}
    return {Kind.INTEGER: 0, Kind.FLOAT: 0.0, Kind.BOOL: False, Kind.STRING: ""}[field.kind]


def check(field: Field, value: Value, path: str) -> Value:
    """Return the value as the plain one that the field holds. Raises FieldError."""
    if field.kind is Kind.ARRAY:
        return _check_array(field, value, path)
    if field.kind is Kind.MESSAGE or field.fields:
        return check_fields(field.fields, value, path, allowed(field))
    checkers = {
        Kind.INTEGER: _check_integer,
        Kind.FLOAT: _check_float,
        Kind.BOOL: _check_bool,
        Kind.STRING: _check_string,
    }
    return checkers[field.kind](field, value, path)


def check_fields(fields: tuple[Field, ...], values: Value, path: str, expected: str) -> dict[str, Value]:
    """Return the checked values of a message's fields, in their order. Raises FieldError."""
    if isinstance(values, (genpy.Message, TVal)):
        values = {name: getattr(values, name) for name in values.__slots__}
    same_names(fields, values, path, expected)
    return {field.name: check(field, values[field.name], member(path, field.name)) for field in fields}


def same_names(fields: tuple[Field, ...], values: Value, path: str, expected: str) -> None:
    """Raise FieldError unless `values` is a mapping with exactly the fields' names."""
    if not isinstance(values, Mapping):
        raise FieldError(path, values, expected, f"{brief(values)} is not a set of named fields")
    names = [field.name for field in fields]
    known = f"the fields {', '.join(names)}" if names else "no field at all"
    for name in values:
        if name not in names:
            raise FieldError(
                member(path, str(name)), values[name], known, "no such field", _closest(name, names)
            )
    for field in fields:
        if field.name not in values:
            raise FieldError(member(path, field.name), None, allowed(field), "this field is missing")


def to_message(field: Field, value: Value) -> Value:
    """Return a checked value as genpy holds it."""
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        if field.is_bytes:
            return bytes(value)
        return list(value) if field.item.kind.is_scalar else [to_message(field.item, each) for each in value]
    if field.kind is Kind.MESSAGE:
        return build(field.cls, field.fields, value)
    if field.kind in (Kind.TIME, Kind.DURATION):
        return (genpy.Time if field.kind is Kind.TIME else genpy.Duration)(value["secs"], value["nsecs"])
    return value


def build(
    cls: Callable[[], genpy.Message], fields: tuple[Field, ...], values: Mapping[str, Value]
) -> genpy.Message:
    """Return a message of class `cls` with checked values in it."""
    message = cls()
    for field in fields:
        setattr(message, field.name, to_message(field, values[field.name]))
    return message


def allowed(field: Field) -> str:
    """Return in words what a field can hold: `a float32 from -3.4e38 to 3.4e38, such as 1.5`."""
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
    return "true or false" if field.kind is Kind.BOOL else "a text"


def member(path: str, name: str) -> str:
    """Return the path of a field inside the one at `path`."""
    return f"{path}.{name}" if path else name


def brief(value: object) -> str:
    """Return a value for an error message, shortened."""
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}…"


def _check_array(field: Field, value: Value, path: str) -> list[Value]:
    assert field.item is not None
    if field.is_bytes and isinstance(value, (bytes, bytearray)):
        value = list(value)
    if hasattr(value, "tolist"):
        # numpy's own numbers are slow one by one.
        value = value.tolist()
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Collection):
        raise FieldError(path, value, allowed(field), f"{brief(value)} is not a list")
    items = list(value)
    right_length(field, items, path)
    if _plain_numbers(field.item, items):
        return items
    return [check(field.item, each, f"{path}[{index}]") for index, each in enumerate(items)]


def right_length(field: Field, items: list[Value], path: str) -> None:
    """Raise FieldError unless a list has the length of its array."""
    if field.length is not None and len(items) != field.length:
        raise FieldError(path, items, allowed(field), f"{len(items)} elements given")


def _plain_numbers(item: Field, items: list[Value]) -> bool:
    """Tell at once that all elements are right, as an image of a million of them mostly is."""
    if item.kind is Kind.INTEGER and items and set(map(type, items)) == {int}:
        assert item.low is not None
        assert item.high is not None
        return bool(min(items) >= item.low and max(items) <= item.high)
    return item.type == "float64" and set(map(type, items)) == {float} and not any(map(math.isnan, items))


def _check_integer(field: Field, value: Value, path: str) -> int:
    if isinstance(value, bool) or not isinstance(value, Integral):
        whole = isinstance(value, float) and value.is_integer()
        hint = f"write {int(value)}" if whole else ""
        raise FieldError(path, value, allowed(field), f"{brief(value)} is not an integer", hint)
    number = int(value)
    assert field.low is not None
    assert field.high is not None
    if not field.low <= number <= field.high:
        raise FieldError(path, value, allowed(field), f"{brief(number)} is out of range")
    return number


def _check_float(field: Field, value: Value, path: str) -> float:
    if isinstance(value, bool) or not isinstance(value, Real):
        raise FieldError(path, value, allowed(field), f"{brief(value)} is not a number")
    try:
        number = float(value)
        if field.type == "float32":
            return float32(number)
    except OverflowError:
        raise FieldError(path, value, allowed(field), f"{brief(value)} is out of range") from None
    return math.nan if math.isnan(number) else number


def _check_bool(field: Field, value: Value, path: str) -> bool:
    if isinstance(value, bool) or (isinstance(value, Integral) and value in (0, 1)):
        return bool(value)
    if hasattr(value, "item") and isinstance(value.item(), bool):
        return bool(value)
    raise FieldError(path, value, allowed(field), f"{brief(value)} is neither true nor false")


def _check_string(field: Field, value: Value, path: str) -> str:
    if not isinstance(value, str):
        raise FieldError(path, value, allowed(field), f"{brief(value)} is not a text")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise FieldError(
            path,
            value,
            allowed(field),
            f"character {error.start + 1} is half of a surrogate pair, which UTF-8 cannot hold",
        ) from None
    return str(value)


def _article(word: str) -> str:
    # "an int8", "a uint8": the latter is said with a y.
    return "an" if word[0] in "aeiAEI" else "a"


def _closest(name: object, names: list[str]) -> str:
    lower = {each.lower(): each for each in names}
    found = difflib.get_close_matches(str(name).lower(), lower, n=1)
    return f"did you mean {lower[found[0]]}?" if found else ""
