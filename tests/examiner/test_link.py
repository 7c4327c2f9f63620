"""The wire carries plain data, in bounds, and breaks at anything else."""

from __future__ import annotations

import json
import socket
import threading
from collections.abc import Iterator
from contextlib import suppress

import pytest

from course_pkg.errors import LinkBroken, LinkClosed, LinkSilent
from course_pkg.examiner.link import LIMIT, Link, connect


@pytest.fixture
def ends() -> Iterator[tuple[Link, socket.socket]]:
    """Give a judge's link, and the bare socket of a desk that may send anything."""
    ours, theirs = socket.socketpair()
    link = Link(ours)
    yield link, theirs
    link.close()
    theirs.close()


def test_an_answer_comes_back(ends: tuple[Link, socket.socket]) -> None:
    """A question is one line of JSON with a number, and the answer with that number is its answer."""
    link, desk = ends
    desk.sendall(b'{"answer": 1, "value": [1, 2.5, null]}\n')
    assert link.ask("read", timeout=1.0, name="x")["value"] == [1, 2.5, None]
    assert json.loads(desk.recv(1000)) == {"ask": 1, "do": "read", "name": "x"}


def test_lines_arrive_in_pieces(ends: tuple[Link, socket.socket]) -> None:
    """Where a line is cut on its way does not matter, and two may come at once."""
    link, desk = ends
    desk.sendall(b'{"a": 1}\n{"b"')
    assert link.receive(1.0) == {"a": 1}
    desk.sendall(b": 2}\n")
    assert link.receive(1.0) == {"b": 2}


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
def test_what_the_protocol_does_not_allow_breaks_the_link(
    ends: tuple[Link, socket.socket], line: bytes
) -> None:
    """No JSON, no object, another question's answer, or a refusal: none of them is an answer."""
    link, desk = ends
    desk.sendall(line)
    with pytest.raises(LinkBroken):
        link.ask("read", timeout=1.0, name="x")


def _flood(desk: socket.socket) -> None:
    with suppress(OSError):  # the judge hangs up on it
        desk.sendall(b"x" * 4 * LIMIT)


def test_a_line_has_a_limit(ends: tuple[Link, socket.socket]) -> None:
    """Neither end takes or makes a line without bounds."""
    link, desk = ends
    with pytest.raises(LinkBroken, match="longer than"):
        link.send({"text": "x" * LIMIT})
    writer = threading.Thread(target=_flood, args=(desk,))
    writer.start()
    with pytest.raises(LinkBroken, match="longer than"):
        link.receive(5.0)
    link.close()
    writer.join()


def test_silence_and_absence_are_told_apart(ends: tuple[Link, socket.socket]) -> None:
    """No answer in time is one thing, nobody there another."""
    link, desk = ends
    with pytest.raises(LinkSilent):
        link.receive(0.01)
    desk.close()
    with pytest.raises(LinkClosed):
        link.receive(1.0)


def test_a_judge_that_is_not_there_is_named() -> None:
    """The address stands in the message."""
    with pytest.raises(LinkClosed, match="/nowhere/judge"):
        connect("/nowhere/judge")
