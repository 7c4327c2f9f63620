"""The state of a type browser: all types on this machine, and the open type.

This module does not need a ROS graph.
"""

from __future__ import annotations

import threading
from collections import defaultdict
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypedDict

from course_pkg.errors import InterfaceError
from course_pkg.types import (
    DefinitionKind,
    Field,
    Kind,
    MessageType,
    ServiceType,
    definition_file,
    list_message_types,
    list_service_types,
    message_type,
    read_definition,
    service_type,
    type_in_file,
)

if TYPE_CHECKING:
    from course_pkg.ros import Snapshot

# A catalogue contains the names of all service types, and the names of all message types.
Catalogue = tuple[tuple[str, ...], tuple[str, ...]]
TOOLS = {"srv": "rossrv", "msg": "rosmsg"}
CHANGED = (
    "The file has changed since the last build. The panel shows the type of the last build, because programs "
    "still use this type. Build the type again with catkin_make, and restart the kernel."
)
UNBUILT = (
    "This type is not built yet: ROS tools can show the type, but Python cannot import it. Run "
    "catkin_make, and source the workspace."
)
NO_FILE = "The file of this type is not on ROS_PACKAGE_PATH. Therefore, the panel shows the built type."


class FieldNode(TypedDict):
    """A field.

    If the field is a message or a time, `fields` contains the nested fields. For an array of messages or
    times, `fields` contains the nested fields of one element.
    """

    name: str
    type: str
    help: str
    fields: list[FieldNode]


class Part(TypedDict):
    """A request, a response or a message."""

    title: str
    help: str
    fields: list[FieldNode]
    constants: list[dict[str, str]]


class TypeState(TypedDict):
    """The data of one type for the page.

    `problem` is the reason why the type cannot be read, and `warning` is a note for the reader.

    `file` and `text` (the path and the content of the file) are set even if the type cannot be read. `lines`
    contains commands and Python code that the reader can copy.
    """

    name: str
    half: DefinitionKind
    problem: str
    warning: str
    parts: list[Part]
    md5: str
    built: bool
    file: str
    text: str
    lines: list[dict[str, str]]


class PackageTypes(TypedDict):
    """A package with the short names of its service and message types."""

    name: str
    srv: list[str]
    msg: list[str]


# A service or a topic that uses a type. It contains the name of the service or topic, and the nodes in each
# role.
Use = dict[str, str | list[str]]
Offers = dict[DefinitionKind, dict[str, list[Use]]]


def catalogue() -> Catalogue:
    """Return the names of all service and message types on ROS_PACKAGE_PATH."""
    return tuple(list_service_types()), tuple(list_message_types())


def described(name: str, half: DefinitionKind) -> TypeState:
    """Return the data of the type `name` for the page."""
    file = _file(name, half)
    state: TypeState = {
        "name": name,
        "half": half,
        "problem": "",
        "warning": "",
        "parts": [],
        "md5": "",
        "built": True,
        "file": str(file or ""),
        "text": read_definition(file) if file else "",
        "lines": lines(name, half),
    }
    try:
        found = service_type(name) if half == "srv" else message_type(name)
    except InterfaceError as error:
        return {**state, "problem": str(error)}
    halves = (found,) if isinstance(found, MessageType) else (found.request, found.response)
    titles = ("Fields",) if half == "msg" else ("Request", "Response")
    return {
        **state,
        "md5": found.md5,
        "built": found.built,
        "text": state["text"] or found.text,
        "parts": [_part(title, each) for title, each in zip(titles, halves, strict=True)],
        "warning": _warning(found, half, file),
    }


def lines(name: str, half: DefinitionKind) -> list[dict[str, str]]:
    """Return the terminal commands and the lines of Python that the reader can copy."""
    package, _, short = name.partition("/")
    tool = TOOLS[half]
    return [
        {"label": "fields, in a terminal", "text": f"{tool} show {name}"},
        {"label": "MD5, in a terminal", "text": f"{tool} md5 {name}"},
        {"label": "import, in Python", "text": f"from {package}.{half} import {short}"},
    ]


