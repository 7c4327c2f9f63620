"""During grading, run the commands of a check in a process that the student's kernel cannot change.

When a student runs a check, the student's kernel also runs the commands of the check. During grading, a
student's kernel could report a false result, for example that a failed build succeeded. In grading, a process
in another sandbox therefore runs the commands and reads the part's folder.
"""

from __future__ import annotations

import os
import socket
import tempfile
from pathlib import Path

from course_pkg.checking.channel import Channel
from course_pkg.checking.kernel.agent import KernelAgent
from course_pkg.errors import ChannelError
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.sandbox.linux.namespaces import be_unreadable
from course_pkg.types import Plain

OWN = "/tmp"  # noqa: S108 -- only this process uses it, in its sandbox
COMMANDS = frozenset({"folder", "run", "start", "poll", "stop", "ports", "programs"})


def is_command(do: object, name: object) -> bool:
    """Return whether a request is about commands and files, not about objects in the kernel."""
    return do in COMMANDS or (do in ("look", "source") and str(name).startswith("file:"))


class SplitChannel(Channel):
    """The check runner's channel: requests about commands and files go to the command runner.

    Requests about objects in the kernel go to the student's kernel.
    """

    def __init__(self, client: socket.socket, commands: socket.socket) -> None:
        super().__init__(client)
        self._commands = Channel(commands)

    def ask(self, do: str, *, timeout: float, **arguments: Plain) -> dict[str, Json]:
        """Send a request to the command runner or to the kernel, and return the response."""
        if is_command(do, arguments.get("name")):
            return self._commands.ask(do, timeout=timeout, **arguments)
        return super().ask(do, timeout=timeout, **arguments)


def run_commands(sock: socket.socket, folder: str, own: str) -> None:
    """Execute the requests of the check runner until the check runner closes the channel.

    In a sandbox, the student's folder is read-only. `own` is a folder for temporary files and the files of
    ROS; other processes cannot read it. Without a sandbox, `own` is an empty string.
    """
    if own:
        be_unreadable()
        os.environ.update(ROS_LOG_DIR=own, ROS_HOME=own, TMPDIR=own)
        tempfile.tempdir = own
    channel, agent = Channel(sock), KernelAgent({}, Path(folder))
    try:
        while True:
            request = channel.receive()
            known = is_command(request.get("do"), request.get("name"))
            channel.send(agent.reply(request if known else {**request, "do": "nothing"}))
    except ChannelError:
        agent.close()
