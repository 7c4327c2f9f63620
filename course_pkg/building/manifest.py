"""The tags of a package.xml with their lines, also of one that is not well-formed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from course_pkg.building.fault import Fault

_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_TAG = re.compile(r"<(?P<name>[A-Za-z_]\w*)(?:\s[^<>]*)?>(?P<text>[^<]*)")
_NEEDED = {
    "build": ("build_depend", "depend"),
    "run": ("exec_depend", "run_depend", "depend"),
}


@dataclass(frozen=True)
class Tag:
    """A tag that is opened, the line where it begins, and the text behind it."""

    name: str
    line: int
    text: str


def tags(text: str) -> Iterator[Tag]:
    """Yield the tags in their order; those in comments are none."""
    bare = _COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), text)
    for found in _TAG.finditer(bare):
        yield Tag(found["name"], bare.count("\n", 0, found.start()) + 1, found["text"].strip())


def needed(text: str, purpose: str) -> set[str]:
    """Return the packages that are needed for `purpose`: "build" or "run"."""
    return {tag.text for tag in tags(text) if tag.name in _NEEDED[purpose]}


def placed(fault: Fault, text: str) -> Fault:
    """Return a fault of a package.xml with the line of the tag that it is about, where one can be found."""
    if "not closed" in fault.problem and (tag := _unclosed(text)):
        return replace(fault, problem=f"The tag {tag.name} is not closed.", line=tag.line)
    if fault.line or not fault.file.endswith("package.xml"):
        return fault
    words = set(re.findall(r"\w+", fault.problem)) - {"package"}
    lines = [tag.line for tag in tags(text) if tag.name in words]
    return replace(fault, line=lines[0]) if lines else fault


def _unclosed(text: str) -> Tag | None:
    """Return the first tag that is opened once more than it is closed, the outermost one aside."""
    opened = list(tags(text))
    for tag in opened[1:]:
        if sum(each.name == tag.name for each in opened) > text.count(f"</{tag.name}>"):
            return tag
    return None
