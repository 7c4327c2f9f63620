"""Who comes before the server is up."""

from __future__ import annotations

import socket
from collections.abc import Iterator

import pytest

from course_pkg.lab.porch import Porch
from course_pkg.lab.ports import listening
from tests.support import eventually

QUESTION = b"GET /lab?token=abc HTTP/1.1\r\n"
REST = b"Host: here\r\nCookie: x=1\r\n\r\n"


@pytest.fixture
def listener() -> Iterator[socket.socket]:
    """A socket that listens."""
    with listening() as made:
        yield made


def asking(listener: socket.socket, words: bytes) -> socket.socket:
    """Connect and say `words`."""
    client = socket.create_connection(listener.getsockname(), timeout=10)
    client.sendall(words)
    return client


def everything(client: socket.socket) -> bytes:
    """Read until the other end hangs up."""
    return b"".join(iter(lambda: client.recv(4096), b""))


def test_the_one_page_is_handed_out_at_once(listener: socket.socket) -> None:
    """Who asks for the page gets it whole, and the connection is closed; the server never sees it."""
    answer = b"HTTP/1.1 200 OK\r\n\r\n" + b"page" * 100_000
    porch = Porch(listener, QUESTION, answer)
    with asking(listener, QUESTION + REST) as client:
        assert everything(client) == answer
    assert porch.clear() == []


@pytest.mark.parametrize("answer", [b"page", b""])
def test_all_others_wait_for_the_server_with_what_they_said(listener: socket.socket, answer: bytes) -> None:
    """A wrong token, another path, nothing said yet: the server gets the connection, every word unread.

    So it does with the right question when there is no page to give.
    """
    words = [QUESTION.replace(b"abc", b"xyz") + REST, b"GET /api HTTP/1.1\r\n\r\n", b"G"]
    words += [] if answer else [QUESTION + REST]
    porch = Porch(listener, QUESTION, answer)
    clients = [asking(listener, said) for said in words] + [socket.create_connection(listener.getsockname())]
    eventually(lambda: len(porch._waiting) == len(clients))
    waiting = {address: connection for connection, address in porch.clear()}
    assert set(waiting) == {client.getsockname() for client in clients}
    for client, said in zip(clients, words, strict=False):
        connection = waiting[client.getsockname()]
        connection.settimeout(5)
        assert connection.recv(4096) == said
    for end in (*clients, *waiting.values()):
        end.close()


def test_one_who_says_no_more_holds_nobody_up(
    listener: socket.socket, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A question that stops in the middle is given up, and the next is answered."""
    monkeypatch.setattr("course_pkg.lab.porch.PATIENCE", 0.05)
    porch = Porch(listener, QUESTION, b"page")
    with asking(listener, QUESTION), asking(listener, QUESTION + REST) as client:
        assert everything(client) == b"page"
    assert porch.clear() == []


def test_who_comes_after_is_left_to_the_server(listener: socket.socket) -> None:
    """Once it is cleared, the porch accepts nobody, and the socket listens on."""
    porch = Porch(listener, QUESTION, b"page")
    porch.clear()
    with asking(listener, QUESTION + REST):
        listener.settimeout(5)
        connection, _ = listener.accept()
        assert connection.recv(4096) == QUESTION + REST
        connection.close()
