"""Plain values as Python expressions, with the imports that these need."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator
from typing import Any

from course_pkg.interfaces.fields import Field, Kind, Value


class Python:
    """Writes plain values as Python, and keeps the messages that they are made of.

    `taken` are the names that the lines around use for something else.
    """

    def __init__(self, fields: tuple[Field, ...], taken: Iterable[str]) -> None:
        self._messages: dict[str, Any] = {}
        names = sorted({each.type for each in _messages(fields)})
        shorts = [*taken, *(_parted(name)[2] for name in names)]
        self._clashing = {name for name in names if shorts.count(_parted(name)[2]) > 1}

    def imports(self) -> list[str]:
        """Return the lines that import the messages that were written, where they are built."""
        return [
            f"import {package}.msg" if name in self._clashing else f"from {package}.msg import {short}"
            for name, package, short in map(_parted, self._written(built=True))
        ]

    def made(self) -> list[str]:
        """Return the lines that make the messages that were written and are not built."""
        return [f'{_parted(name)[2]} = message_type("{name}").cls' for name in self._written(built=False)]

    def reference(self, name: str, cls: Any) -> str:  # noqa: ANN401 - a generated class
        """Return how a message type is called in the lines."""
        self._messages[name] = cls
        _, package, short = _parted(name)
        return f"{package}.msg.{short}" if name in self._clashing and _is_built(cls) else short

    def value(self, field: Field, value: Value) -> str:
        """Return the expression for a value."""
        if field.kind is Kind.ARRAY:
            assert field.item is not None
            items = ", ".join(self.value(field.item, each) for each in value)
            return f"bytes([{items}])" if field.is_bytes else f"[{items}]"
        if field.kind in (Kind.TIME, Kind.DURATION):
            return f"rospy.{field.kind.value.title()}({value['secs']}, {value['nsecs']})"
        if field.kind is Kind.MESSAGE:
            parts = ", ".join(f"{each.name}={self.value(each, value[each.name])}" for each in field.fields)
            return f"{self.reference(field.type, field.cls)}({parts})"
        if field.kind is Kind.FLOAT and not math.isfinite(value):
            return f'float("{value!r}")'
        return python_text(value) if field.kind is Kind.STRING else repr(value)

    def _written(self, *, built: bool) -> list[str]:
        return sorted(name for name, cls in self._messages.items() if _is_built(cls) == built)


def _is_built(cls: Any) -> bool:  # noqa: ANN401 - a generated class
    return not hasattr(cls, "_dependencies")


def _parted(name: str) -> tuple[str, str, str]:
    package, _, short = name.partition("/")
    return name, package, short


def _messages(fields: tuple[Field, ...]) -> Iterator[Field]:
    """Yield every field and element in a message that is a message itself."""
    for field in fields:
        inner = field.item or field
        if inner.kind is Kind.MESSAGE:
            yield inner
            yield from _messages(inner.fields)


def python_text(text: str) -> str:
    """Return a string as Python writes it."""
    return json.dumps(text, ensure_ascii=False) if text.isprintable() else repr(text)


def python_block(text: str) -> str:
    """Return a text of several lines as Python writes it."""
    if '"""' in text or "\\" in text or text.endswith('"'):
        return repr(text)
    return f'"""{text}"""'
