"""A type as plain data, for a form that is not written in Python."""

from __future__ import annotations

from typing import Any

from course_pkg.interfaces.fields import Field
from course_pkg.interfaces.text import show
from course_pkg.interfaces.types import MessageType, ServiceType
from course_pkg.interfaces.values import allowed, default


def schema(kind: ServiceType | MessageType) -> dict[str, Any]:
    """Return what a form needs to know of a type, as data that JSON can carry.

    A message: `name`, `md5`, `help`, `fields`, `constants`. A service: `name`, `md5`, and
    two messages, `request` and `response`. A field: `name`, `type`, `kind`, `default` (a text
    tree), `allowed` (in words), `help`; for a number `low` and `high`, as texts, since
    JavaScript rounds an int64; for an array `length` (null if it may vary) and `item`;
    for a message, time or duration `fields`.
    """
    if isinstance(kind, ServiceType):
        halves = {"request": schema(kind.request), "response": schema(kind.response)}
        return {"name": kind.name, "md5": kind.md5, **halves}
    constants = [{"name": each.name, "type": each.type, "value": str(each.value)} for each in kind.constants]
    return {
        "name": kind.name,
        "md5": kind.md5,
        "help": kind.help,
        "fields": [_field(each) for each in kind.fields],
        "constants": constants,
    }


def _field(field: Field) -> dict[str, Any]:
    described: dict[str, Any] = {
        "name": field.name,
        "type": field.type,
        "kind": field.kind.value,
        "default": show(field, default(field)),
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
