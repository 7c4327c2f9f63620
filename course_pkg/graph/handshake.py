"""A node that an idle connection cannot block.

rospy reads the header of every connection on the one thread that accepts them, so a client that connects and
says nothing stops all services and topics of the node. Here that thread hands a connection on only when its
header has arrived; who takes longer waits on a thread of its own, and not for ever.
"""

from __future__ import annotations

import logging
import select
import socket
import struct
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from rospy.impl import tcpros_base

PATIENCE = 10.0  # s for a header to arrive
AT_ONCE = 2  # ms to wait before a thread is worth its while
LONGEST = 65536  # bytes of a header that is worth waiting for
BACKLOG = 128  # connections; rospy's 5 has a burst of clients wait 1 s for TCP's next try

Serve = Callable[[socket.socket, Any], None]


def guard_against_idle_connections() -> bool:
    """Have this process's node hand on only connections that have spoken; say whether it could be done.

    Call it after init_node(). It takes hold of rospy's internals, and leaves a rospy that differs alone.
    """
    tcpros_base.start_tcpros_server()
    server = getattr(tcpros_base, "_tcpros_server", None)
    listener = getattr(server, "tcp_ros_server", None)
    serve = getattr(listener, "inbound_handler", None)
    if listener is None or not callable(serve):
        logging.getLogger("rospy.course").warning("not guarded: this rospy accepts connections otherwise")
        return False
    if not (isinstance(serve, partial) and serve.func is _accepted):
        listener.inbound_handler = partial(_accepted, serve)
        listener.server_sock.listen(BACKLOG)
    return True


def _accepted(serve: Serve, sock: socket.socket, address: Any) -> None:  # noqa: ANN401 -- of any address family
    if _header_arrives(sock, AT_ONCE / 1000):
        serve(sock, address)
    else:
        threading.Thread(target=_serve_later, args=(serve, sock, address), daemon=True).start()


def _serve_later(serve: Serve, sock: socket.socket, address: Any) -> None:  # noqa: ANN401
    if _header_arrives(sock, PATIENCE):
        serve(sock, address)
    else:
        sock.close()


def _header_arrives(sock: socket.socket, patience: float) -> bool:
    """Return whether a whole header, or the end of the stream, is there to be read within `patience` s."""
    deadline = time.monotonic() + patience
    if not _readable(sock, 4, deadline):
        return False
    start = sock.recv(4, socket.MSG_PEEK)
    if len(start) < 4:
        return True  # the other end is gone, which rospy notices by itself
    (length,) = struct.unpack("<I", start)
    return length <= LONGEST and _readable(sock, 4 + length, deadline)


def _readable(sock: socket.socket, count: int, deadline: float) -> bool:
    """Return whether `count` bytes are there by the deadline; poll() reports no fewer than SO_RCVLOWAT."""
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVLOWAT, count)
    try:
        poll = select.poll()
        poll.register(sock, select.POLLIN)
        return bool(poll.poll(max(deadline - time.monotonic(), 0) * 1000))
    finally:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVLOWAT, 1)
