"""Tests of the conversion of values to strings, messages, bytes and commands, and back."""

from __future__ import annotations

import ast
import random
import shlex
from collections.abc import Iterator
from io import BytesIO
from typing import Any

import genpy
import pytest
import rosservice

from course_pkg.types import Plain, ServiceType, compile_service, rospy_line, rosservice_line
from tests.types.random_values import service, values

TYPES = 30
VALUES = 5
SEEDS = range(4)  # Each seed gives 30 types, with 5 values for each request and response.


def drawn(seed: int) -> Iterator[tuple[ServiceType, random.Random]]:
    """Yield random service types."""
    chance = random.Random(seed)  # noqa: S311 - the values must be repeatable
    for index in range(TYPES):
        yield compile_service(f"course_pkg/Drawn{index}", service(chance)), chance


def wire(message: genpy.Message) -> bytes:
    """Return the bytes of a message."""
    buffer = BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def sent(message: genpy.Message) -> genpy.Message:
    """Encode the message to bytes, and return the message that is decoded from these bytes."""
    return type(message)().deserialize(wire(message))


@pytest.mark.parametrize("seed", SEEDS)
def test_text_and_wire_give_every_value_back(seed: int) -> None:
    """A value does not change if it is formatted and parsed, or encoded and decoded."""
    for kind, chance in drawn(seed):
        for half in (kind.request, kind.response):
            for _ in range(VALUES):
                plain = half.check(values(chance, half))
                assert repr(half.parse(half.format(plain))) == repr(plain)
                assert repr(half.to_values(sent(half.to_message(plain)))) == repr(plain)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_shell_line_makes_the_same_request(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The command rosservice creates the original request from the shell command."""
    for kind, chance in drawn(seed):
        for _ in range(2):
            plain = kind.request.check(values(chance, kind.request))
            line = rosservice_line("/x", kind, plain)
            arrived = kind.request.to_values(sent(read_by_rosservice(line, kind, monkeypatch)))
            # The test does not compare the bytes, because NaN from YAML has a different sign bit.
            assert repr(arrived) == repr(plain), line


def read_by_rosservice(line: str, kind: ServiceType, monkeypatch: pytest.MonkeyPatch) -> genpy.Message:
    """Return the request that rosservice makes from a shell command."""
    given: list[list[Plain]] = []

    def catch(_name: str, arguments: list[Plain], **_options: object) -> None:
        given.append(arguments)

    monkeypatch.setattr(rosservice, "get_service_class_by_name", lambda _name: kind.cls)
    monkeypatch.setattr(rosservice, "_rosservice_call", catch)
    rosservice.rosservicemain(shlex.split(line))
    request = kind.cls._request_class()
    genpy.message.fill_message_args(request, given[0])
    return request


@pytest.mark.parametrize("seed", SEEDS)
def test_the_python_lines_make_the_same_request(seed: int) -> None:
    """The request that the Python code creates has the same bytes as the original request."""
    for kind, chance in drawn(seed):
        plain = kind.request.check(values(chance, kind.request))
        lines = rospy_line("/x", kind, plain)
        assert wire(request_of(lines)) == wire(kind.request.to_message(plain)), lines


def request_of(lines: str) -> genpy.Message:
    """Run the Python code without its last line, and return the request that the last line would send."""
    *before, last = ast.parse(lines).body
    assert isinstance(last, ast.Assign)
    assert isinstance(last.value, ast.Call)
    arguments = ast.Expression(ast.Call(ast.Name("dict", ast.Load()), [], last.value.keywords))
    names: dict[str, Any] = {}
    exec(compile(ast.Module(before, []), "lines", "exec"), names)  # noqa: S102 - the test asserts that they run
    keywords = eval(compile(ast.fix_missing_locations(arguments), "call", "eval"), names)  # noqa: S307 - our code
    return names["call"].request_class(**keywords)
