"""Describes a fault in a package, and finds the line of a fault, even in an invalid package.xml."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_TAG = re.compile(r"<(?P<name>[A-Za-z_]\w*)(?:\s[^<>]*)?>(?P<text>[^<]*)")


@dataclass(frozen=True)
class Fault:
    """A fault in a package, its location, and its remedy.

    `problem` and `remedy` are complete sentences. `file` is relative to the workspace's src. `line` counts
    from 1, and is 0 if the line is unknown.
    """

    problem: str
    remedy: str
    file: str = ""
    line: int = 0

    @property
    def place(self) -> str:
        """Return the file and line, such as "my_services/CMakeLists.txt, line 6", or "" without a file."""
        return f"{self.file}, line {self.line}" if self.line else self.file

    def __str__(self) -> str:
        text = f"{self.problem} {self.remedy}"
        return f"{self.place}: {text}" if self.place else text


@dataclass(frozen=True)
class Tag:
    """An opening tag, the line where it begins, and the text after it."""

    name: str
    line: int
    text: str


def without_comments(text: str) -> str:
    """Return a package.xml without its comments; line numbers do not change."""
    return _COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), text)


def manifest_tags(text: str) -> Iterator[Tag]:
    """Yield the opening tags in the order of the file, except tags in comments."""
    bare = without_comments(text)
    for found in _TAG.finditer(bare):
        yield Tag(found["name"], bare.count("\n", 0, found.start()) + 1, found["text"].strip())


def dependencies(text: str, purpose: str) -> set[str]:
    """Return the dependencies in the `text` of a package.xml; `purpose` is "build" or "run".

    Dependencies with the attribute `condition` are ignored. `text` has to be valid for catkin.
    """
    # The import is inside the function because it takes 50 ms.
    from catkin_pkg.package import parse_package_string

    package = parse_package_string(text)
    named = package.build_depends if purpose == "build" else package.exec_depends
    return {each.name for each in named if each.condition is None}


def locate(fault: Fault, text: str) -> Fault:
    """Return a fault of a package.xml, with the line of the wrong tag if this tag can be found."""
    if "not closed" in fault.problem and (tag := _unclosed(text)):
        return replace(fault, problem=f"The tag {tag.name} is not closed.", line=tag.line)
    if fault.line or not fault.file.endswith("package.xml"):
        return fault
    words = set(re.findall(r"\w+", fault.problem)) - {"package"}
    lines = [tag.line for tag in manifest_tags(text) if tag.name in words]
    return replace(fault, line=lines[0]) if lines else fault


def _unclosed(text: str) -> Tag | None:
    """Return the first tag, except the outermost tag, that is opened more often than it is closed."""
    opened = list(manifest_tags(text))
    for tag in opened[1:]:
        if sum(each.name == tag.name for each in opened) > text.count(f"</{tag.name}>"):
            return tag
    return None
