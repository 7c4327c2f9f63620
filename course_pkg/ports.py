"""Find a port on which a program can listen; this module imports only the standard library."""

from __future__ import annotations

import errno
import socket
from collections.abc import Iterable


def free_port(ip: str = "127.0.0.1", candidates: Iterable[int] = (0,)) -> int:
    """Return the first port in `candidates` on which a program can listen at `ip`; 0 means any port.

    Raises OSError if there is no such port.
    """
    problem = OSError(errno.EINVAL, "no port was given")
    for port in candidates:
        with socket.socket(socket.AF_INET6 if ":" in ip else socket.AF_INET) as probe:
            try:
                probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
                probe.bind((ip, port))
                probe.listen()
                return int(probe.getsockname()[1])
            except OSError as error:
                problem = error
            except OverflowError as error:  # `port` is not between 0 and 65535.
                problem = OSError(errno.EINVAL, str(error))
    raise problem
