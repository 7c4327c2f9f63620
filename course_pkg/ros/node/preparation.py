"""Add the features of a course node to a process, after init_node().

In rospy, one thread accepts all connections and also reads their headers. A client that connects and sends
nothing therefore blocks new connections to all services and topics of the node. In a prepared node, this
thread reads a header only after the whole header has arrived. If a header arrives slowly, a separate thread
waits for it, for a limited time.

In the slave API (http://wiki.ros.org/ROS/Slave_API), the answer of `getBusStats` has a part for the
statistics of services. rospy leaves this part empty, and this module fills it. `getCourseRecord` is an
additional method that the course defines; a node that was not prepared answers that the method is unknown.
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

HEADER_TIMEOUT = 10.0  # maximum time in s until a header has arrived
AT_ONCE = 2  # time in ms; if a header takes longer, a separate thread waits for it
LONGEST = 65536  # maximum size of a header in bytes; a connection with a longer header is closed
# maximum number of waiting connections; with rospy's limit of 5, some clients have to wait 1 s for a TCP
# retransmission when many clients connect at once
BACKLOG = 128
STATISTICS = "getBusStats"
UNSUPPORTED = "the callers of its services: this rospy reports its statistics in another way"
HASTENED = "hastened_by_course"  # marks a registration manager that the shutdown has already woken up

Serve = Callable[[socket.socket, Any], None]


def prepare_node() -> None:
    """Prepare this process's node.

    After this, idle connections do not block the node, its calls and messages are recorded, and it ends
    quickly.

    Call this function directly after rospy.init_node(), before you create a service, publisher or proxy. A
    second call changes nothing.
    """
    guard_against_idle_connections()
    hasten_shutdown()
    hook_services()
    hook_topics()
    extend_slave()
    hand_over_at_exit()


def guard_against_idle_connections() -> bool:
    """Make this process's node wait for headers on separate threads.

    Return whether this release of rospy allows this change.

    Call this function after init_node(). This function changes rospy's internals. If the internals of this
    release of rospy are different, the function changes nothing and returns False.
    """
    tcpros_base.start_tcpros_server()
    server = getattr(tcpros_base, "_tcpros_server", None)
    listener = getattr(server, "tcp_ros_server", None)
    serve = getattr(listener, "inbound_handler", None)
    if listener is None or not callable(serve):
        text = "idle connections can block this node: this rospy accepts connections in another way"
        logging.getLogger("rospy.course").warning(text)
        return False
    if not (isinstance(serve, partial) and serve.func is _accepted):
        listener.inbound_handler = partial(_accepted, serve)
        listener.server_sock.listen(BACKLOG)
    return True


def hasten_shutdown() -> None:
    """Make a shutdown wake up rospy's registration thread at once.

    The process then ends up to 0.5 s earlier.
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
    """Make this process's node return its records through the slave API."""
    setattr(ROSHandler, GET_RECORD, _record)
    # rospy wraps this method in a function that checks the arguments; this function has the parameters args
    # and kwds.
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
        return True  # The client has closed the connection, and rospy detects this itself.
    (length,) = struct.unpack("<I", start)
    return length <= LONGEST and _readable(sock, 4 + length, deadline)


def _readable(sock: socket.socket, count: int, deadline: float) -> bool:
    """Return whether `count` bytes arrive before the deadline.

    With SO_RCVLOWAT, poll() waits until all of them have arrived.
    """
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVLOWAT, count)
    try:
        poll = select.poll()
        poll.register(sock, select.POLLIN)
        return bool(poll.poll(max(deadline - time.monotonic(), 0) * 1000))
    finally:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVLOWAT, 1)


def _record(_handler: ROSHandler, _caller_id: str, since: float) -> tuple[int, str, str]:
    """Return the record of this node from the time `since` (s of time.monotonic()), as JSON.

    Encoding the record as XML would take ten times as long.
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
