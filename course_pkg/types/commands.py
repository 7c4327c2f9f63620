"""The commands that call a service or publish a message: a line for the shell, or lines of Python."""

from __future__ import annotations

import json
import math
import shlex
from collections.abc import Iterable, Iterator, Mapping

import yaml

from course_pkg.types.fields import Field, Kind, MessageClass, Plain, elements, members
from course_pkg.types.types import MessageType, ServiceType

_WIDTH = 88


def rosservice_line(service: str, kind: ServiceType, values: Mapping[str, Plain]) -> str:
    """Return the `rosservice call` line for bash that calls the service `service` with these values.

    If all fields are scalars, each value is one argument. If a field is a message, an array, a time or a
    duration, the whole request is one YAML dict. Raises FieldError if a value is not valid.
    """
    plain = kind.request.check(values)
    # rosservice reads an empty argument as an empty string, so two pairs of quotes are not necessary.
    given = ["" if each == '""' else each for each in _arguments(kind.request.fields, plain)]
    return _shell_line("rosservice", "call", service, *_end_of_options(given), *given)


def rospy_line(service: str, kind: ServiceType, values: Mapping[str, Plain]) -> str:
    """Return the lines of Python that call the service `service` with these values, in a node or a notebook.

    If the type is not built, the lines generate the type from its definition. Raises FieldError if a value is
    not valid.
    """
    plain = kind.request.check(values)
    short = kind.name.partition("/")[2]
    writer = _PythonWriter(kind.request.fields, ["rospy", "call", "response", short])
    keywords = writer.keywords(kind.request.fields, plain)
    proxy = f"call = rospy.ServiceProxy({_python_string(service)}, {short})"
    return "\n".join(
        [*_definitions(kind, "srv", writer), "", proxy, _call_lines("response = call", keywords)]
    )


def rostopic_line(
    topic: str,
    kind: MessageType,
    values: Mapping[str, Plain],
    *,
    rate: float | None = None,
    latch: bool = False,
) -> str:
    """Return the `rostopic pub` line for bash that publishes these values, once or at the rate `rate` (Hz).

    If `latch` is true and `rate` is None, rostopic runs until Ctrl-C and sends the message to later
    subscribers. Raises FieldError if a value is not valid.
    """
    given = _arguments(kind.fields, kind.check(values))
    once = [] if latch else ["--once"]
    repeated = ["-r", f"{rate:g}", *(["--latch"] if latch else [])] if rate else once
    return _shell_line("rostopic", "pub", *repeated, topic, kind.name, *_end_of_options(given), *given)


def publisher_lines(
    topic: str,
    kind: MessageType,
    values: Mapping[str, Plain],
    *,
    rate: float | None = None,
    latch: bool = False,
    queue_size: int = 10,
) -> str:
    """Return the lines of Python that publish these values in a node, once or at the rate `rate` (Hz).

    If the type is not built, the lines generate the type from its definition. Raises FieldError if a value is
    not valid.
    """
    plain = kind.check(values)
    short = kind.name.partition("/")[2]
    writer = _PythonWriter(kind.fields, ["rospy", "publisher", "rate", short])
    keywords = writer.keywords(kind.fields, plain)
    options = f"queue_size={queue_size}" + (", latch=True" if latch else "")
    publisher = f"publisher = rospy.Publisher({_python_string(topic)}, {short}, {options})"
    publish = _call_lines("publisher.publish", keywords)
    if rate:
        indented = publish.replace("\n", "\n    ")
        loop = f"while not rospy.is_shutdown():\n    {indented}\n    rate.sleep()"
        publish = f"rate = rospy.Rate({rate:g})\n{loop}"
    return "\n".join([*_definitions(kind, "msg", writer), "", publisher, publish])


def _shell_line(*words: str) -> str:
    return " ".join(map(shlex.quote, words))


def _call_lines(called: str, keywords: list[str]) -> str:
    line = f"{called}({', '.join(keywords)})"
    if len(line) <= _WIDTH:
        return line
    return "\n".join([f"{called}(", *(f"    {each}," for each in keywords), ")"])


def _definitions(kind: ServiceType | MessageType, folder: str, writer: _PythonWriter) -> list[str]:
    """Return the lines that import or generate the names that the following lines use."""
    package, _, short = kind.name.partition("/")
    lines = ["import rospy", *writer.imports()]
    if kind.built:
        return [*lines, f"from {package}.{folder} import {short}"]
    compiler, generated = {"srv": "compile_service", "msg": "compile_message"}[folder], writer.generated()
    tools = ", ".join([compiler, *(["message_type"] if generated else [])])
    definition = f'{short} = {compiler}("{kind.name}", {_python_block(kind.text)}).cls'
    return [*lines, f"from course_pkg.types import {tools}", "", *generated, definition]


