"""A type as its file says it now, beside what was built from it before."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import BrokenDefinition, UnknownType
from course_pkg.interfaces import (
    Half,
    list_message_types,
    list_service_types,
    message_type,
    service_type,
    type_in_file,
)
from tests.interfaces.conftest import build, package


@pytest.fixture
def made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package that is built, on both paths."""
    root = package(tmp_path, "filed_pkg", Ask_srv="int8 x\n---\n", Say_msg="int8 y\n")
    build(root, tmp_path / "python")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path), prepend=":")
    monkeypatch.syspath_prepend(str(tmp_path / "python"))
    return root


def test_the_file_counts_and_not_what_was_built(made: Path) -> None:
    """After an edit the two differ, until somebody builds."""
    assert type_in_file("filed_pkg/Ask", "srv").md5 == service_type("filed_pkg/Ask").md5
    (made / "srv" / "Ask.srv").write_text("int16 x\n---\n")
    now = type_in_file("filed_pkg/Ask", "srv")
    assert now.md5 != service_type("filed_pkg/Ask").md5
    assert not now.built


def test_errors_name_the_file(made: Path) -> None:
    """A broken text is told with file and line, and a file that is gone as a type that is not there."""
    file = made / "msg" / "Say.msg"
    file.write_text("int8\n")
    with pytest.raises(BrokenDefinition, match=r"Say\.msg, line 1"):
        type_in_file("filed_pkg/Say", "msg")
    file.unlink()
    with pytest.raises(UnknownType):
        type_in_file("filed_pkg/Say", "msg")
    assert message_type("filed_pkg/Say").built


@pytest.mark.parametrize("half", ["srv", "msg"])
def test_all_files_of_this_machine_are_what_was_built_from_them(half: Half) -> None:
    """Reading the file and importing the class give one MD5, for every type of the distribution."""
    names = list_service_types("std_srvs") if half == "srv" else list_message_types("geometry_msgs")
    built = service_type if half == "srv" else message_type
    assert names
    for name in names:
        assert type_in_file(name, half).md5 == built(name).md5
