"""Types are found where ROS looks for them, and what is not there gets advice."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import UnknownType
from course_pkg.interfaces import list_message_types, list_service_types, message_type, service_type
from tests.interfaces.conftest import package


def test_all_types_on_the_path_are_listed(packages: Path) -> None:
    """Built and unbuilt types of all packages, in order; one package's on request; none of an unknown one."""
    assert packages.is_dir()
    everything = list_service_types()
    assert everything == sorted(everything)
    assert {"odd_pkg/Scalars", "raw_pkg/Pack", "std_srvs/SetBool", "course_pkg/geometry"} <= set(everything)
    assert list_service_types("odd_pkg") == ["odd_pkg/Everything", "odd_pkg/Scalars"]
    assert list_message_types("raw_pkg") == ["raw_pkg/Crate"]
    assert list_service_types("no_such_pkg") == []


def test_a_type_that_is_new_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A definition that is written after the first look is there at the second."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path), prepend=":")
    with pytest.raises(UnknownType):
        service_type("late_pkg/Late")
    package(tmp_path, "late_pkg", Late_srv="int8 x\n---\n")
    assert service_type("late_pkg/Late").request.fields[0].name == "x"


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("course_pkg/Geometry", "upper and lower case differ; did you mean course_pkg/geometry?"),
        ("std_srvs/setbool", "did you mean std_srvs/SetBool?"),
        ("std_srv/SetBool", "did you mean std_srvs/SetBool?"),
        ("std_srvs/Nothing", "std_srvs has Empty, SetBool, Trigger"),
        ("nowhere_pkg/Thing", "no package nowhere_pkg is on ROS_PACKAGE_PATH"),
        ("std_msgs/Thing", "the package std_msgs has no srv/Thing.srv"),
        ("SetBool", "write it as package/Type"),
    ],
)
def test_an_unknown_service_type_gets_advice(name: str, words: str) -> None:
    """The error holds the name as given and says what may have been meant or done."""
    with pytest.raises(UnknownType) as caught:
        service_type(name)
    assert words in str(caught.value)
    assert caught.value.name == name


def test_an_unknown_message_type_gets_advice_from_messages() -> None:
    """A message is looked for among messages."""
    with pytest.raises(UnknownType, match="did you mean geometry_msgs/Point"):
        message_type("geometry_msgs/point")


def test_header_is_short_for_that_of_std_msgs() -> None:
    """`Header` alone is a type, as it is in a definition."""
    assert message_type("Header") == message_type("std_msgs/Header")
