"""The tags of a package.xml are found with their lines, whatever state it is in."""

from __future__ import annotations

import pytest

from course_pkg.building import Fault
from course_pkg.building.manifest import needed, placed, tags
from tests.building.packages import MANIFEST


def test_tags_have_lines() -> None:
    """Attributes do not hide a tag, and a comment is none."""
    text = '<?xml version="1.0"?>\n<package format="2">\n<!-- <name>old</name>\n-->\n  <name> mine </name>\n'
    assert [(tag.name, tag.line, tag.text) for tag in tags(text)] == [("package", 2, ""), ("name", 5, "mine")]


@pytest.mark.parametrize(
    ("text", "build", "run"),
    [
        (MANIFEST, {"message_generation"}, {"message_runtime"}),
        ("<package><depend>a</depend><run_depend>b</run_depend></package>", {"a"}, {"a", "b"}),
        ('<build_depend version_gte="1.0.0">a</build_depend>', {"a"}, set()),
        ("", set(), set()),
    ],
)
def test_what_a_package_needs(text: str, build: set[str], run: set[str]) -> None:
    """To be built and to run; `depend` is both, and `run_depend` is what format 1 calls it."""
    assert (needed(text, "build"), needed(text, "run")) == (build, run)


@pytest.mark.parametrize(
    ("problem", "text", "line"),
    [
        ("The version 1.0 is not three numbers.", MANIFEST, 4),
        ("package.xml has the name a, and CMakeLists.txt has b.", MANIFEST, 3),
        ("A tag is not closed.", MANIFEST.replace("</license>", ""), 7),
        ("Nobody knows.", MANIFEST, 0),
    ],
)
def test_a_fault_is_placed(problem: str, text: str, line: int) -> None:
    """The builder names the tag at best; its line is found in the text."""
    assert placed(Fault(problem, "", "my_services/package.xml"), text).line == line


def test_a_fault_of_another_file_stays_where_it_is() -> None:
    """Only a package.xml has tags."""
    fault = Fault("The version is old.", "", "my_services/CMakeLists.txt", 9)
    assert placed(fault, MANIFEST) == fault
