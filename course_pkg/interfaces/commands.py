"""The commands that call a service with given values: a line for the shell, lines of Python."""

from __future__ import annotations

import json
import math
import shlex
from collections.abc import Iterator, Mapping
from typing import Any

import yaml

from course_pkg.interfaces.fields import Field, Kind, Value
from course_pkg.interfaces.types import ServiceType

_WIDTH = 88


def rosservice_line(service: str, kind: ServiceType, values: Mapping[str, Value]) -> str:
    """Return the `rosservice call` line for bash that calls `service` with these values.

    Scalars stand one by one, as one would type them; as soon as a field is a message, an array,
    a time or a duration, the whole request is one YAML dict. Raises FieldError.
    """
    plain = kind.request.check(values)
    fields = kind.request.fields
    if all(field.kind.is_scalar for field in fields):
        arguments = [_argument(field, plain[field.name]) for field in fields]
    else:
        arguments = [_yaml_dict(fields, plain)]
    # Behind --, rosservice's option parser takes -1.0 for what it is.
    options = ["--"] if any(each.startswith("-") for each in arguments) else []
    return " ".join(["rosservice", "call", shlex.quote(service), *options, *map(shlex.quote, arguments)])


def rospy_line(service: str, kind: ServiceType, values: Mapping[str, Value]) -> str:
    """Return the lines of Python that call `service` with these values, in a node or a notebook.

    A type that is not built comes from its text. Raises FieldError.
    """
    plain = kind.request.check(values)
    writer = _Python(kind)
    arguments = [f"{each.name}={writer.value(each, plain[each.name])}" for each in kind.request.fields]
    call = f"response = call({', '.join(arguments)})"
    if len(call) > _WIDTH:
        call = "\n".join(["response = call(", *(f"    {each}," for each in arguments), ")"])
    proxy = f"call = rospy.ServiceProxy({_python_text(service)}, {kind.name.partition('/')[2]})"
    return "\n".join([*writer.definitions(), "", proxy, call])


def _argument(field: Field, value: Value) -> str:
    """Return a scalar as an argument of its own; rosservice reads an empty one as an empty string."""
    return "" if value == "" else _yaml(field, value)


def _yaml(field: Field, value: Value) -> str:
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        return f"[{', '.join(_yaml(field.item, each) for each in value)}]"
    if field.kind is Kind.MESSAGE or field.fields:
        return _yaml_dict(field.fields, value)
    if field.kind is Kind.FLOAT:
        return _yaml_float(value)
    if field.kind is Kind.BOOL:
        return "true" if value else "false"
    return _yaml_text(value) if field.kind is Kind.STRING else str(value)


def _yaml_dict(fields: tuple[Field, ...], values: Mapping[str, Value]) -> str:
    return f"{{{', '.join(f'{_yaml_text(each.name)}: {_yaml(each, values[each.name])}' for each in fields)}}}"


def _yaml_float(number: float) -> str:
    if math.isnan(number):
        return ".nan"
    text = repr(number).replace("inf", ".inf")
    # YAML 1.1 takes 1e+20 for a string and 1.0e+20 for a number.
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def _yaml_text(text: str) -> str:
    """Return a string so that YAML reads it as that string, whatever it looks like."""
    if text.isprintable() and ":=" not in text and _is_plain(text):
        return text
    quoted: str = yaml.safe_dump(text, default_style='"', allow_unicode=True, width=math.inf)
    # The tools of ROS take an argument with := for a remapping and drop it.
    return quoted.rstrip("\n").replace(":=", r":\x3D")


def _is_plain(text: str) -> bool:
    try:
        return bool(
            yaml.safe_load(text) == text
            and yaml.safe_load(f"[{text}, {{{text}: {text}}}]") == [text, {text: text}]
        )
    except (yaml.YAMLError, ValueError):
        # A ValueError for what looks like a date, and is none.
        return False


class _Python:
    """Writes values of one service's request, and keeps the messages that they are made of."""

    def __init__(self, kind: ServiceType) -> None:
        self._kind = kind
        self._messages: dict[str, Any] = {}
        names = sorted({each.type for each in _messages(kind.request.fields)})
        taken = ["rospy", "call", "response", kind.name.partition("/")[2]]
        shorts = taken + [name.partition("/")[2] for name in names]
        self._clashing = {name for name in names if shorts.count(name.partition("/")[2]) > 1}

    def definitions(self) -> list[str]:
        """Return the lines that define what the values and the call use."""
        package, _, short = self._kind.name.partition("/")
        lines = {"import rospy": "", **dict.fromkeys(self._imports(), "")}
        made = [f'{each.partition("/")[2]} = message_type("{each}").cls' for each in self._unbuilt()]
        if self._kind.built:
            return [*lines, f"from {package}.srv import {short}"]
        tools = ", ".join(["compile_service", *(["message_type"] if made else [])])
        definition = f'{short} = compile_service("{self._kind.name}", {_python_block(self._kind.text)}).cls'
        return [*lines, f"from course_pkg.interfaces import {tools}", "", *made, definition]

    def value(self, field: Field, value: Value) -> str:
        """Return the expression for a value."""
        if field.kind is Kind.ARRAY:
            assert field.item is not None
            items = ", ".join(self.value(field.item, each) for each in value)
            return f"bytes([{items}])" if field.is_bytes else f"[{items}]"
        if field.kind in (Kind.TIME, Kind.DURATION):
            return f"rospy.{field.kind.value.title()}({value['secs']}, {value['nsecs']})"
        if field.kind is Kind.MESSAGE:
            self._messages[field.type] = field.cls
            parts = ", ".join(f"{each.name}={self.value(each, value[each.name])}" for each in field.fields)
            return f"{self._reference(field.type)}({parts})"
        if field.kind is Kind.FLOAT and not math.isfinite(value):
            return f'float("{value!r}")'
        return _python_text(value) if field.kind is Kind.STRING else repr(value)

    def _reference(self, name: str) -> str:
        package, _, short = name.partition("/")
        return f"{package}.msg.{short}" if name in self._clashing and self._is_built(name) else short

    def _imports(self) -> Iterator[str]:
        for name in sorted(self._messages):
            package, _, short = name.partition("/")
            if self._is_built(name):
                yield (
                    f"import {package}.msg"
                    if name in self._clashing
                    else f"from {package}.msg import {short}"
                )

    def _unbuilt(self) -> list[str]:
        return [name for name in sorted(self._messages) if not self._is_built(name)]

    def _is_built(self, name: str) -> bool:
        return not hasattr(self._messages[name], "_dependencies")


def _messages(fields: tuple[Field, ...]) -> Iterator[Field]:
    """Yield every field and element in a message that is a message itself."""
    for field in fields:
        inner = field.item or field
        if inner.kind is Kind.MESSAGE:
            yield inner
            yield from _messages(inner.fields)


def _python_text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False) if text.isprintable() else repr(text)


def _python_block(text: str) -> str:
    if '"""' in text or "\\" in text or text.endswith('"'):
        return repr(text)
    return f'"""{text}"""'
