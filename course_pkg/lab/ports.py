"""Ports to listen on."""

from __future__ import annotations

import socket
from collections.abc import Iterable

from course_pkg.errors import PortBusy


def listening(ip: str = "127.0.0.1", candidates: Iterable[int] = (0,)) -> socket.socket:
    """Listen on the first of `candidates` that is free at `ip`, and return that socket; 0 stands for any."""
    reason, tried = "no port was given", 0
    for tried in candidates:
        listener = socket.socket(socket.AF_INET6 if ":" in ip else socket.AF_INET)
        try:
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listener.bind((ip, tried))
            listener.listen(128)
        except (OSError, OverflowError) as error:
            listener.close()
            reason = getattr(error, "strerror", None) or str(error)
        else:
            return listener
    raise PortBusy(
        f"JupyterLab cannot listen on {ip}:{tried}: {reason}. Leave --port out to get a free port."
    )


def free_port() -> int:
    """Return a port of 127.0.0.1 that nobody listens on."""
    with listening() as listener:
        return int(listener.getsockname()[1])
