"""Which process listens on which port, as Linux tells it; proc(5), /proc/net/tcp."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from course_pkg.graph.leashed import descendants

LISTEN = "0A"  # of tcp_states.h


def family(pid: int) -> list[int]:
    """Return the process and all its descendants."""
    return [pid, *descendants(pid)]


def listening_ports(pids: Iterable[int]) -> frozenset[int] | None:
    """Return the TCP ports on which these processes listen, or None where there is no /proc to tell."""
    if not Path("/proc/net/tcp").exists():
        return None
    mine = {inode for pid in pids for inode in _sockets(pid)}
    return frozenset(port for inode, port in _listeners() if inode in mine)


def port_of(uri: str) -> int:
    """Return the port of http://HOST:PORT/ or rosrpc://HOST:PORT, or 0."""
    digits = uri.rstrip("/").rpartition(":")[2]
    return int(digits) if digits.isdigit() else 0


def _sockets(pid: int) -> list[str]:
    found = []
    with suppress(OSError):  # it has ended meanwhile
        for descriptor in os.listdir(f"/proc/{pid}/fd"):
            with suppress(OSError):
                target = os.readlink(f"/proc/{pid}/fd/{descriptor}")
                if target.startswith("socket:["):
                    found.append(target[8:-1])
    return found


def _listeners() -> list[tuple[str, int]]:
    found = []
    for table in (Path("/proc/net/tcp"), Path("/proc/net/tcp6")):
        with suppress(OSError):
            for line in table.read_text().splitlines()[1:]:
                columns = line.split()
                if columns[3] == LISTEN:
                    found.append((columns[9], int(columns[1].rpartition(":")[2], 16)))
    return found
