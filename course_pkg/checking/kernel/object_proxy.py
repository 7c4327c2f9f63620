"""Proxies in the kernel for objects of the check runner (see checking/placed).

A proxy stores no data. A proxy sends each call of a method, and each read or write of an attribute, to the
check runner, and waits for the reply.
"""

from __future__ import annotations

import builtins
import os
import socket
import threading
import weakref
from collections.abc import Callable
from functools import partial
from typing import Any

from course_pkg.checking.placed.host import LIMIT
from course_pkg.checking.plain_values import Value, plain
from course_pkg.errors import ChannelClosed, ChannelError
from course_pkg.ros.protocol.json_channel import Json, JsonChannel

CONNECT_TIMEOUT = 10.0  # A connection to the check runner has to be open within this time in s.
OVER = "this object belongs to a check that has ended"

Ask = Callable[..., Value]


class ObjectProxies:
    """Creates proxies; each thread that uses a proxy has its own connection to the check runner."""

    def __init__(self, port: int, key: str) -> None:
        self.port = port
        self._key = key
        self._made: dict[int, Value] = {}
        self._errors: dict[str, type[Exception]] = {}
        self._own = threading.local()
        self._connections: weakref.WeakSet[_Connection] = weakref.WeakSet()
        self._lock = threading.Lock()
        self._closed = False

    def proxy(self, item: dict[str, Any]) -> Value:
        """Return the proxy for the object that `item` describes; each object has only one proxy."""
        number = item["number"]
        with self._lock:
            if number not in self._made:
                self._made[number] = _class_of(item)(partial(self._ask, number))
            return self._made[number]

    def close(self) -> None:
        """Close all connections; after this, each use of a proxy raises ConnectionError."""
        with self._lock:
            self._closed = True
            left = list(self._connections)
        for connection in left:
            connection.close()

    def _ask(self, number: int, do: str, name: str, args: Value = (), kwargs: Value = None) -> Value:
        request = {
            "object": number,
            "do": do,
            "name": name,
            "args": plain(args),
            "kwargs": plain(kwargs or {}),
        }
        try:
            connection = self._connection()
            connection.send(request)
            reply: dict[str, Any] = connection.receive()
        except ChannelError as error:
            self._drop()
            raise ConnectionError(OVER) from error
        except BaseException:
            # If the connection stayed open, a later call would read the reply to the failed call.
            self._drop()
            raise
        if "placed" in reply:
            return self.proxy(reply["placed"])
        if failed := reply.get("error"):
            raise self._error(str(failed["type"]))(failed["text"])
        return reply.get("value")

    def _connection(self) -> _Connection:
        """Return the connection of this thread; the connection is closed when the thread has ended."""
        connection: _Connection | None = getattr(self._own, "connection", None)
        # A forked process opens a new connection; its parent process continues to use the old connection.
        if connection is None or connection.process != os.getpid():
            connection = _Connection(self.port, self._key)
            with self._lock:
                if self._closed:
                    connection.close()
                self._connections.add(connection)
            self._own.connection = connection
        return connection

    def _drop(self) -> None:
        connection: _Connection | None = self._own.__dict__.pop("connection", None)
        if connection is not None:
            connection.close()

    def _error(self, name: str) -> type[Exception]:
        """Return the built-in exception class with this name; if there is none, return a new class."""
        known = getattr(builtins, name, None)
        if isinstance(known, type) and issubclass(known, Exception):
            return known
        return self._errors.setdefault(name, type(name, (Exception,), {}))


class _Connection(JsonChannel):
    def __init__(self, port: int, key: str) -> None:
        try:
            sock = socket.create_connection(("127.0.0.1", port), timeout=CONNECT_TIMEOUT)
        except OSError as error:
            raise ChannelClosed(OVER) from error
        sock.settimeout(None)
        sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        super().__init__(sock, LIMIT)
        self.process = os.getpid()
        self.send({"key": key})

    def __del__(self) -> None:
        if hasattr(self, "_socket"):
            self._socket.close()


def _class_of(item: dict[str, Json]) -> type:
    """Return a class with the same name, methods and attributes as the class of the real object."""
    members: dict[str, Value] = {name: _method(name) for name in _names(item, "methods")}
    writable = set(_names(item, "writable"))
    for name in {*_names(item, "readable"), *writable}:
        members[name] = property(_getter(name), _setter(name) if name in writable else None)
    return type(str(item["kind"]), (_ObjectProxy,), members)


def _names(item: dict[str, Json], key: str) -> list[str]:
    names = item[key]
    return [str(name) for name in names] if isinstance(names, list) else []


class _ObjectProxy:
    def __init__(self, ask: Ask) -> None:
        self._ask = ask


def _method(name: str) -> Callable[..., Value]:
    def method(self: _ObjectProxy, *args: Value, **kwargs: Value) -> Value:
        return self._ask("call", name, args, kwargs)

    method.__name__ = name
    return method


def _getter(name: str) -> Callable[[_ObjectProxy], Value]:
    return lambda self: self._ask("get", name)


def _setter(name: str) -> Callable[[_ObjectProxy, Value], Value]:
    return lambda self, value: self._ask("set", name, (value,))
