"""The check runner's side of the proxies: it executes the calls that the student's kernel makes.

Each thread of the kernel has its own connection, and the check runner has one thread for each connection.
Therefore, many calls can wait in the check runner at the same time, and `threading.get_ident()` differs for
each thread of the kernel. Each line on a connection is one JSON object, such as:

    kernel -> runner   {"key": "…"}                                              once, first
    kernel -> runner   {"object": 0, "do": "call", "name": "read", "args": [], "kwargs": {}}
    kernel -> runner   {"object": 0, "do": "get", "name": "count"}
    kernel -> runner   {"object": 0, "do": "set", "name": "count", "args": [3]}
    runner -> kernel   {"value": 5}, {"placed": {…}} for another object, or {"error": {"type": …, "text": …}}

The listening socket is on the loopback interface. A kernel in a sandbox has the same loopback interface as
its check runner. The kernel receives the key with the request `place`, on another connection. Therefore,
other users of the computer do not know the key.
"""

from __future__ import annotations

import hmac
import secrets
import socket
import threading
from collections.abc import Mapping
from contextlib import suppress
from types import TracebackType

from course_pkg.checking.placed.declared import Interface, interface_of
from course_pkg.checking.plain_values import plain
from course_pkg.errors import ChannelBroken, ChannelError
from course_pkg.ros.protocol.json_channel import Json, JsonChannel
from course_pkg.waiting import Deadline

LIMIT = 1 << 16  # A line has at most this number of bytes.
# At most this number of connections is open at the same time. A kernel in a sandbox may have 200 threads.
CONNECTIONS = 128
# During one check, the kernel can make at most this number of calls. A loop that polls a lock makes about
# 10,000 calls per second.
CALLS = 200_000
KEY_TIMEOUT = 5.0  # The first line of a connection has to arrive within this time in s.
SEND_TIMEOUT = 5.0  # The kernel has to read a reply within this time in s.
END_TIMEOUT = 1.0  # All threads have to end within this time in s.
STACK = 512 * 1024  # The stack of each thread has this number of bytes, because a sandbox has limited memory.
LONGEST = 4000  # An error message has at most this number of characters.


class PlacedObjects:
    """Objects with remote methods, and the kernel's connections to them; a context manager.

    At the end of the `with` block, all connections are closed. A call that is still waiting then raises an
    error in the kernel. An object with waiting calls needs a method `close` that ends these calls.
    """

    def __init__(self) -> None:
        self._key = secrets.token_hex(16)
        self._objects: list[object] = []
        self._interfaces: dict[type, Interface] = {}
        self._listener = socket.create_server(("127.0.0.1", 0), backlog=CONNECTIONS)
        self._open: dict[threading.Thread, socket.socket] = {}
        self._calls = 0
        self._closed = False
        self._lock = threading.Lock()

    def __enter__(self) -> PlacedObjects:
        self._accepting = threading.Thread(target=self._accept, daemon=True)
        self._accepting.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with self._lock:
            self._closed = True
            left = dict(self._open)
        with suppress(OSError):
            # This call ends the other thread's accept() with an error.
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        for each in self._objects:
            if callable(close := getattr(each, "close", None)):
                close()
        for sock in left.values():
            with suppress(OSError):
                sock.shutdown(socket.SHUT_RDWR)
        deadline = Deadline(END_TIMEOUT)
        for thread in (self._accepting, *left):
            thread.join(deadline.left)

    def place(self, item: object) -> dict[str, Json]:
        """Return the arguments of the request `place` for an object: port, key and remote names."""
        port: int = self._listener.getsockname()[1]
        return {"port": port, "key": self._key, "item": self._described(item)}

    def _described(self, item: object) -> dict[str, Json]:
        with self._lock:
            known = next((number for number, each in enumerate(self._objects) if each is item), None)
            number = len(self._objects) if known is None else known
            if known is None:
                self._objects.append(item)
        names = self._interface(item)
        return {
            "number": number,
            "kind": type(item).__name__,
            "methods": [*sorted(names.methods)],
            "readable": [*sorted(names.readable)],
            "writable": [*sorted(names.writable)],
        }

    def _interface(self, item: object) -> Interface:
        kind = type(item)
        if kind not in self._interfaces:
            self._interfaces[kind] = interface_of(kind)
        return self._interfaces[kind]

    def _accept(self) -> None:
        while True:
            try:
                sock, _ = self._listener.accept()
            except OSError:  # The listening socket was closed.
                return
            with self._lock:
                if self._closed or len(self._open) >= CONNECTIONS:
                    sock.close()
                    continue
                self._begin(sock)

    def _begin(self, sock: socket.socket) -> None:
        thread = threading.Thread(target=self._serve, args=(sock,), daemon=True)
        before = threading.stack_size(STACK)
        try:
            thread.start()
            self._open[thread] = sock
        except RuntimeError:  # If there is not enough memory for another thread, the connection is closed.
            sock.close()
        finally:
            threading.stack_size(before)

    def _serve(self, sock: socket.socket) -> None:
        """Execute the calls on one connection until it is closed, or until a line violates the protocol."""
        channel = JsonChannel(sock, LIMIT)
        try:
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            key = str(channel.receive(KEY_TIMEOUT).get("key")).encode("utf-8", "replace")
            while hmac.compare_digest(key, self._key.encode()):
                channel.send(self._reply(channel.receive()), SEND_TIMEOUT)
        except (ChannelError, OSError):
            pass  # The connection is closed below, and the kernel then raises an error.
        finally:
            channel.close()
            with self._lock:
                self._open.pop(threading.current_thread(), None)

    def _reply(self, request: Mapping[str, Json]) -> dict[str, Json]:
        """Return the reply to one line; raise ChannelBroken for a line that a proxy never sends."""
        number, do, name = request.get("object"), request.get("do"), request.get("name")
        args, kwargs = request.get("args", []), request.get("kwargs", {})
        with self._lock:
            self._calls += 1
            if self._calls > CALLS or type(number) is not int or not 0 <= number < len(self._objects):
                raise ChannelBroken("too many calls, or an object that was not placed")
            item = self._objects[number]
        if not isinstance(name, str) or not isinstance(args, list) or not isinstance(kwargs, dict):
            raise ChannelBroken("a line that no proxy sends")
        try:
            result = _done(item, self._interface(item), str(do), name, args, kwargs)
        except ChannelBroken:
            raise
        except Exception as error:  # noqa: BLE001 -- the caller in the kernel gets this error
            return {"error": {"type": type(error).__name__, "text": str(error)[:LONGEST]}}
        if self._interface(result):
            return {"placed": self._described(result)}
        return {"value": plain(result)}


def _done(
    item: object, names: Interface, do: str, name: str, args: list[Json], kwargs: dict[str, Json]
) -> object:
    """Execute the request `do` ("call", "get" or "set") for the name `name`, which must be a remote name."""
    if do == "call" and name in names.methods:
        return getattr(item, name)(*args, **kwargs)
    if do == "get" and name in names.readable:
        return getattr(item, name)
    if do == "set" and name in names.writable and len(args) == 1:
        setattr(item, name, args[0])
        return None
    raise ChannelBroken(f"{type(item).__name__} has no remote method or attribute {name[:40]!r}")
