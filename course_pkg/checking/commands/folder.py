"""A check's own folder on the kernel's computer, and the commands that the kernel runs in it."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from types import TracebackType

from course_pkg.checking.channel import Channel
from course_pkg.checking.result import Finished
from course_pkg.errors import ChannelError, CheckError, GraphError
from course_pkg.ros.protocol.snapshot import Snapshot, look
from course_pkg.ros.protocol.xmlrpc import port_of
from course_pkg.waiting import at_this_load, wait_until

SLACK = 3.0  # The kernel must reply within this time in s after the time limit of a command.
ENDING = 5.0  # A command has to end within this time in s after SIGINT or SIGKILL.
LOOK = 0.1  # This is the time in s between two snapshots of a graph.
COLOUR = re.compile(r"\x1b\[\d*m")


class Folder:
    """A folder with copies of the student's files and with the check's own files.

    The folder is deleted after the check.

    Before each command, the function `doing` is called with the text of the command.
    """

    def __init__(
        self, channel: Channel, files: Sequence[str], texts: Mapping[str, str], doing: Callable[[str], None]
    ) -> None:
        self._channel = channel
        self._doing = doing
        reply = channel.ask("folder", timeout=SLACK, files=files, texts=texts)
        self._number = reply.get("folder")
        # The SHA-256 sum of the only program that the commands may execute, or "" for all programs.
        self.only = ""

    def command(self, *argv: str, within: float = 10.0, worded: str = "") -> Finished:
        """Run a command in this folder; the time limit is `within` (s), or longer on a busy machine.

        The command "python" starts the kernel's own interpreter.

        The command runs in the course's environment, without the student's sourced packages. A report shows
        the command, or the text `worded` instead. Raises ChannelError if the kernel does not reply.
        """
        self._doing(worded or " ".join(argv))
        limit = at_this_load(within)
        reply = self._channel.ask("run", timeout=within + SLACK, argv=argv, folder=self._number, within=limit)
        return Finished(reply)

    def start(self, *argv: str, worded: str = "") -> Running:
        """Start a command in this folder; it runs until stop(). Returns a context manager."""
        self._doing(worded or " ".join(argv))
        reply = self._channel.ask("start", timeout=SLACK, argv=argv, folder=self._number)
        number = reply.get("process")
        if not isinstance(number, int):
            raise CheckError("The kernel could not start a command of the check. Restart the kernel.")
        return Running(self._channel, number, lambda: self._doing(worded or " ".join(argv)), self.only)


class Running:
    """A command, such as a node, that runs until it is stopped."""

    def __init__(self, channel: Channel, number: int, show: Callable[[], None], only: str = "") -> None:
        self._channel = channel
        self._number = number
        self._only = only
        self.other = ""  # The name of a forbidden program that examine() has found, or "".
        self.show = show  # show() makes reports show this command as the last command.

    @property
    def status(self) -> int | None:
        """The exit status, or None while the command runs."""
        status = self._channel.ask("poll", timeout=SLACK, process=self._number).get("status")
        return status if isinstance(status, int) else None

    def listens_at(self, uri: str, *, itself: bool = False) -> bool:
        """Return whether the command or one of its child processes listens at the port in `uri`.

        If `itself` is true, the child processes do not count.
        """
        reply = self._channel.ask("ports", timeout=at_this_load(SLACK), process=self._number)
        ports = reply.get("own" if itself else "ports")
        return isinstance(ports, list) and port_of(uri) in ports

    def examine(self) -> None:
        """Store the name of a forbidden file that a process of the command executes."""
        if self._only and not self.other:
            reply = self._channel.ask("programs", timeout=at_this_load(SLACK), process=self._number)
            programs = reply.get("programs")
            found = (
                [each for each in programs if isinstance(each, list)] if isinstance(programs, list) else []
            )
            self.other = next((str(name) for digest, name in found if digest != self._only), "")

    def stop(self) -> Finished:
        """End the command.

        The status is None if the command was still running; `out` contains stdout and stderr.
        """
        return Finished(self._channel.ask("stop", timeout=ENDING, process=self._number))

    def __enter__(self) -> Running:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(ChannelError):  # If the kernel has ended, the command has ended, too.
            self.stop()


def becomes(uri: str, condition: Callable[[Snapshot], object], within: float) -> bool:
    """Wait until the function `condition` accepts the graph of the master at the address `uri`.

    The maximum waiting time is `within` (s).

    Return whether the function has accepted the graph.

    The master may start during the wait.
    """

    def holds() -> bool:
        with suppress(GraphError):  # The master has not started yet.
            return bool(condition(look(uri)))
        return False

    return wait_until(holds, within, LOOK)


def telling_line(printed: str) -> str:
    """Return the last line of `printed` that contains an error, or the last line if there is no such line.

    Colour codes and the path of the current folder are removed.
    """
    lines = [line.strip() for line in COLOUR.sub("", printed).splitlines() if line.strip()]
    telling = [line for line in lines if "rror" in line or "annot" in line or "nvalid" in line]
    return (telling or lines or ["nothing"])[-1].replace(f"{os.getcwd().rstrip('/')}/", "/")
