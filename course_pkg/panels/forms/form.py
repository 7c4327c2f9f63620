"""A message as a form: a string for each field, the errors in these strings, and a table of values."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import islice
from typing import TypeAlias, TypedDict

from course_pkg.errors import FieldError
from course_pkg.types import Field, Kind, MessageType, Plain, StringTree

# An array with more than `CONTROLS` elements has no separate input fields, but one line of text.
CONTROLS = 16
LIMIT = 200  # A table has at most this many rows.
ELEMENTS = 32  # A table shows at most this many elements of an array.
_NANO = 10**9

Draft: TypeAlias = dict[str, StringTree]  # A draft contains the text of each field in a form.
Values: TypeAlias = Mapping[str, Plain]


class Check(TypedDict, total=False):
    """The result of checking a form: the error of each wrong field, or commands that send the values.

    `refused` counts the clicks that had no effect because a field was wrong. The page compares `refused` with
    the previous value to notice such a click.
    """

    errors: dict[str, str]
    refused: int
    shell: str  # These terminal commands make the service call of the form.
    python: str
    once: str  # This terminal command publishes one message.
    often: str


class Row(TypedDict):
    """A row of a table of values.

    A value with several parts has an empty `text`; its parts are in the next rows, with a larger `depth`.
    """

    depth: int
    name: str
    type: str
    text: str


class MessageForm:
    """The form for a message; the function `commands` returns the commands that send the form's values."""

    def __init__(self, message: MessageType, commands: Callable[[Values], Check]) -> None:
        self.message = message
        self.blank: Draft = self.formatted(message.default())
        self._commands = commands

    def errors(self, draft: Draft) -> dict[str, str]:
        """Return the error message of each wrong field; the keys are the paths of the fields.

        Each top-level field has at most one message.
        """
        wrong: dict[str, str] = {}
        given = {**self.blank, **draft}
        for name in self.blank:
            try:
                self.message.parse({**self.blank, name: given[name]})
            except FieldError as error:
                wrong[error.field] = correction(error)
        return wrong

    def checked(self, draft: Draft) -> Check:
        """Check the form; return its errors, or the commands that send the form's values."""
        try:
            values = self.values(draft)
        except FieldError:
            return {"errors": self.errors(draft)}
        return {"errors": {}, **self._commands(values)}

    def values(self, draft: Draft) -> dict[str, Plain]:
        """Return the values of the message as numbers, strings, lists and dicts.

        Raises FieldError if a value is not valid.
        """
        return self.message.parse({**self.blank, **draft})

    def filled(self, draft: Draft, values: Values) -> Draft:
        """Return a copy of the draft in which the values replace the previous texts.

        Raises FieldError if a value is not valid for its field.
        """
        formatted = self.formatted(self.message.check({**self.message.default(), **values}))
        return {**draft, **{name: formatted[name] for name in values}}

    def formatted(self, values: Values) -> Draft:
        """Return the values as strings for the input fields of the form."""
        return compact(self.message.fields, self.message.format(values))


def correction(error: FieldError) -> str:
    """Return the text that the page shows next to a wrong field: the problem, and the allowed values."""
    hint = f"; {error.hint}" if error.hint else ""
    return f"{error.problem[:1].upper()}{error.problem[1:]}. Give {error.allowed}{hint}."


def compact(fields: Sequence[Field], strings: Mapping[str, StringTree]) -> Draft:
    """Return a copy of the strings in which each time is one number of seconds, and each long array one line.

    Only long arrays of numbers or booleans become one line of text.
    """
    return {field.name: _compact(field, strings[field.name]) for field in fields}


def _compact(field: Field, given: StringTree) -> StringTree:
    if isinstance(given, str):
        return given
    if isinstance(given, Mapping):
        if field.kind in (Kind.TIME, Kind.DURATION):
            return _seconds(int(str(given["secs"])), int(str(given["nsecs"])))
        return compact(field.fields, given)
    item = _item(field)
    if len(given) > CONTROLS and item.kind in (Kind.INTEGER, Kind.FLOAT, Kind.BOOL):
        return f"[{', '.join(map(str, given))}]"
    return [_compact(item, each) for each in given]


def _item(field: Field) -> Field:
    assert field.item is not None, "an array has an element"
    return field.item


def _seconds(secs: int, nsecs: int) -> str:
    total = secs * _NANO + nsecs
    whole, part = divmod(abs(total), _NANO)
    fraction = f"{part:09d}".rstrip("0")
    return f"{'-' if total < 0 else ''}{whole}{'.' if fraction else ''}{fraction}"


def rows(fields: Sequence[Field], strings: Mapping[str, StringTree], limit: int = LIMIT) -> list[Row]:
    """Return a table with a row for each value in `strings`; the table has at most `limit` rows."""
    lines = list(islice(_fields(fields, strings, 0), limit + 1))
    if len(lines) > limit:
        lines[limit - 1 :] = [Row(depth=0, name="…", type="", text="more values than are shown here")]
    return lines


def summary(lines: Sequence[Row], width: int = 72) -> str:
    """Return the values of a table in one line; `width` is the maximum number of characters."""
    line = ", ".join(f"{row['name']} {row['text']}" for row in lines if row["text"])
    return line if len(line) <= width else line[: width - 1] + "…"


def _fields(fields: Sequence[Field], strings: Mapping[str, StringTree], depth: int) -> Iterator[Row]:
    for field in fields:
        yield from _value(field, field.name, strings[field.name], depth)


def _value(field: Field, name: str, given: StringTree, depth: int) -> Iterator[Row]:
    row = Row(depth=depth, name=name, type=field.type, text="")
    if isinstance(given, str):
        yield {**row, "text": given}
    elif isinstance(given, Mapping):
        yield row
        yield from _fields(field.fields, given, depth + 1)
    else:
        yield from _elements(_item(field), row, given)


def _elements(item: Field, row: Row, given: Sequence[StringTree]) -> Iterator[Row]:
    strings = [each for each in given if isinstance(each, str)]
    if len(strings) == len(given):
        more = f", … ({len(given)} in all)" if len(given) > ELEMENTS else ""
        yield {**row, "text": f"[{', '.join(strings[:ELEMENTS])}{more}]"}
        return
    yield row
    for index, each in enumerate(given[:ELEMENTS]):
        yield from _value(item, f"[{index}]", each, row["depth"] + 1)
    if len(given) > ELEMENTS:
        yield Row(depth=row["depth"] + 1, name="…", type="", text=f"{len(given)} elements in all")
