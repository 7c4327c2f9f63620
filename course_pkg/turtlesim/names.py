"""Which names a turtle may have, and the words of a refusal: as roscpp's for a namespace."""

from __future__ import annotations

import re

FIRST = re.compile(r"[A-Za-z/~]")
FURTHER = re.compile(r"[A-Za-z0-9_/]")


def objection(name: str) -> str:
    """Return what is wrong with `name` as the name of a graph resource, or "" if it is sound."""
    where = f"Graph Resource Name [{name}].  "
    if not FIRST.match(name):
        return (
            f"Character [{name[:1]}] is not valid as the first character in {where}"
            "Valid characters are a-z, A-Z, / and in some cases ~."
        )
    for index, character in enumerate(name[1:], start=1):
        if not FURTHER.match(character):
            return (
                f"Character [{character}] at element [{index}] is not valid in {where}"
                "Valid characters are a-z, A-Z, 0-9, / and _."
            )
    if name.startswith("~"):
        return f"Using ~ names with NodeHandle methods is not allowed. (name = [{name}])"
    return ""
