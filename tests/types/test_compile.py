"""A type made from the text of a definition is equal to the type that catkin built."""

from __future__ import annotations

import os
import sys
import tempfile
import threading
from io import BytesIO
from pathlib import Path

import genpy
import pytest
import std_srvs.srv

from course_pkg.errors import BrokenDefinition, UnknownType
from course_pkg.types import compile_message, compile_service, message_type, service_type
from tests.types.conftest import EVERYTHING, PART, package


def test_class_has_the_attributes_that_rospy_needs() -> None:
    """A service class has attributes for its type, MD5 sum, request class and response class."""
    cls = compile_service("course_pkg/Demo", "int8 x\n---\nint8 y\n").cls
    assert cls._type == "course_pkg/Demo"
    assert cls._request_class._type == "course_pkg/DemoRequest"
    assert issubclass(cls._response_class, genpy.Message)
    assert cls._request_class(x=3).x == 3


@pytest.mark.parametrize("name", ["course_pkg/geometry", "std_srvs/SetBool", "std_srvs/Empty"])
def test_md5_and_text_are_those_of_the_build(name: str) -> None:
    """A type that is made from text has the same text and MD5 sums as the built type."""
    built = service_type(name)
    again = compile_service(name, built.text)
    assert built.built
    assert not again.built
    assert (again.md5, again.text) == (built.md5, built.text)
    assert (again.request.md5, again.response.md5) == (built.request.md5, built.response.md5)


def test_everything_at_once_is_as_genpy_builds_it(packages: Path) -> None:
    """A type with fields of every kind has the same MD5 sum and encoding if it is made from text."""
    assert packages.is_dir()
    built, again = service_type("odd_pkg/Everything"), compile_service("odd_pkg/Everything", EVERYTHING)
    assert again == built
    values = {**built.request.default(), "parts": [{"size": 1.5, "label": "a"}], "data": [1, 2]}
    buffers = BytesIO(), BytesIO()
    for kind, buffer in zip((built, again), buffers, strict=True):
        kind.request.to_message(values).serialize(buffer)
    assert buffers[0].getvalue() == buffers[1].getvalue()
    assert type(again.request.to_message(values).parts[0]) is message_type("odd_pkg/Part").cls


def test_a_class_gives_the_same_type_as_its_name() -> None:
    """service_type() accepts an imported class, and a class that was made from text."""
    kind = service_type(std_srvs.srv.SetBool)
    assert kind == service_type("std_srvs/SetBool") == service_type(kind)
    assert service_type(compile_service("a/B", "geometry_msgs/Point p\n---\n").cls).request.fields[0].fields


def test_a_package_that_is_not_built_is_read_from_its_text(packages: Path) -> None:
    """If a type is not built, its class is made from the text of its definition."""
    assert packages.is_dir()
    kind = service_type("raw_pkg/Pack")
    assert not kind.built
    value = {"crate": {"parts": [{"size": 2.0, "label": "nut"}]}}
    assert kind.request.to_values(kind.request.to_message(value)) == value


def test_changed_text_of_a_nested_message_is_used(
    packages: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If the text of a nested message differs from the built type, the fields of the text are used."""
    package(tmp_path, "odd_pkg", Part_msg=f"{PART}int8 added\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path}:{os.environ['ROS_PACKAGE_PATH']}")
    assert packages.is_dir()
    kind = compile_service("raw_pkg/Fresh", "odd_pkg/Part part\n---\n")
    assert [each.name for each in kind.request.fields[0].fields] == ["size", "label", "added"]


def test_definitions_that_genmsg_accepts_are_accepted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The course accepts unusual names, comments and constants that genmsg accepts."""
    text = 'string from  # "quoted\\xzz"\nstring PATH=C:\\new\\\nstring in="\n----\nint8 x\n---\nint8 y\n'
    package(tmp_path, "lax_pkg", Lax_srv=text)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path), prepend=":")
    kind = service_type("lax_pkg/Lax")
    assert [field.name for field in (*kind.request.fields, *kind.response.fields)] == ["from_", "x", "y"]
    assert kind.request.fields[0].help == '"quoted\\xzz"'
    assert (kind.request.cls.PATH, kind.request.cls.in_) == ("C:\\new\\", '"')
    assert kind.request.to_message({"from_": "here"}).from_ == "here"


def test_a_circle_of_messages_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If messages contain each other, the error message lists these messages."""
    package(tmp_path, "round_pkg", A_msg="B b\n", B_msg="# back again\nA[] a\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path), prepend=":")
    with pytest.raises(BrokenDefinition, match="round_pkg/A → round_pkg/B → round_pkg/A") as caught:
        compile_service("round_pkg/C", "A a\n---\n")
    assert caught.value.line == 2


def test_error_in_a_nested_message_names_its_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The error message for a nested message contains the message's file and line."""
    package(tmp_path, "slip_pkg", Bad_msg="int8 x\nflaot32 y\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path), prepend=":")
    with pytest.raises(BrokenDefinition) as caught:
        compile_service("slip_pkg/S", "Bad bad\n---\n")
    assert caught.value.source == str(tmp_path / "slip_pkg" / "msg" / "Bad.msg")
    assert caught.value.line == 2


def test_compilation_leaves_no_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Fifty compilations add no file, no entry of sys.path, and no module."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    compile_service("course_pkg/Demo", "geometry_msgs/Point p\n---\n")
    before = set(sys.modules), list(sys.path)
    for index in range(50):
        compile_service(f"course_pkg/Demo{index}", "geometry_msgs/Point p\n---\n")
    assert (set(sys.modules), list(sys.path)) == before
    assert list(tmp_path.iterdir()) == []


def test_threads_may_compile_at_once() -> None:
    """If eight threads compile types at the same time, each thread gets the fields of its own type.

    A lock is necessary, because genpy itself is not thread-safe.
    """
    found: dict[int, list[str]] = {}

    def compile_one(index: int) -> None:
        text = "".join(f"float32 f{index}_{number}\n" for number in range(40))
        message = compile_message(f"course_pkg/T{index}", text)
        message.to_message(message.default()).serialize(BytesIO())
        found[index] = [field.name for field in message.fields]

    threads = [threading.Thread(target=compile_one, args=[index]) for index in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == {index: [f"f{index}_{number}" for number in range(40)] for index in range(8)}


@pytest.mark.parametrize("given", [3, None, object(), std_srvs.srv.SetBoolRequest])
def test_value_that_is_not_a_type_is_refused(given: object) -> None:
    """service_type() refuses a value that is no service type; message_type() refuses a service type."""
    with pytest.raises(UnknownType):
        service_type(given)
    with pytest.raises(UnknownType):
        message_type(std_srvs.srv.SetBool)


def test_half_of_a_service_type_is_explained() -> None:
    """If SetBoolRequest is given instead of SetBool, the error message explains the mistake."""
    with pytest.raises(UnknownType, match="one half of a service type; pass the whole type, SetBool"):
        service_type(std_srvs.srv.SetBoolRequest)
