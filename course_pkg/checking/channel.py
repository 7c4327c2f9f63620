"""The connection between the check runner and the check client, which runs in a kernel that is not trusted.

The client and the runner use a stream socket, with one JSON object of at most `LIMIT` bytes in each line. The
runner never unpickles or evaluates received data.

    client -> runner   {"protocol": 5, "check": "05.1"}            once, first
    runner -> client   {"ask": 1, "do": "look", "name": "measure"}
    client -> runner   {"answer": 1, "kind": "function"}           or {"answer": 1, "wrong": "..."}
    ...                                                            as often as the check needs
    runner -> client   {"report": {...}}                           once, last

The requests, their arguments, and the fields of the replies:

    look     name                         kind (function, class, value, blank, missing), alike, older
    served   name                         older (what to do if the handler of a service is an earlier version)
    traceback                             text (of the last exception of a handler in the kernel's process)
    read     name                         value
    source   name                         text
    prepare  code, within                 error (`code` is the check's own code, which makes arguments)
    place    name, port, key, item        (defines a proxy for an object, see placed/host.py)
    call     name, args, kwargs, within   value or error, printed, took
    folder   files, texts                 folder (its number; it contains copies of `files`, and `texts`)
    run      argv, folder, within         status, out, err, took
    start    argv, folder                 process (the number of the process)
    poll     process                      status (null while the process runs)
    stop     process                      as for run; status is null if the process was still running
    ports    process                      ports (the TCP ports on which the command listens), own (only the
                                          ports of the command's own process)
    programs process                      programs (the SHA-256 sum and the name of each file that the
                                          processes of the command execute)

After a line that is too long, is not a JSON object, or replies to another request, the channel closes the
connection. The check runner then reports that the check has failed.
"""

from __future__ import annotations

import os
import socket
import threading
from collections.abc import Mapping

from course_pkg.errors import ChannelBroken, ChannelClosed, CheckError
from course_pkg.ros.protocol.json_channel import Json, JsonChannel
from course_pkg.types import Plain
from course_pkg.waiting import at_this_load

PROTOCOL = 5
LIMIT = 1 << 20  # A line has at most this number of bytes.
LONGEST = 400  # A report shows at most this number of characters of a received message.


class Channel(JsonChannel):
    """A JSON channel between the check client and the check runner."""

    def __init__(self, sock: socket.socket) -> None:
        super().__init__(sock, LIMIT)
        self._asked = 0
        # Two threads of the check runner can send requests: the thread of the check, and the thread of its
        # server.
        self._asking = threading.Lock()

    def ask(self, do: str, *, timeout: float, **arguments: Plain) -> dict[str, Json]:
        """Send the request `do` to the check client, and return its reply.

        The time limit is `timeout` s, or longer on a busy machine. Raises the exceptions of JsonChannel, and
        ChannelBroken if the reply belongs to another request.
        """
        limit = at_this_load(timeout)
        with self._asking:
            self._asked += 1
            asked = self._asked
            self.send({"ask": asked, "do": do, **arguments}, limit)
            reply = self.receive(limit)
        if type(reply.get("answer")) is not int or reply["answer"] != asked:
            raise ChannelBroken(f"the kernel sent an answer to a different request: {str(reply)[:80]}")
        if "wrong" in reply:
            raise ChannelBroken(f"the kernel could not answer the request {do!r}: {reply['wrong']}")
        return reply


def require_current(reply: Mapping[str, Json]) -> None:
    """Raise CheckError if the kernel reports that a function is older than the code in its cell."""
    if older := str(reply.get("older") or "")[:LONGEST]:
        raise CheckError(older)


def connect(address: str) -> Channel:
    """Connect to the check runner at `address`, which is the path of a Unix socket or host:port.

    Raises ChannelClosed if no runner accepts the connection.
    """
    host, _, port = address.rpartition(":")
    try:
        if host and port.isdigit() and os.sep not in host:
            sock = socket.create_connection((host, int(port)), timeout=5.0)
            sock.settimeout(None)
            return Channel(sock)
        return Channel(_unix_socket(address))
    except OSError as error:
        raise ChannelClosed(f"no check runner is connected at {address}: {error}") from error


def _unix_socket(path: str) -> socket.socket:
    sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        sock.connect(path)
    except OSError:
        sock.close()
        raise
    return sock
