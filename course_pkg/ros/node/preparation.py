"""What makes a process that has called init_node() a node of the course.

Idle connections: rospy reads the header of every connection on the one thread that accepts them, so a client
that connects and sends nothing stops all services and topics of the node. Here that thread hands a connection
on only when its header has arrived; a slower one waits on a separate thread, for a limited time.

The slave API (http://wiki.ros.org/ROS/Slave_API): `getBusStats` has a place for the statistics of services,
which rospy leaves empty; `getCourseRecord` is the course's own. A node that does not have it answers that it
does not know the method.
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
from course_pkg.ros.trace.handover import hand_over_at_exit
from course_pkg.ros.trace.hooks import Hook, Method
from course_pkg.ros.trace.recorder import CallerCount, recorder
from course_pkg.ros.trace.recording import GET_RECORD
from course_pkg.ros.trace.service_hooks import hook_services
from course_pkg.ros.trace.topic_hooks import hook_topics

HEADER_TIMEOUT = 10.0  # s for a header to arrive
AT_ONCE = 2  # ms to wait for a header before a thread is started for it
LONGEST = 65536  # bytes of a header that is worth waiting for
BACKLOG = 128  # connections; with rospy's 5, some of a burst of clients wait 1 s for TCP's next attempt
STATISTICS = "getBusStats"
UNSUPPORTED = "who calls its services: this rospy reports otherwise"
HASTENED = "hastened_by_course"  # an attribute of a registration manager that is woken already

Serve = Callable[[socket.socket, Any], None]


def prepare_node() -> None:
    """Make this process's node one that no idle connection blocks, that is recorded, and that ends at once.

    Call it right after rospy.init_node(), before anything is served, published or called. A second call
    changes nothing.
    """
    guard_against_idle_connections()
    hasten_shutdown()
    hook_services()
    hook_topics()
    extend_slave()
    hand_over_at_exit()


def guard_against_idle_connections() -> bool:
    """Make this process's node hand on only connections whose header has arrived; return whether it can.

    Call it after init_node(). It changes rospy's internals; a rospy that is built differently is not changed.
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


def hasten_shutdown() -> None:
    """Spare the end of the process 0.5 s, for which rospy's registration thread sleeps before it notices."""
    manager = registration_manager()
    if manager is None or getattr(manager, HASTENED, False):
        return
    setattr(manager, HASTENED, True)

    def wake(_reason: str) -> None:
        with manager.cond:
            manager.cond.notify_all()

    rospy.core.add_shutdown_hook(wake)


def extend_slave() -> None:
    """Make this process's node answer for what it has recorded."""
    setattr(ROSHandler, GET_RECORD, _record)
    # rospy checks the arguments of the method in a wrapper, whose own arguments are these.
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
    """Return whether a whole header, or the end of the stream, can be read within `timeout` s."""
    deadline = time.monotonic() + timeout
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


def _record(_handler: ROSHandler, _caller_id: str, since: float) -> tuple[int, str, str]:
    """Return what was recorded since then (s of time.monotonic()), as JSON: XML takes ten times as long."""
    return 1, "", json.dumps(recorder().since(float(since)))


def _add_services(method: Method) -> Method:
    def get_bus_stats(*args: Any, **kwds: Any) -> Any:  # noqa: ANN401 -- what XML-RPC takes
        code, message, stats = method(*args, **kwds)
        if code == 1 and len(stats) == 3 and not stats[2]:
            stats = [*stats[:2], _service_stats()]
        return code, message, stats

    return get_bus_stats


def _service_stats() -> list[tuple[str, list[CallerCount]]]:
    """Return [service, [caller, requests, when last, how many run]*] for each service of this node."""
    names = sorted({name for name, _ in get_service_manager().get_services()})
    return [(name, recorder().call_counter.callers(name)) for name in names]
