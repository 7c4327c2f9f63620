"""The commands `course doctor` and `course lock`, and the base class of all commands."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import SimpleNamespace
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from argparse import ArgumentParser

UNSAFE = "--unsafe-no-sandbox"  # With this option, `course grade` needs no packages for a sandbox.


class Command(NamedTuple):
    """A subcommand.

    The object is created before the set-up, when libraries may be missing. Therefore, only the function `run`
    may import other modules. `needs` lists what the set-up must provide first, for example "course" and
    "grade". A command that imports libraries needs "libraries". It runs with the interpreter of the virtual
    environment. In the students' edition, a command that needs "solutions" ends with an error message. If
    `rest` is not empty, another program gets all arguments; in the usage, `rest` describes them.
    """

    summary: str
    run: Callable[[SimpleNamespace], int]
    needs: frozenset[str] = frozenset({"course"})
    add_arguments: Callable[[ArgumentParser], None] | None = None
    rest: str = ""


def _doctor(_options: SimpleNamespace) -> int:
    from course_pkg.setup.doctor import examine

    return examine()


def _lock(_options: SimpleNamespace) -> int:
    from course_pkg.setup.lock import write_locks
    from course_pkg.setup.places import Places

    for path in write_locks(Places.of()):
        sys.stdout.write(f"{path}\n")
    return 0


COMMANDS = {
    "doctor": Command("show what is installed, missing or outdated, and what to do", _doctor, frozenset()),
    "lock": Command("write the exact versions of all libraries that pyproject.toml needs", _lock),
}
