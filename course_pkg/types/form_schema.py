"""The description of a type as plain data, for a form in JavaScript."""

from __future__ import annotations

from typing import TypedDict, overload

from course_pkg.types.fields import Field, StringTree
from course_pkg.types.strings import format_value
from course_pkg.types.types import MessageType, ServiceType
from course_pkg.types.values import allowed, default


class ConstantSchema(TypedDict):
    """A constant; its value is a string, because JavaScript rounds an int64."""

    name: str
    type: str
    value: str


class _FieldSchema(TypedDict):
    name: str
    type: str
    kind: str
    default: StringTree
    allowed: str
    help: str


class FieldSchema(_FieldSchema, total=False):
    """A field: `kind` is a value of Kind, and `default` is a string tree.

    `allowed` describes the valid values. A number has `low` and `high` as strings, because JavaScript rounds
    an int64. An array has `length` (None if it may vary) and `item`. A message, a time or a duration has
    `fields`.
    """

    low: str
    high: str
    length: int | None
    item: FieldSchema
    fields: list[FieldSchema]


class MessageSchema(TypedDict):
    """A message type; `help` is the comment at the top of its definition."""

    name: str
    md5: str
    help: str
    fields: list[FieldSchema]
    constants: list[ConstantSchema]


class ServiceSchema(TypedDict):
    """A service type."""

    name: str
    md5: str
    request: MessageSchema
    response: MessageSchema


@overload
def schema(kind: ServiceType) -> ServiceSchema: ...
@overload
def schema(kind: MessageType) -> MessageSchema: ...
def schema(kind: ServiceType | MessageType) -> ServiceSchema | MessageSchema:
    """Return the data for a form of this type, ready for JSON."""
    if isinstance(kind, ServiceType):
        return {
            "name": kind.name,
            "md5": kind.md5,
            "request": schema(kind.request),
            "response": schema(kind.response),
        }
    return {
        "name": kind.name,
        "md5": kind.md5,
        "help": kind.help,
        "fields": [_field(each) for each in kind.fields],
        "constants": [
            {"name": each.name, "type": each.type, "value": str(each.value)} for each in kind.constants
        ],
    }


def _field(field: Field) -> FieldSchema:
    described: FieldSchema = {
        "name": field.name,
        "type": field.type,
        "kind": field.kind.value,
        "default": format_value(field, default(field)),
        "allowed": allowed(field),
        "help": field.help,
    }
    if field.low is not None:
        described |= {"low": str(field.low), "high": str(field.high)}
    if field.item is not None:
        described |= {"length": field.length, "item": _field(field.item)}
    if field.fields:
        described["fields"] = [_field(each) for each in field.fields]
    return described
