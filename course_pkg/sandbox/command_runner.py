"""Runs the commands of a check in grading, where the student's kernel cannot reach them.

In class the kernel runs them. In grading a kernel could report that a failed build succeeded, or that a
program printed something else. So another process, in a sandbox of its own, runs them and reads the part's
folder.
"""

from __future__ import annotations

import os
import socket
from pathlib import Path

from course_pkg.checking.channel import Channel
from course_pkg.checking.kernel.agent import KernelAgent
from course_pkg.errors import ChannelError
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.sandbox.namespaces import be_unreadable
from course_pkg.types import Plain

OWN = "/tmp"  # noqa: S108 -- in the sandbox, for this process only
COMMANDS = frozenset({"folder", "run", "start", "poll", "stop"})


def is_command(do: object, name: object) -> bool:
    """Return whether a request is about commands and files, and not about what is in the kernel."""
    return do in COMMANDS or (do in ("look", "source") and str(name).startswith("file:"))


class SplitChannel(Channel):
    """The check runner's channel: commands and files go to the command runner, all else to the kernel."""

    def __init__(self, client: socket.socket, commands: socket.socket) -> None:
        super().__init__(client)
        self._commands = Channel(commands)

    def ask(self, do: str, *, timeout: float, **arguments: Plain) -> dict[str, Json]:
        """Ask the process whose answer can be believed, and return the answer."""
        if is_command(do, arguments.get("name")):
            return self._commands.ask(do, timeout=timeout, **arguments)
        return super().ask(do, timeout=timeout, **arguments)


def run_commands(sock: socket.socket, folder: str, *, sandboxed: bool) -> None:
    """Answer the requests of the check runner until it closes the channel."""
    if sandboxed:
        be_unreadable()
        os.environ.update(ROS_LOG_DIR=OWN, ROS_HOME=OWN)  # the student's folder is read-only here
    channel, agent = Channel(sock), KernelAgent({}, Path(folder))
    try:
        while True:
            request = channel.receive()
            known = is_command(request.get("do"), request.get("name"))
            channel.send(agent.reply(request if known else {**request, "do": "nothing"}))
    except ChannelError:
        agent.close()
