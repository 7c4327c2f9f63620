"""Tests of chapter 07's import check, which distinguishes an endless script from a busy machine."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import cast

import pytest

from course_pkg.chapters.ch07_build_a_package.checks.program import IMPORTED, Program, can_be_imported
from course_pkg.checking.assertions import AssertionFailed
from course_pkg.checking.channel import Channel
from course_pkg.checking.commands.folder import Folder
from course_pkg.checking.commands.workbench import CommandFolders
from course_pkg.checking.context import CheckContext
from course_pkg.checking.peers.node import Node
from course_pkg.checking.plain_values import Reply
from course_pkg.checking.result import Finished
from course_pkg.checking.shared.catkin_package import BuiltPackage, Package
from course_pkg.errors import CheckError

SCRIPT = Program("scripts/server.py")


class Replying:
    """A fake folder in which each command returns the same result."""

    def __init__(self, reply: Reply) -> None:
        self.reply = reply

    def command(self, *_argv: str, within: float, worded: str) -> Finished:
        """Return the given reply as the result of a command.

        Each time in the given reply is a fraction of the time limit `within`, and is converted to s.
        """
        times = {name: value * within for name, value in self.reply.items() if isinstance(value, float)}
        assert worded == "import server.py"
        return Finished({**self.reply, **times, "took": within})


def imported(**reply: float | int | str | None) -> CheckContext:
    """Run the import check, and return the check's context.

    No script runs, because a fake folder returns the given reply as the result of the import.
    """
    context = CheckContext("07.4", cast("Channel", None), cast("Node", None), 1)
    folder = cast("Folder", Replying(dict(reply)))
    can_be_imported(context, BuiltPackage(folder, Package("my_geometry", {})), SCRIPT)
    return context


def test_slow_import_on_a_busy_machine_is_not_a_mistake() -> None:
    """If the import waited for the CPU, the check reports a busy machine."""
    for reply in ({"ran": 0.02, "queued": 0.9}, {}):
        with pytest.raises(CheckError, match=r"the machine is busy\. Run this cell again"):
            imported(status=None, **reply)


def test_import_that_never_ends_is_a_mistake() -> None:
    """If the import slept or used much CPU time, the check fails."""
    for reply in ({"ran": 0.02, "queued": 0.05}, {"ran": 0.5, "queued": 0.5}):
        with pytest.raises(AssertionFailed, match="an import of the script starts no node"):
            imported(status=None, **reply)


def test_an_import_that_ends_is_accepted() -> None:
    """The check accepts a script that contains only definitions."""
    assert [each.holds for each in imported(status=IMPORTED).results.assertions] == [True]


def test_a_script_that_exits_during_its_import_is_a_mistake() -> None:
    """The check fails if the script exits with status 0 during its import."""
    with pytest.raises(AssertionFailed, match="an import of the script starts no node"):
        imported(status=0)


@pytest.fixture
def folders(tmp_path: Path) -> Iterator[CommandFolders]:
    """Return the folders in which a check runs commands."""
    made = CommandFolders(lambda name: tmp_path / name)
    yield made
    made.close()


def test_the_times_of_a_command_that_was_still_running_are_known(folders: CommandFolders) -> None:
    """If a command reaches its time limit, the result contains the CPU time of the command."""
    number = folders.folder([], {})["folder"]
    assert isinstance(number, int)
    sleeping = Finished(folders.run(["sleep", "60"], number, 1.0))
    computing = Finished(folders.run(["python", "-c", "while True: pass"], number, 1.0))
    ended = Finished(folders.run(["true"], number, 20.0))
    assert sleeping.status is computing.status is None
    assert sleeping.ran + sleeping.queued < 0.5 < computing.ran + computing.queued
    assert ended.queued == float("inf")
