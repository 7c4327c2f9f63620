"""A service or message type as plain data for a page: its fields as a tree, its text, the lines to copy."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from course_pkg.errors import InterfaceError
from course_pkg.interfaces import (
    Field,
    Half,
    Kind,
    MessageType,
    ServiceType,
    definition_file,
    message_type,
    read_definition,
    service_type,
    type_in_file,
)

State = dict[str, Any]
TOOLS = {"srv": "rossrv", "msg": "rosmsg"}
CHANGED = (
    "The file has changed since the type was built: what is shown is what programs here still use. Build it "
    "again with catkin_make, and restart the kernel."
)
UNBUILT = (
    "Not built yet: ROS's tools show it from its file, but the import works only after catkin_make, in a "
    "terminal or kernel that has sourced the workspace."
)
NO_FILE = "No file of it is on ROS_PACKAGE_PATH: it is known only as it was built."


def described(name: str, half: Half) -> State:
    """Return what the page shows of a type; `problem` says why that is nothing, `warning` what to heed.

    A type that cannot be read still has its file and its text.
    """
    file = _file(name, half)
    state: State = {
        "name": name,
        "half": half,
        "problem": "",
        "warning": "",
        "parts": [],
        "md5": "",
        "built": True,
    }
    state |= {
        "file": str(file or ""),
        "text": read_definition(file) if file else "",
        "lines": lines(name, half),
    }
    try:
        found = service_type(name) if half == "srv" else message_type(name)
    except InterfaceError as error:
        return state | {"problem": str(error)}
    halves = (found,) if isinstance(found, MessageType) else (found.request, found.response)
    titles = ("Fields",) if half == "msg" else ("Request", "Response")
    parts = [_part(title, each) for title, each in zip(titles, halves, strict=True)]
    said = {"md5": found.md5, "built": found.built, "text": state["text"] or found.text, "parts": parts}
    return state | said | {"warning": _warning(found, half, file)}


def lines(name: str, half: Half) -> list[State]:
    """Return the lines to copy: for a terminal, and for Python."""
    package, _, short = name.partition("/")
    tool = TOOLS[half]
    return [
        {"label": "fields, in a terminal", "text": f"{tool} show {name}"},
        {"label": "MD5, in a terminal", "text": f"{tool} md5 {name}"},
        {"label": "import, in Python", "text": f"from {package}.{half} import {short}"},
    ]


def _file(name: str, half: Half) -> Path | None:
    try:
        return definition_file(name, half)
    except InterfaceError:
        return None  # not the name of a type at all


def _warning(found: ServiceType | MessageType, half: Half, file: Path | None) -> str:
    if not found.built:
        return UNBUILT
    if file is None:
        return NO_FILE
    try:
        return CHANGED if type_in_file(found.name, half).md5 != found.md5 else ""
    except InterfaceError as error:
        return f"{CHANGED} As it is now, it cannot be built: {error}"


def _part(title: str, message: MessageType) -> State:
    constants = [
        {"name": each.name, "type": each.type, "value": str(each.value)} for each in message.constants
    ]
    return {"title": title, "help": message.help, "fields": _tree(message.fields), "constants": constants}


def _tree(fields: Sequence[Field]) -> list[State]:
    return [_leaf(each) for each in fields]


def _leaf(field: Field) -> State:
    """Return a field; what it is made of, if it is a message, a time, or an array of such, in `fields`."""
    inner = field.item if field.kind is Kind.ARRAY and field.item else field
    return {"name": field.name, "type": field.type, "help": field.help, "fields": _tree(inner.fields)}
