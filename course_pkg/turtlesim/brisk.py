"""Publishing many small messages at a fixed rate, without a thread for each listener, and without waiting.

rospy gives every listener of a topic with a queue a thread of its own, and each message wakes it: that is
most of what 1,500 messages a second cost. Without a queue a message is written at once, and a listener that
takes none holds the publisher up. So here it is written at once where there is room for it, and dropped where
there is none, as a queue of one would drop it.
"""

from __future__ import annotations

import select
from typing import Any


def publish_briskly(publisher: Any) -> None:  # noqa: ANN401 -- rospy has no types
    """Have `publisher` write its messages at once, and never wait for a listener."""
    impl = publisher.impl
    bare = impl.add_connection
    impl.queue_size = None

    def add_connection(connection: Any) -> Any:  # noqa: ANN401
        connection.write_data = _Writer(connection)
        return bare(connection)

    impl.add_connection = add_connection


class _Writer:
    """Writes to one listener's connection, as long as that takes what it gets."""

    def __init__(self, connection: Any) -> None:  # noqa: ANN401
        self._write = connection.write_data
        self._room = select.poll()
        self._room.register(connection.socket, select.POLLOUT)

    def __call__(self, data: bytes) -> Any:  # noqa: ANN401
        """Write `data`, or leave it out; an error is the connection's own to find."""
        if self._room.poll(0):
            return self._write(data)
        return True
