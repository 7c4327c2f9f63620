"""Prepare a node after init_node(): the node then ignores idle connections, and records its activity.

In rospy, one thread accepts all connections and also reads their headers. If a client connects and sends
nothing, the node accepts no other connections to its services and topics. In a prepared node, the thread that
accepts connections reads only headers that have arrived completely. For a header that arrives slowly, a
separate thread waits for a limited time.

In the slave API (http://wiki.ros.org/ROS/Slave_API), `getBusStats` returns a list for the statistics of
services. In rospy, this list is empty; this module fills the list. `getCourseRecord` is an additional method
of the course. A node that was not prepared returns an error for it.
"""

from __future__ import annotations

import json
import logging
import select
import socket
import struct
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import rospy
from rospy.impl import tcpros_base
from rospy.impl.masterslave import ROSHandler
from rospy.impl.registration import get_service_manager

from course_pkg.ros.protocol.rospy_registrations import registration_manager
from course_pkg.ros.trace.call_counter import CallerCount
from course_pkg.ros.trace.handover import hand_over_at_exit
from course_pkg.ros.trace.hooks import Hook, Method
from course_pkg.ros.trace.recorder import recorder
from course_pkg.ros.trace.recording import GET_RECORD
from course_pkg.ros.trace.service_hooks import hook_services
from course_pkg.ros.trace.topic_hooks import hook_topics

HEADER_TIMEOUT = 10.0  # A header has to arrive within this time in s.
AT_ONCE = 2  # If a header takes longer than this time in ms, a separate thread waits for it.
LONGEST = 65536  # A connection with a longer header (in bytes) is closed.
# The maximum number of connections that wait until the node accepts them. rospy's limit is 5. If more clients
# connect at once, some of them wait 1 s for a TCP retransmission.
BACKLOG = 128
STATISTICS = "getBusStats"
UNSUPPORTED = "the callers of its services, because this rospy reports its statistics in a different way"
# This attribute marks a registration manager whose thread wakes up at once during a shutdown.
HASTENED = "hastened_by_course"

Serve = Callable[[socket.socket, Any], None]


def prepare_node() -> None:
    """Prepare this process's node, directly after rospy.init_node().

    In a prepared node, idle connections do not block other connections. The node records calls and messages,
    and shuts down faster. Call this function before you create a service, publisher or proxy. A second call
    has no effect.
    """
    guard_against_idle_connections()
    hasten_shutdown()
    hook_services()
    hook_topics()
    extend_slave()
    hand_over_at_exit()


def guard_against_idle_connections() -> bool:
    """Make this process's node wait for headers on separate threads.

    Call this function after init_node(). The function changes rospy's internals. If this release of rospy has
    different internals, the function returns False and changes nothing.
    """
    tcpros_base.start_tcpros_server()
    server = getattr(tcpros_base, "_tcpros_server", None)
    listener = getattr(server, "tcp_ros_server", None)
    serve = getattr(listener, "inbound_handler", None)
    if listener is None or not callable(serve):
        text = "idle connections can block this node, because this version of rospy is unknown"
        logging.getLogger("rospy.course").warning(text)
        return False
    if not (isinstance(serve, partial) and serve.func is _accepted):
        listener.inbound_handler = partial(_accepted, serve)
        listener.server_sock.listen(BACKLOG)
    return True


def hasten_shutdown() -> None:
    """Wake up rospy's registration thread as soon as a shutdown begins.

    This function makes a shutdown up to 0.5 s shorter.
    """
    manager = registration_manager()
    if manager is None or getattr(manager, HASTENED, False):
        return
    setattr(manager, HASTENED, True)

    def wake(_reason: str) -> None:
        with manager.cond:
            manager.cond.notify_all()

    rospy.core.add_shutdown_hook(wake)


def extend_slave() -> None:
    """Make the slave API of this process's node return the node's records."""
    setattr(ROSHandler, GET_RECORD, _record)
    # A decorator in rospy gives the method getBusStats the parameters `args` and `kwds`.
    hook = Hook(ROSHandler, STATISTICS, ("args", "kwds"), _add_services)
    if hook.fits():
        hook.install()
    else:
        recorder().unsupported.add(UNSUPPORTED)


def _accepted(serve: Serve, sock: socket.socket, address: Any) -> None:  # noqa: ANN401 -- of any address family
    if _header_arrives(sock, AT_ONCE / 1000):
        serve(sock, address)
    else:
        threading.Thread(target=_serve_later, args=(serve, sock, address), daemon=True).start()


def _serve_later(serve: Serve, sock: socket.socket, address: Any) -> None:  # noqa: ANN401
    if _header_arrives(sock, HEADER_TIMEOUT):
        serve(sock, address)
    else:
        sock.close()


def _header_arrives(sock: socket.socket, timeout: float) -> bool:
    """Wait up to `timeout` s; return whether a whole header has arrived or the client has disconnected."""
    deadline = time.monotonic() + timeout
    if not _readable(sock, 4, deadline):
        return False
    start = sock.recv(4, socket.MSG_PEEK)
    if len(start) < 4:
        return True  # The client has closed the connection; rospy detects this itself.
    (length,) = struct.unpack("<I", start)
    return length <= LONGEST and _readable(sock, 4 + length, deadline)


def _readable(sock: socket.socket, count: int, deadline: float) -> bool:
    """Return whether at least `count` bytes arrive before the deadline.

    With the socket option SO_RCVLOWAT, poll() waits until `count` bytes have arrived.
    """
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVLOWAT, count)
    try:
        poll = select.poll()
        poll.register(sock, select.POLLIN)
        return bool(poll.poll(max(deadline - time.monotonic(), 0) * 1000))
    finally:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVLOWAT, 1)


def _record(_handler: ROSHandler, _caller_id: str, since: float) -> tuple[int, str, str]:
    """Return the record of this node since the time `since` (s of time.monotonic()), as JSON.

    Encoding JSON is ten times as fast as encoding XML.
    """
    return 1, "", json.dumps(recorder().since(float(since)))


def _add_services(method: Method) -> Method:
    def get_bus_stats(*args: Any, **kwds: Any) -> Any:  # noqa: ANN401 -- what XML-RPC takes
        code, message, stats = method(*args, **kwds)
        if code == 1 and len(stats) == 3 and not stats[2]:
            stats = [*stats[:2], _service_stats()]
        return code, message, stats

    return get_bus_stats


def _service_stats() -> list[tuple[str, list[CallerCount]]]:
    """Return [service, [caller, requests, time of the last request, running requests]*] for each service."""
    names = sorted({name for name, _ in get_service_manager().get_services()})
    return [(name, recorder().call_counter.callers(name)) for name in names]
