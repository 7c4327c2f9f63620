"""The commands that call a service or publish a message: a line for the shell, lines of Python."""

from __future__ import annotations

import shlex
from collections.abc import Mapping

from course_pkg.interfaces.fields import Value
from course_pkg.interfaces.python_line import Python, python_block, python_text
from course_pkg.interfaces.types import MessageType, ServiceType
from course_pkg.interfaces.yaml_line import arguments, options_end

_WIDTH = 88


def rosservice_line(service: str, kind: ServiceType, values: Mapping[str, Value]) -> str:
    """Return the `rosservice call` line for bash that calls `service` with these values.

    Scalars stand one by one, as one would type them; as soon as a field is a message, an array,
    a time or a duration, the whole request is one YAML dict. Raises FieldError.
    """
    plain = kind.request.check(values)
    # rosservice reads an empty argument as an empty string, and so would one type it.
    given = ["" if each == '""' else each for each in arguments(kind.request.fields, plain)]
    return _shell("rosservice", "call", service, *options_end(given), *given)


def rospy_line(service: str, kind: ServiceType, values: Mapping[str, Value]) -> str:
    """Return the lines of Python that call `service` with these values, in a node or a notebook.

    A type that is not built comes from its text. Raises FieldError.
    """
    plain = kind.request.check(values)
    short = kind.name.partition("/")[2]
    writer = Python(kind.request.fields, ["rospy", "call", "response", short])
    keywords = [f"{each.name}={writer.value(each, plain[each.name])}" for each in kind.request.fields]
    proxy = f"call = rospy.ServiceProxy({python_text(service)}, {short})"
    return "\n".join([*_definitions(kind, "srv", writer), "", proxy, _call("response = call", keywords)])


def rostopic_line(
    topic: str,
    kind: MessageType,
    values: Mapping[str, Value],
    *,
    rate: float | None = None,
    latch: bool = False,
) -> str:
    """Return the `rostopic pub` line for bash that publishes these values, once or `rate` times a second.

    With `latch` and no rate it keeps the message for whoever connects, until Ctrl-C. Raises FieldError.
    """
    given = arguments(kind.fields, kind.check(values))
    once = [] if latch else ["--once"]
    repeated = ["-r", f"{rate:g}", *(["--latch"] if latch else [])] if rate else once
    return _shell("rostopic", "pub", *repeated, topic, kind.name, *options_end(given), *given)


def publisher_lines(
    topic: str,
    kind: MessageType,
    values: Mapping[str, Value],
    *,
    rate: float | None = None,
    latch: bool = False,
    queue_size: int = 10,
) -> str:
    """Return the lines of Python that publish these values, once or `rate` times a second, in a node.

    A type that is not built comes from its text. Raises FieldError.
    """
    plain = kind.check(values)
    short = kind.name.partition("/")[2]
    writer = Python(kind.fields, ["rospy", "publisher", "rate", short])
    keywords = [f"{each.name}={writer.value(each, plain[each.name])}" for each in kind.fields]
    options = f"queue_size={queue_size}" + (", latch=True" if latch else "")
    publisher = f"publisher = rospy.Publisher({python_text(topic)}, {short}, {options})"
    publish = _call("publisher.publish", keywords)
    if rate:
        indented = publish.replace("\n", "\n    ")
        loop = f"while not rospy.is_shutdown():\n    {indented}\n    rate.sleep()"
        publish = f"rate = rospy.Rate({rate:g})\n{loop}"
    return "\n".join([*_definitions(kind, "msg", writer), "", publisher, publish])


def _shell(*words: str) -> str:
    return " ".join(map(shlex.quote, words))


def _call(called: str, keywords: list[str]) -> str:
    line = f"{called}({', '.join(keywords)})"
    if len(line) <= _WIDTH:
        return line
    return "\n".join([f"{called}(", *(f"    {each}," for each in keywords), ")"])


def _definitions(kind: ServiceType | MessageType, folder: str, writer: Python) -> list[str]:
    """Return the lines that define what the others use; a type that is not built is made from its text."""
    package, _, short = kind.name.partition("/")
    lines = ["import rospy", *writer.imports()]
    if kind.built:
        return [*lines, f"from {package}.{folder} import {short}"]
    make, made = {"srv": "compile_service", "msg": "compile_message"}[folder], writer.made()
    tools = ", ".join([make, *(["message_type"] if made else [])])
    definition = f'{short} = {make}("{kind.name}", {python_block(kind.text)}).cls'
    return [*lines, f"from course_pkg.interfaces import {tools}", "", *made, definition]
