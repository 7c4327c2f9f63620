"""Chapter 07's check of an import can distinguish a script that never ends from a busy machine."""

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
    """A fake folder: each command that is run in it returns the same result."""

    def __init__(self, reply: Reply) -> None:
        self.reply = reply

    def command(self, *_argv: str, within: float, worded: str) -> Finished:
        """Return the result of a command; a time in `reply` is a fraction of the time limit."""
        times = {name: value * within for name, value in self.reply.items() if isinstance(value, float)}
        assert worded == "import server.py"
        return Finished({**self.reply, **times, "took": within})


def imported(**reply: float | int | str | None) -> CheckContext:
    """Return the context of a check in which the import ended with `reply`."""
    context = CheckContext("07.4", cast("Channel", None), cast("Node", None), 1)
    folder = cast("Folder", Replying(dict(reply)))
    can_be_imported(context, BuiltPackage(folder, Package("my_geometry", {})), SCRIPT)
    return context


def test_slow_import_on_a_busy_machine_is_not_a_mistake() -> None:
    """The import waited for the CPU, or its times are not known: the check reports a busy machine."""
    for reply in ({"ran": 0.02, "queued": 0.9}, {}):
        with pytest.raises(CheckError, match=r"the machine is busy\. Run this cell again"):
            imported(status=None, **reply)


def test_import_that_never_ends_is_a_mistake() -> None:
    """The assertion fails if the import mostly slept, or used more CPU time than a normal import."""
    for reply in ({"ran": 0.02, "queued": 0.05}, {"ran": 0.5, "queued": 0.5}):
        with pytest.raises(AssertionFailed, match="an import of the script starts no node"):
            imported(status=None, **reply)


def test_an_import_that_ends_is_accepted() -> None:
    """The script contains only definitions, so the import ends, and the check's own code then exits."""
    assert [each.holds for each in imported(status=IMPORTED).assertions] == [True]


def test_a_script_that_exits_during_its_import_is_a_mistake() -> None:
    """A script could hide that it starts a node if it ends the process with the exit status 0."""
    with pytest.raises(AssertionFailed, match="an import of the script starts no node"):
        imported(status=0)


@pytest.fixture
def folders(tmp_path: Path) -> Iterator[CommandFolders]:
    """Return folders in which a check can run commands."""
    made = CommandFolders(lambda name: tmp_path / name)
    yield made
    made.close()


def test_the_times_of_a_command_that_was_still_running_are_known(folders: CommandFolders) -> None:
    """A sleeping command neither uses the CPU nor waits for it, but a computing command does."""
    number = folders.folder([], {})["folder"]
    assert isinstance(number, int)
    sleeping = Finished(folders.run(["sleep", "60"], number, 1.0))
    computing = Finished(folders.run(["python", "-c", "while True: pass"], number, 1.0))
    ended = Finished(folders.run(["true"], number, 20.0))
    assert sleeping.status is computing.status is None
    assert sleeping.ran + sleeping.queued < 0.5 < computing.ran + computing.queued
    assert ended.queued == float("inf")
