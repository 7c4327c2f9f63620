"""The channel transports plain data, and closes after an invalid line."""

from __future__ import annotations

import json
import socket
import threading
from collections.abc import Iterator
from contextlib import suppress

import pytest

from course_pkg.checking.channel import LIMIT, Channel, connect
from course_pkg.errors import ChannelBroken, ChannelClosed, ChannelTimeout


@pytest.fixture
def ends() -> Iterator[tuple[Channel, socket.socket]]:
    """Return the check runner's channel and the client's socket."""
    ours, theirs = socket.socketpair()
    channel = Channel(ours)
    yield channel, theirs
    channel.close()
    theirs.close()


def test_an_answer_comes_back(ends: tuple[Channel, socket.socket]) -> None:
    """A reply has the same number as its request."""
    channel, client = ends
    client.sendall(b'{"answer": 1, "value": [1, 2.5, null]}\n')
    assert channel.ask("read", timeout=1.0, name="x")["value"] == [1, 2.5, None]
    assert json.loads(client.recv(1000)) == {"ask": 1, "do": "read", "name": "x"}


def test_lines_arrive_in_pieces(ends: tuple[Channel, socket.socket]) -> None:
    """The channel accepts lines that arrive in several packets, and two lines in one packet."""
    channel, client = ends
    client.sendall(b'{"a": 1}\n{"b"')
    assert channel.receive(1.0) == {"a": 1}
    client.sendall(b": 2}\n")
    assert channel.receive(1.0) == {"b": 2}


@pytest.mark.parametrize(
    "line",
    [
        b"no json\n",
        b"[1]\n",
        b"\xff\xfe\n",
        b"[" * 5000 + b"\n",
        b'{"answer": 7}\n',
        b'{"answer": true}\n',
        b'{"answer": 1, "wrong": "x"}\n',
        b"{}\n",
    ],
)
def test_invalid_line_closes_the_channel(ends: tuple[Channel, socket.socket], line: bytes) -> None:
    """An invalid reply closes the channel."""
    channel, client = ends
    client.sendall(line)
    with pytest.raises(ChannelBroken):
        channel.ask("read", timeout=1.0, name="x")


def _flood(client: socket.socket) -> None:
    with suppress(OSError):  # If a line is too long, the check runner closes the connection.
        client.sendall(b"x" * 4 * LIMIT)


def test_a_line_has_a_limit(ends: tuple[Channel, socket.socket]) -> None:
    """The channel does not send or accept a line that is too long."""
    channel, client = ends
    with pytest.raises(ChannelBroken, match="longer than"):
        channel.send({"text": "x" * LIMIT})
    writer = threading.Thread(target=_flood, args=(client,))
    writer.start()
    with pytest.raises(ChannelBroken, match="longer than"):
        channel.receive(5.0)
    channel.close()
    writer.join()


def test_timeout_and_closed_channel_are_different_errors(ends: tuple[Channel, socket.socket]) -> None:
    """A timeout and a closed channel raise different errors."""
    channel, client = ends
    with pytest.raises(ChannelTimeout):
        channel.receive(0.01)
    client.close()
    with pytest.raises(ChannelClosed):
        channel.receive(1.0)


def test_missing_check_runner_is_reported_with_its_address() -> None:
    """If the check runner is missing, the error message contains its address."""
    with pytest.raises(ChannelClosed, match="/nowhere/check_runner"):
        connect("/nowhere/check_runner")