class _PythonWriter:
    """Writes values as Python expressions, and stores the message classes that these expressions need.

    `taken` contains the names that the program already uses for other objects.
    """

    def __init__(self, fields: tuple[Field, ...], taken: Iterable[str]) -> None:
        self._messages: dict[str, MessageClass | None] = {}
        names = sorted({each.type for each in _nested_messages(fields)})
        shorts = [*taken, *(_split_name(name)[2] for name in names)]
        self._clashing = {name for name in names if shorts.count(_split_name(name)[2]) > 1}

    def imports(self) -> list[str]:
        """Return the lines that import the built message classes."""
        return [
            f"import {package}.msg" if name in self._clashing else f"from {package}.msg import {short}"
            for name, package, short in map(_split_name, self._written(built=True))
        ]

    def generated(self) -> list[str]:
        """Return the lines that generate the message classes that are not built."""
        return [f'{_split_name(name)[2]} = message_type("{name}").cls' for name in self._written(built=False)]

    def keywords(self, fields: tuple[Field, ...], values: Mapping[str, Plain]) -> list[str]:
        """Return each field as a keyword argument."""
        return [f"{each.name}={self._value(each, values[each.name])}" for each in fields]

    def _value(self, field: Field, value: Plain) -> str:
        if field.kind is Kind.ARRAY:
            assert field.item is not None
            items = ", ".join(self._value(field.item, each) for each in elements(value))
            return f"bytes([{items}])" if field.is_bytes else f"[{items}]"
        if field.kind in (Kind.TIME, Kind.DURATION):
            parts = members(value)
            return f"rospy.{field.kind.value.title()}({parts['secs']}, {parts['nsecs']})"
        if field.kind is Kind.MESSAGE:
            return f"{self._reference(field)}({', '.join(self.keywords(field.fields, members(value)))})"
        if isinstance(value, float) and not math.isfinite(value):
            return f'float("{value!r}")'
        return _python_string(value) if isinstance(value, str) else repr(value)

    def _reference(self, field: Field) -> str:
        """Return the expression for the class of a message."""
        self._messages[field.type] = field.cls
        name, package, short = _split_name(field.type)
        return f"{package}.msg.{short}" if name in self._clashing and _is_built(field.cls) else short

    def _written(self, *, built: bool) -> list[str]:
        return sorted(name for name, cls in self._messages.items() if _is_built(cls) == built)


def _is_built(cls: MessageClass | None) -> bool:
    return not hasattr(cls, "_dependencies")


def _split_name(name: str) -> tuple[str, str, str]:
    """Return the full name of a type, its package, and its short name."""
    package, _, short = name.partition("/")
    return name, package, short


def _nested_messages(fields: tuple[Field, ...]) -> Iterator[Field]:
    """Yield every field and array element that is a message, at any depth."""
    for field in fields:
        inner = field.item or field
        if inner.kind is Kind.MESSAGE:
            yield inner
            yield from _nested_messages(inner.fields)


def _python_string(text: str) -> str:
    """Return a string as a Python literal."""
    return json.dumps(text, ensure_ascii=False) if text.isprintable() else repr(text)


def _python_block(text: str) -> str:
    """Return a string of several lines as a Python literal."""
    if '"""' in text or "\\" in text or text.endswith('"'):
        return repr(text)
    return f'"""{text}"""'


def _arguments(fields: tuple[Field, ...], values: Mapping[str, Plain]) -> list[str]:
    """If all fields are scalars, return one argument for each field.

    If a field is not a scalar, return one YAML dict with all fields.
    """
    if all(field.kind.is_scalar for field in fields):
        return [_yaml(field, values[field.name]) for field in fields]
    return [_yaml_dict(fields, values)]


def _end_of_options(given: list[str]) -> list[str]:
    """Return ["--"] if an argument such as -1.0 looks like an option, or else []."""
    return ["--"] if any(each.startswith("-") for each in given) else []


def _yaml(field: Field, value: Plain) -> str:
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        return f"[{', '.join(_yaml(field.item, each) for each in elements(value))}]"
    if field.kind is Kind.MESSAGE or field.fields:
        return _yaml_dict(field.fields, members(value))
    if isinstance(value, float):
        return _yaml_float(value)
    if field.kind is Kind.BOOL:
        return "true" if value else "false"
    return _yaml_string(value) if isinstance(value, str) else str(value)


def _yaml_dict(fields: tuple[Field, ...], values: Mapping[str, Plain]) -> str:
    parts = (f"{_yaml_string(each.name)}: {_yaml(each, values[each.name])}" for each in fields)
    return f"{{{', '.join(parts)}}}"


def _yaml_float(number: float) -> str:
    if math.isnan(number):
        return ".nan"
    text = repr(number).replace("inf", ".inf")
    # YAML 1.1 reads 1e+20 as a string, but 1.0e+20 as a number.
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def _yaml_string(text: str) -> str:
    """Return a string as YAML text."""
    if text.isprintable() and ":=" not in text and _is_plain(text):
        return text
    quoted: str = yaml.safe_dump(text, default_style='"', allow_unicode=True, width=math.inf)
    # The tools of ROS remove an argument with :=, because they treat it as a remapping.
    return quoted.rstrip("\n").replace(":=", r":\x3D")


def _is_plain(text: str) -> bool:
    try:
        return bool(
            yaml.safe_load(text) == text
            and yaml.safe_load(f"[{text}, {{{text}: {text}}}]") == [text, {text: text}]
        )
    except (yaml.YAMLError, ValueError):
        # YAML raises ValueError for a string that looks like a date but is not a valid date.
        return False
