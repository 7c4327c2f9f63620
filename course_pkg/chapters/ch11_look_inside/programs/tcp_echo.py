"""The node `tcp_echo`: listens on a TCP port, stores the port in `~port`, and sends back all bytes.

The program uses no protocol of ROS. Therefore, a round trip to this program shows the shortest time that a
service call can take.
"""

from __future__ import annotations

import socket
import threading
from contextlib import suppress

import rospy

from course_pkg.ros.node.program import start_node


def main() -> None:
    """Send back all bytes until the node is shut down."""
    if not start_node("tcp_echo"):
        return
    with socket.create_server(("127.0.0.1", 0)) as listener:
        threading.Thread(target=_accept, args=(listener,), daemon=True).start()
        rospy.set_param("~port", listener.getsockname()[1])
        rospy.loginfo("The server runs; the parameter %s contains its port", rospy.resolve_name("~port"))
        rospy.spin()


def _accept(listener: socket.socket) -> None:
    with suppress(OSError):  # When the listening socket is closed, accept() raises OSError.
        while True:
            sock, _ = listener.accept()
            threading.Thread(target=_echo, args=(sock,), daemon=True).start()


def _echo(sock: socket.socket) -> None:
    with sock, suppress(OSError):
        sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        while data := sock.recv(65536):
            sock.sendall(data)
