"""A publisher that never waits for a listener."""

from __future__ import annotations

import socket
from types import SimpleNamespace

from course_pkg.turtlesim.brisk import publish_briskly


def test_a_listener_that_takes_nothing_holds_nobody_up() -> None:
    """Messages are written while there is room, left out when there is none, and written again after that."""
    near, far = socket.socketpair()
    with near, far:
        near.setblocking(True)
        connection = SimpleNamespace(socket=near, write_data=lambda data: near.sendall(data) is None)
        impl = SimpleNamespace(queue_size=1, add_connection=lambda added: added)
        publish_briskly(SimpleNamespace(impl=impl))
        writes = impl.add_connection(connection).write_data
        message = bytes(32)
        for _ in range(100_000):  # far more than a socket holds
            assert writes(message)
        far.setblocking(False)
        taken = 0
        while True:
            try:
                taken += len(far.recv(1 << 20))
            except BlockingIOError:
                break
        assert 0 < taken < 100_000 * len(message)
        assert writes(b"again")
        assert far.recv(100) == b"again"
    assert impl.queue_size is None
