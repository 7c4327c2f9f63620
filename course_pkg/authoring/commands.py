"""The commands `course sync` and `course test`, and their options."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.setup.commands import Command

if TYPE_CHECKING:
    from argparse import ArgumentParser


def _test(options: SimpleNamespace) -> int:
    from course_pkg.authoring.suite import run_suite

    return run_suite(options.rest)


def _sync(options: SimpleNamespace) -> int:
    from course_pkg.authoring.execute import execute
    from course_pkg.authoring.notebook_store import sync

    if options.execute is not None:
        execute(options.execute)
    return int(sync(check=options.check))


def _sync_arguments(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--check", action="store_true", help=("change nothing; list the files that are out of date")
    )
    parser.add_argument(
        "--execute",
        nargs="*",
        metavar="CHAPTER",
        help="first run the solutions of these chapters, or of all chapters",
    )


COMMANDS = {
    "test": Command(
        "run the whole suite: lint, types, spelling, tests",
        _test,
        frozenset({"course", "test", "solutions"}),
        rest="[PYTEST ARGUMENT …]",
    ),
    "sync": Command(
        "derive the students' notebooks from the solutions",
        _sync,
        frozenset({"course", "libraries", "solutions"}),
        _sync_arguments,
    ),
}
