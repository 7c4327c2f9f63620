"""The wire between a kernel's desk, which is not trusted, and the judge of what it holds.

A stream socket, one JSON object a line, UTF-8, at most `LIMIT` bytes a line. The judge never
unpickles or evaluates what it gets: it is plain data.

    desk  -> judge   {"protocol": 1, "check": "05.1"}            once, first
    judge -> desk    {"ask": 1, "do": "look", "name": "measure"}
    desk  -> judge   {"answer": 1, "kind": "function"}           or {"answer": 1, "wrong": "..."}
    ...                                                          as often as the check needs
    judge -> desk    {"report": {...}}                           once, last

What can be asked, and what is answered:

    look     name                         kind (function, class, value, stub, missing), alike
    read     name                         value
    source   name                         text
    prepare  code, within                 error (the judge's code: it makes arguments for calls)
    call     name, args, kwargs, within   value or error, printed, took
    folder   files, texts                 folder (its number: copies of files, over them the judge's texts)
    run      argv, folder, within         status, out, err, took
    start    argv, folder                 process (its number)
    poll     process                      status, None while it runs
    stop     process                      as run; status is None where it still ran

A line that is too long, that is no JSON object, or that answers another question breaks the link;
the judge counts that as a failure, never as a pass.
"""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Mapping
from typing import Any

from course_pkg.errors import LinkBroken, LinkClosed, LinkSilent
from course_pkg.examiner.plain import Plain

PROTOCOL = 1
LIMIT = 1 << 20


class Link:
    """One end of the wire."""

    def __init__(self, sock: socket.socket) -> None:
        self._socket = sock
        self._received = bytearray()
        self._asked = 0

    def fileno(self) -> int:
        """Return the socket's descriptor, so that it can be polled."""
        return self._socket.fileno()

    def send(self, message: Mapping[str, Any]) -> None:
        """Send one message; raise LinkClosed when nobody is at the other end."""
        line = json.dumps(message).encode() + b"\n"
        if len(line) > LIMIT:
            raise LinkBroken(f"a message of {len(line)} bytes is longer than {LIMIT}")
        try:
            self._socket.settimeout(None)
            self._socket.sendall(line)
        except OSError as error:
            raise LinkClosed(f"the other end is gone: {error}") from error

    def receive(self, timeout: float | None = None) -> dict[str, Any]:
        """Return the next message, waiting at most `timeout` s."""
        self._socket.settimeout(timeout)
        while b"\n" not in self._received:
            if len(self._received) > LIMIT:
                raise LinkBroken(f"a line is longer than {LIMIT} bytes")
            self._received += self._chunk(timeout)
        line, _, rest = self._received.partition(b"\n")
        self._received = bytearray(rest)
        return self._parsed(bytes(line))

    def _chunk(self, timeout: float | None) -> bytes:
        try:
            chunk = self._socket.recv(65536)
        except TimeoutError as error:
            raise LinkSilent(f"no answer within {timeout:g} s") from error
        except OSError as error:
            raise LinkClosed(f"the other end is gone: {error}") from error
        if not chunk:
            raise LinkClosed("the other end closed the link")
        return chunk

    def _parsed(self, line: bytes) -> dict[str, Any]:
        try:
            message = json.loads(line)
        except (ValueError, RecursionError) as error:
            raise LinkBroken(f"a line is not JSON: {line[:80]!r}") from error
        if not isinstance(message, dict):
            raise LinkBroken(f"a line is not a JSON object: {line[:80]!r}")
        return message

    def ask(self, do: str, *, timeout: float, **what: Plain) -> dict[str, Any]:
        """Ask the desk to `do` something and return its answer."""
        self._asked += 1
        self.send({"ask": self._asked, "do": do, **what})
        answer = self.receive(timeout)
        if type(answer.get("answer")) is not int or answer["answer"] != self._asked:
            raise LinkBroken(f"an answer to another question: {str(answer)[:80]}")
        if "wrong" in answer:
            raise LinkBroken(f"{do} could not be answered: {answer['wrong']}")
        return answer

    def close(self) -> None:
        """Close this end; the other one notices."""
        self._socket.close()


def connect(address: str) -> Link:
    """Connect to a waiting judge at `address`: the path of a Unix socket, or host:port."""
    host, _, port = address.rpartition(":")
    try:
        if host and port.isdigit() and os.sep not in host:
            return Link(socket.create_connection((host, int(port)), timeout=5.0))
        return Link(_unix_socket(address))
    except OSError as error:
        raise LinkClosed(f"no examiner waits at {address}: {error}") from error


def _unix_socket(path: str) -> socket.socket:
    sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        sock.connect(path)
    except OSError:
        sock.close()
        raise
    return sock
