"""A private network consists of Linux namespaces; processes enter them through file descriptors.

Programs in a private network can connect only to each other. Other users and other private networks of the
same user cannot use the ports and abstract sockets of these programs. The user root needs only a network
namespace. Other users also need a user namespace. In a user namespace, users have their names and file
permissions but cannot become another user. Therefore, `sudo` does not work. See network_namespaces(7) and
user_namespaces(7).
"""

from __future__ import annotations

import os
import shutil
import socket
from collections.abc import Sequence
from typing import NoReturn

from course_pkg.sandbox.linux import namespaces

ENTER = "nsenter"  # nsenter is a program of util-linux.
# A graph has at most two file descriptors. This dict maps the number of file descriptors to the kinds of
# their namespaces.
KINDS = {0: (), 1: (namespaces.NETWORK,), 2: (namespaces.USER, namespaces.NETWORK)}


def create() -> list[int]:
    """Create a network namespace, and a user namespace if it is necessary; return their file descriptors.

    The namespaces exist while a process uses them or has their file descriptors open. Raises OSError, with
    the reason, if this machine does not allow them.
    """
    if not shutil.which(ENTER):
        raise OSError(f"{ENTER} is not installed")
    if os.geteuid() == 0:
        try:
            return _create(namespaces.NETWORK)
        except OSError:
            # In some containers, root can create a network namespace only together with a user namespace.
            pass
    return _create(namespaces.USER | namespaces.NETWORK)


def enter(files: Sequence[int]) -> None:
    """Enter the namespaces of the file descriptors `files`; the calling process must have only one thread."""
    for file, kind in zip(files, KINDS[len(files)], strict=True):
        namespaces.enter(file, kind)
    # After a change of the user namespace, other processes of the user cannot read this process in /proc.
    # Other programs of the course need to read /proc/PID.
    namespaces.be_readable()


def entering(files: Sequence[int]) -> list[str]:
    """Return a prefix for a command line; with this prefix, the command runs in these namespaces.

    `files` contains file descriptors. The prefix works only while this process keeps them open.
    """
    paths = [f"/proc/{os.getpid()}/fd/{file}" for file in files]
    user = [f"--user={paths[0]}"] if len(paths) > 1 else []
    return [ENTER, *user, f"--net={paths[-1]}", "--preserve-credentials", "--"]


def _create(kinds: int) -> list[int]:
    """Create namespaces in a child process; it sends their file descriptors to this process and ends."""
    ours, theirs = socket.socketpair()
    with ours, theirs:
        child = os.fork()
        if child == 0:
            _send(theirs, kinds)
        theirs.close()
        reason, files, _, _ = socket.recv_fds(ours, 4096, 2)
        os.waitpid(child, 0)
    if not files:
        raise OSError(reason.decode() or "the reason is unknown")
    for file in files:
        os.set_inheritable(file, False)
    return list(files)


def _send(connection: socket.socket, kinds: int) -> NoReturn:
    try:
        outside = os.getuid(), os.getgid()
        namespaces.unshare(kinds)
        names = ["net"]
        if kinds & namespaces.USER:
            namespaces.become(*outside, outside=outside)
            names = ["user", "net"]
        namespaces.start_loopback()
        socket.send_fds(
            connection, [b"created"], [os.open(f"/proc/self/ns/{name}", os.O_RDONLY) for name in names]
        )
    except OSError as error:
        connection.sendall(str(error.strerror or error).encode())
    finally:
        os._exit(0)
