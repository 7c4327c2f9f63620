"""Connections from a private network to other computers, through slirp4netns.

slirp4netns forwards each connection from the private network as an ordinary connection of the user.
slirp4netns accepts no connection from outside. slirp4netns does not forward connections to the loopback
addresses of this computer, because servers of other users listen there. The program pasta is an alternative,
but in Debian 12, pasta cannot open a namespace by a descriptor in /proc.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence

from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.setup.network import FORWARDER

OPTIONS = ("--configure", "--mtu=65520", "--disable-host-loopback", "--netns-type=path")


class Outgoing:
    """A running slirp4netns process; it ends when end() is called, or when this process ends."""

    def __init__(self, process: SupervisedProcess, ready: int) -> None:
        self._process, self._ready = process, ready

    @classmethod
    def start(cls, files: Sequence[int]) -> Outgoing | None:
        """Connect a private network to other computers; return None if slirp4netns is not installed.

        `files` are the file descriptors of the network's namespaces.
        """
        if not shutil.which(FORWARDER):
            return None
        *user, network = (f"/proc/{os.getpid()}/fd/{file}" for file in files)
        kept = [f"--userns-path={path}" for path in user]
        reading, writing = os.pipe()
        try:
            command = [FORWARDER, *OPTIONS, *kept, f"--ready-fd={writing}", network, "tap0"]
            return cls(SupervisedProcess(command, inherit=[writing]), reading)
        finally:
            os.close(writing)

    def works(self) -> bool:
        """Wait until the network is connected, or until slirp4netns has failed.

        Return whether the network is connected.
        """
        return os.read(self._ready, 1) == b"1"

    def end(self) -> None:
        """End the connections."""
        self._process.end(grace=0)
