"""The list of all faults, and functions that select faults by name or group."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from course_pkg.errors import UnknownFault
from course_pkg.faults.calling import CALLING
from course_pkg.faults.fault import Fault
from course_pkg.faults.masters import MASTERS
from course_pkg.faults.nodes import NODES
from course_pkg.faults.serving import SERVING
from course_pkg.faults.stage import Stage

GROUPS = ("serving", "calling", "masters")


def every_fault() -> tuple[Fault, ...]:
    """Return all faults."""
    return (*SERVING, *CALLING, *NODES, *MASTERS)


def names() -> list[str]:
    """Return the names of all faults."""
    return [each.name for each in every_fault()]


def named(name: str) -> Fault:
    """Return the fault called `name`. Raises UnknownFault if there is no such fault."""
    return _only(select(name), name)


@contextmanager
def caused(name: str) -> Iterator[Stage]:
    """Cause the fault called `name` during a `with` block, and undo it after the block.

    Raises UnknownFault if there is no such fault, and NodeFailed if the fault could not be caused.
    """
    stage = Stage(named(name))
    stage.cause()
    try:
        yield stage
    finally:
        stage.undo()


def select(*chosen: str) -> tuple[Fault, ...]:
    """Return the faults whose name or group is in `chosen`; return all faults if `chosen` is empty.

    Raises UnknownFault for a name in `chosen` that is not a fault and not a group.
    """
    found = [_found(name) for name in chosen] if chosen else [every_fault()]
    return tuple(dict.fromkeys(each for some in found for each in some))


def _found(name: str) -> tuple[Fault, ...]:
    found = tuple(each for each in every_fault() if name in (each.name, each.group))
    if not found:
        raise UnknownFault(
            f"No fault has the name {name!r}. Choose one of the groups {', '.join(GROUPS)}, or one of the "
            f"faults {', '.join(names())}."
        )
    return found


def _only(found: tuple[Fault, ...], name: str) -> Fault:
    if len(found) != 1:
        raise UnknownFault(f"{name!r} is a group of {len(found)} faults. Choose one of these faults.")
    return found[0]
