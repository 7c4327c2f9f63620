"""Send and receive JSON objects on a stream socket, one per line in UTF-8, with limits for size and time."""

from __future__ import annotations

import json
import select
import socket
import threading
from collections.abc import Mapping
from contextlib import suppress
from typing import TypeAlias

from course_pkg.errors import ChannelBroken, ChannelClosed, ChannelTimeout
from course_pkg.waiting import Deadline

Json: TypeAlias = "bool | int | float | str | list[Json] | dict[str, Json] | None"
LIMIT = 1 << 26  # This is the default limit for the length of a line in bytes.
CHUNK = 65536  # One read or write handles at most this number of bytes.


class JsonChannel:
    """A connection on which two processes exchange JSON objects.

    One thread may send while another thread receives.
    """

    def __init__(self, sock: socket.socket, limit: int = LIMIT) -> None:
        self._socket = sock
        self._limit = limit
        self._received = bytearray()
        # The first `_searched` bytes of `_received` contain no newline character.
        self._searched = 0
        self._sending = threading.Lock()

    def fileno(self) -> int:
        """Return the socket's file descriptor, for example for poll()."""
        return self._socket.fileno()

    def send(self, message: Mapping[str, object], timeout: float | None = None) -> None:
        """Send one object; if the send buffer is full, wait until the receiver reads data.

        The time limit is `timeout` s.

        Raises ChannelBroken if the message is too long, ChannelClosed if the receiver has closed the channel,
        and ChannelTimeout after `timeout` s. After ChannelTimeout, the caller must close the channel, because
        only a part of the message may have been sent.
        """
        line = memoryview(json.dumps(message).encode() + b"\n")
        if len(line) > self._limit:
            raise ChannelBroken(
                f"a message of {len(line)} bytes is longer than the limit of {self._limit} bytes"
            )
        deadline = Deadline(timeout)
        with self._sending:
            while line:
                try:
                    sent = self._socket.send(line[:CHUNK], socket.MSG_DONTWAIT)
                # poll() waits until most of the send buffer is free, so it is called only after send() has
                # failed.
                except BlockingIOError:
                    self._wait_for(select.POLLOUT, deadline)
                    continue
                except OSError as error:
                    raise ChannelClosed(f"the other end has closed the connection: {error}") from error
                line = line[sent:]

    def receive(self, timeout: float | None = None) -> dict[str, Json]:
        """Wait for a whole line, for at most `timeout` s, and return the JSON object in it.

        Raises ChannelTimeout after `timeout` s, ChannelClosed if the sender has closed the channel, and
        ChannelBroken if the line is too long or is not a JSON object.
        """
        deadline = Deadline(timeout)
        while (end := self._received.find(b"\n", self._searched)) < 0:
            self._searched = len(self._received)
            if self._searched > self._limit:
                raise ChannelBroken(f"a line is longer than {self._limit} bytes")
            self._wait_for(select.POLLIN, deadline)
            self._received += self._chunk()
        line = bytes(self._received[:end])
        del self._received[: end + 1]
        self._searched = 0
        return _parsed(line)

    def close(self) -> None:
        """Close the connection. In both processes, all calls of receive() then raise ChannelClosed."""
        with suppress(OSError):  # The other process may have closed the connection.
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()

    def _wait_for(self, event: int, deadline: Deadline) -> None:
        poll = select.poll()
        try:
            poll.register(self._socket, event)
        except ValueError as error:
            raise ChannelClosed("this end of the connection is closed") from error
        if not poll.poll(deadline.milliseconds):
            raise ChannelTimeout(f"no answer within {deadline.seconds:g} s")

    def _chunk(self) -> bytes:
        try:
            chunk = self._socket.recv(CHUNK)
        except OSError as error:
            raise ChannelClosed(f"the other end has closed the connection: {error}") from error
        if not chunk:
            raise ChannelClosed("the other end closed the connection")
        return chunk


def _parsed(line: bytes) -> dict[str, Json]:
    try:
        message = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise ChannelBroken(f"a line is not JSON: {line[:80]!r}") from error
    if not isinstance(message, dict):
        raise ChannelBroken(f"a line is not a JSON object: {line[:80]!r}")
    return message
