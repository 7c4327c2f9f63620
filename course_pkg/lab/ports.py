"""Ports to listen on."""

from __future__ import annotations

import socket
from collections.abc import Iterable

from course_pkg.errors import PortBusy


def free_port(ip: str = "127.0.0.1", candidates: Iterable[int] = (0,)) -> int:
    """Return the first of `candidates` that can be listened on at `ip`; 0 stands for any."""
    reason, tried = "no port was given", 0
    for tried in candidates:
        try:
            with socket.socket(socket.AF_INET6 if ":" in ip else socket.AF_INET) as probe:
                probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
                probe.bind((ip, tried))
                return int(probe.getsockname()[1])
        except (OSError, OverflowError) as error:
            reason = getattr(error, "strerror", None) or str(error)
    raise PortBusy(
        f"JupyterLab cannot listen on {ip}:{tried}: {reason}. Leave --port out to get a free port."
    )