def packages(known: Catalogue) -> list[PackageTypes]:
    """Return the packages that define types, sorted by name."""
    found: dict[str, PackageTypes] = {}
    for half, names in zip(("srv", "msg"), known, strict=True):
        for name in names:
            package, _, short = name.partition("/")
            types = found.setdefault(package, {"name": package, "srv": [], "msg": []})
            types["srv" if half == "srv" else "msg"].append(short)
    return [found[package] for package in sorted(found)]


def offers(snapshot: Snapshot) -> Offers:
    """Return the services of each service type, and the topics of each message type."""
    services: dict[str, list[Use]] = defaultdict(list)
    topics: dict[str, list[Use]] = defaultdict(list)
    for service in snapshot.services:
        services[service.type].append({"name": service.name, "served by": [service.node]})
    for topic in snapshot.topics:
        published, subscribed = list(topic.publishers), list(topic.subscribers)
        topics[topic.type].append(
            {"name": topic.name, "published by": published, "subscribed by": subscribed}
        )
    return {"srv": {k: v for k, v in services.items() if k}, "msg": {k: v for k, v in topics.items() if k}}


class TypeModel:
    """Lists all types, shows one type, and lists the services or topics of this type.

    The model calls the function `changed` with the keyword arguments `packages` (the types of each package),
    `described` (the open type), and `offers` (the services and topics of each type on the graph).
    """

    def __init__(
        self,
        changed: Callable[..., None],
        *,
        describe: Callable[[str, DefinitionKind], TypeState] = described,
        turn: threading.RLock | None = None,
    ) -> None:
        self._changed = changed
        self._describe = describe
        self._turn = turn or threading.RLock()
        self._known: Catalogue = ((), ())
        self._open: tuple[str, DefinitionKind] | None = None
        self._described: TypeState | None = None

    def update(self, known: Catalogue) -> None:
        """Store the names of all types. Read the open type again, because its file may have changed."""
        with self._turn:
            if known != self._known:
                self._known = known
                self._changed(packages=packages(known))
            self._show()

    def open(self, name: str, half: DefinitionKind | None = None) -> None:
        """Show a type.

        `half` is the kind of the type, "srv" or "msg". If `half` is None, a service type has priority over a
        message type with the same name.
        """
        with self._turn:
            self._open = (name, half or self._half(name))
            self._show()

    @property
    def file(self) -> str:
        """The file path of the open type, or "" if no type is open or the type has no file."""
        return self._described["file"] if self._described else ""

    def see(self, snapshot: Snapshot) -> None:
        """Report the services and topics of each type in this snapshot of the graph."""
        with self._turn:
            self._changed(offers=offers(snapshot))

    def _half(self, name: str) -> DefinitionKind:
        services, messages = self._known
        return "msg" if name in messages and name not in services else "srv"

    def _show(self) -> None:
        if self._open is None:
            return
        now = self._describe(*self._open)
        if now != self._described:
            self._described = now
            self._changed(described=now)


def _file(name: str, half: DefinitionKind) -> Path | None:
    try:
        return definition_file(name, half)
    except InterfaceError:
        return None  # `name` is not a valid name of a type.


def _warning(found: ServiceType | MessageType, half: DefinitionKind, file: Path | None) -> str:
    if not found.built:
        return UNBUILT
    if file is None:
        return NO_FILE
    try:
        return CHANGED if type_in_file(found.name, half).md5 != found.md5 else ""
    except InterfaceError as error:
        return f"{CHANGED} The changed file cannot be built: {error}"


def _part(title: str, message: MessageType) -> Part:
    constants = [
        {"name": each.name, "type": each.type, "value": str(each.value)} for each in message.constants
    ]
    return {"title": title, "help": message.help, "fields": _tree(message.fields), "constants": constants}


def _tree(fields: Sequence[Field]) -> list[FieldNode]:
    return [_node(each) for each in fields]


def _node(field: Field) -> FieldNode:
    inner = field.item if field.kind is Kind.ARRAY and field.item else field
    return {"name": field.name, "type": field.type, "help": field.help, "fields": _tree(inner.fields)}
