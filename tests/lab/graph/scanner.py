"""Finds and prints the master, node, service and socket with the name NAME in the current network.

usage: python3 scanner.py NAME [SOCKET …]

The program sends three requests to each listening TCP port: for a master's state, for a node's address, and
for the service NAME. The program also tests whether each abstract socket accepts connections. The program
also connects to each SOCKET, which is the path of a Unix socket. The program uses only the standard library,
so that every user can run it.
"""

from __future__ import annotations

import socket
import struct
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

TIMEOUT = 2.0  # maximum time of a request in s
BODY = (
    "<methodCall><methodName>{}</methodName><params><param><value>/scan</value></param></params></methodCall>"
)


def ports() -> Iterator[int]:
    """Yield the TCP ports on which programs in this network listen."""
    for kind in ("tcp", "tcp6"):
        for line in Path("/proc/net", kind).read_text().splitlines()[1:]:
            words = line.split()
            if words[3] == "0A":
                yield int(words[1].rpartition(":")[2], 16)


def answer(port: int, request: bytes) -> bytes:
    """Send a request to a port, and return the reply."""
    received = b""
    with suppress(OSError), socket.create_connection(("localhost", port), TIMEOUT) as client:
        client.settimeout(TIMEOUT)
        client.sendall(request)
        while part := client.recv(1 << 16):
            received += part
    return received


def call(port: int, method: str) -> bytes:
    """Send an XML-RPC request to a port, and return the reply."""
    body = BODY.format(method).encode()
    return answer(port, b"POST /RPC2 HTTP/1.0\r\nContent-Length: %d\r\n\r\n%s" % (len(body), body))


def probe(port: int, service: str) -> bytes:
    """Ask a port for the type of a ROS service, and return the reply."""
    fields = [b"probe=1", b"md5sum=*", b"callerid=/scan", b"service=" + service.encode()]
    header = b"".join(struct.pack("<I", len(field)) + field for field in fields)
    return answer(port, struct.pack("<I", len(header)) + header)


def accepts(name: str) -> bool:
    """Return whether a Unix socket accepts a connection."""
    with suppress(OSError), socket.socket(socket.AF_UNIX) as client:
        client.settimeout(TIMEOUT)
        client.connect(name)
        return True
    return False


def asked(name: str, port: int) -> list[str]:
    """Return which requests for a name the port answers: "master", "node" or "service"."""
    answers = {
        "master": f"/{name}".encode() in call(port, "getSystemState"),
        "node": f"/{name}".encode() in call(port, "getName"),
        "service": b"type=" in probe(port, f"/{name}"),
    }
    return [kind for kind, offered in answers.items() if offered]


def found(name: str, paths: list[str]) -> Iterator[str]:
    """Yield "master", "node", "service" or "socket" for each match, and each path that can be opened."""
    with ThreadPoolExecutor(30) as threads:
        for kinds in threads.map(lambda port: asked(name, port), set(ports())):
            yield from kinds
    abstract = [line.split()[-1] for line in Path("/proc/net/unix").read_text().splitlines() if " @" in line]
    for socket_name in {"\0" + each[1:] for each in abstract if name in each}:
        if accepts(socket_name):
            yield "socket"
    yield from (path for path in paths if accepts(path))


sys.stdout.write(" ".join(found(sys.argv[1], sys.argv[2:])))
