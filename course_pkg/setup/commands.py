"""`course doctor` and `course lock`; and what every command of `course` declares."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import SimpleNamespace
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from argparse import ArgumentParser

UNSAFE = "--unsafe-no-sandbox"  # with it, `course grade` needs nothing besides the course


class Command(NamedTuple):
    """A subcommand. It is read before anything is set up, so it imports what it runs only in `run`.

    `needs` says what has to be set up for it: "course", and also "grade" or "test". A command that imports
    libraries needs "libraries": it runs on the interpreter of the virtual environment.
    Where `rest` is not empty, all arguments belong to another program; `rest` shows them in the usage.
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
    "doctor": Command("show what is installed, missing and stale, and what to do", _doctor, frozenset()),
    "lock": Command("pin every library that pyproject.toml needs", _lock),
}
