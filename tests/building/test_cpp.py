"""Whether C++ can be built here is said before anybody tries."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.building import cpp, missing_for_cpp


def test_nothing_is_missing_where_the_course_was_set_up() -> None:
    """The packages of the course bring a compiler and roscpp."""
    assert missing_for_cpp() == ""


def test_a_missing_compiler_is_named_with_what_to_type(monkeypatch: pytest.MonkeyPatch) -> None:
    """The compiler is the one that CMake would take; without it the words say how to get one."""
    monkeypatch.setenv("CXX", "/nowhere/c++")
    words = missing_for_cpp()
    assert words.startswith("There is no C++ compiler here (/nowhere/c++).")
    assert "apt-get install --no-install-recommends g++" in words
    assert "conda install compilers" in words


def test_missing_headers_are_named_with_what_to_type(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A compiler alone does not build a node."""
    monkeypatch.setattr(cpp, "prefixes", lambda: [tmp_path])
    assert "apt-get install --no-install-recommends libroscpp-dev" in missing_for_cpp()


def test_each_prefix_is_searched_for_headers_and_libraries(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Workspaces come first, then conda's environment; the compiler knows the system's folders by itself."""
    monkeypatch.setenv("CMAKE_PREFIX_PATH", f"{tmp_path}/devel")
    monkeypatch.setenv("CONDA_PREFIX", f"{tmp_path}/conda")
    command = cpp.compile_command("in.cpp", "out")
    assert [word for word in command if word.startswith("-I")] == [
        f"-I{tmp_path}/devel/include",
        f"-I{tmp_path}/conda/include",
    ]
    assert "-I/usr/include" not in command
