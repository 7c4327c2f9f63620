"""Tests of the search for types on ROS_PACKAGE_PATH."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import BrokenDefinition, UnknownType
from course_pkg.types import (
    DefinitionKind,
    list_message_types,
    list_service_types,
    message_type,
    service_type,
    type_in_file,
)
from tests.types.conftest import build, package


def test_all_types_on_the_path_are_listed(packages: Path) -> None:
    """The lists contain the types of all packages, or of one package, in sorted order."""
    assert packages.is_dir()
    everything = list_service_types()
    assert everything == sorted(everything)
    assert {"odd_pkg/Scalars", "raw_pkg/Pack", "std_srvs/SetBool", "course_pkg/geometry"} <= set(everything)
    assert list_service_types("odd_pkg") == ["odd_pkg/Everything", "odd_pkg/Scalars"]
    assert list_message_types("raw_pkg") == ["raw_pkg/Crate"]
    assert list_service_types("no_such_pkg") == []


def test_a_type_that_is_new_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The next search finds a new definition."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path), prepend=":")
    with pytest.raises(UnknownType):
        service_type("late_pkg/Late")
    package(tmp_path, "late_pkg", Late_srv="int8 x\n---\n")
    assert service_type("late_pkg/Late").request.fields[0].name == "x"


@pytest.mark.parametrize(
    ("name", "advice"),
    [
        ("course_pkg/Geometry", "upper and lower case are different; did you mean course_pkg/geometry?"),
        ("std_srvs/setbool", "did you mean std_srvs/SetBool?"),
        ("std_srv/SetBool", "did you mean std_srvs/SetBool?"),
        ("std_srvs/Nothing", "std_srvs has Empty, SetBool, Trigger"),
        ("nowhere_pkg/Thing", "no package nowhere_pkg is on ROS_PACKAGE_PATH"),
        ("std_msgs/Thing", "the package std_msgs contains no srv/Thing.srv"),
        ("SetBool", "write it as package/Type"),
    ],
)
def test_an_unknown_service_type_gets_advice(name: str, advice: str) -> None:
    """If a type does not exist, the error message contains its name, and similar names or other advice."""
    with pytest.raises(UnknownType) as caught:
        service_type(name)
    assert advice in str(caught.value)
    assert caught.value.name == name


def test_an_unknown_message_type_gets_advice_from_messages() -> None:
    """The error message for an unknown message type suggests only message types."""
    with pytest.raises(UnknownType, match="did you mean geometry_msgs/Point"):
        message_type("geometry_msgs/point")


def test_header_is_short_for_that_of_std_msgs() -> None:
    """`Header` without a package means std_msgs/Header."""
    assert message_type("Header") == message_type("std_msgs/Header")


@pytest.fixture
def built_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Create a built package that is on ROS_PACKAGE_PATH and on sys.path."""
    root = package(tmp_path, "filed_pkg", Ask_srv="int8 x\n---\n", Say_msg="int8 y\n")
    build(root, tmp_path / "python")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path), prepend=":")
    monkeypatch.syspath_prepend(str(tmp_path / "python"))
    return root


def test_the_file_counts_and_not_the_built_type(built_package: Path) -> None:
    """If a definition file has changed, type_in_file() returns the new type, which is not built yet."""
    assert type_in_file("filed_pkg/Ask", "srv").md5 == service_type("filed_pkg/Ask").md5
    (built_package / "srv" / "Ask.srv").write_text("int16 x\n---\n")
    now = type_in_file("filed_pkg/Ask", "srv")
    assert now.md5 != service_type("filed_pkg/Ask").md5
    assert not now.built


def test_errors_name_the_file(built_package: Path) -> None:
    """The error message for an invalid definition contains the file and the line."""
    file = built_package / "msg" / "Say.msg"
    file.write_text("int8\n")
    with pytest.raises(BrokenDefinition, match=r"Say\.msg, line 1"):
        type_in_file("filed_pkg/Say", "msg")
    file.unlink()
    with pytest.raises(UnknownType):
        type_in_file("filed_pkg/Say", "msg")
    assert message_type("filed_pkg/Say").built


@pytest.mark.parametrize("kind", ["srv", "msg"])
def test_all_files_of_this_machine_are_what_was_built_from_them(kind: DefinitionKind) -> None:
    """For the types of std_srvs and geometry_msgs, the file and the built class have the same MD5 sum."""
    names = list_service_types("std_srvs") if kind == "srv" else list_message_types("geometry_msgs")
    built = service_type if kind == "srv" else message_type
    assert names
    for name in names:
        assert type_in_file(name, kind).md5 == built(name).md5
