"""The master, asked in bounded time; http://wiki.ros.org/ROS/Master_API, XML-RPC over HTTP/1.1."""

from __future__ import annotations

import os
import socket
import time
import weakref
from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from http.client import HTTPConnection, HTTPException
from typing import Any
from urllib.parse import urlsplit
from xml.parsers.expat import ExpatError
from xmlrpc.client import Fault, dumps, loads

from course_pkg.errors import GraphError, MalformedMasterUri, MasterSilent, MasterUnreachable, NotAMaster

Addresses = dict[str, str]  # of nodes or services, by name
Registered = Mapping[str, tuple[str, ...]]  # a topic or service -> the nodes that have it
STALE = (ConnectionResetError, ConnectionAbortedError, BrokenPipeError, HTTPException)  # of a kept connection


@dataclass(frozen=True)
class SystemState:
    """Who publishes, subscribes and serves what, as the master has it."""

    publishers: Registered
    subscribers: Registered
    services: Registered

    @property
    def nodes(self) -> tuple[str, ...]:
        """The names of all nodes that have registered anything, sorted."""
        kinds = (self.publishers, self.subscribers, self.services)
        return tuple(sorted({node for kind in kinds for nodes in kind.values() for node in nodes}))


class MasterClient:
    """Asks the master at `uri`; each question takes at most `timeout` s. Threads may share it."""

    def __init__(self, uri: str, timeout: float = 2.0, caller: str = "/course") -> None:
        self.uri = uri
        self.timeout = timeout
        self.caller = caller
        self._address = address_of(uri)
        self._idle: deque[_Connection] = deque()
        weakref.finalize(self, _close, self._idle)

    def pid(self, timeout: float | None = None) -> int:
        """Return the master's process id: the cheapest way to ask whether it is there."""
        return int(self._value("getPid", timeout=timeout))

    def lookup_service(self, name: str, timeout: float | None = None) -> str | None:
        """Return the rosrpc:// address of a service by its full name, or None when nobody serves it."""
        return self._found("lookupService", name, timeout=timeout)

    def lookup_node(self, name: str, timeout: float | None = None) -> str | None:
        """Return the http:// address of a node, or None when the master does not know it."""
        return self._found("lookupNode", name, timeout=timeout)

    def lookup_all(self, nodes: Iterable[str], services: Iterable[str]) -> tuple[Addresses, Addresses]:
        """Return the addresses of nodes and of services in one question; what is unknown is left out."""
        asked = [("lookupNode", name) for name in nodes] + [("lookupService", name) for name in services]
        if not asked:
            return {}, {}
        calls = [{"methodName": method, "params": [self.caller, name]} for method, name in asked]
        answers = self._ask("system.multicall", (calls,))
        found: dict[str, dict[str, str]] = {"lookupNode": {}, "lookupService": {}}
        for (method, name), answer in zip(asked, answers, strict=True):
            if isinstance(answer, list) and answer[0][0] == 1:
                found[method][name] = str(answer[0][2])
        return found["lookupNode"], found["lookupService"]

    def system_state(self) -> SystemState:
        """Return what is registered."""
        kinds = self._value("getSystemState")
        return SystemState(*({name: tuple(sorted(nodes)) for name, nodes in sorted(kind)} for kind in kinds))

    def topic_types(self) -> dict[str, str]:
        """Return the type of every topic that has had a publisher or a subscriber of a definite type."""
        return {str(topic): str(kind) for topic, kind in self._value("getTopicTypes")}

    def get_param(self, name: str, default: Any = None) -> Any:  # noqa: ANN401 -- a parameter is of any type
        """Return a parameter, or `default` when it is not set."""
        code, _, value = self._ask("getParam", (self.caller, name))
        return value if code == 1 else default

    def set_param(self, name: str, value: str, timeout: float | None = None) -> bool:
        """Set a parameter; say whether the master took it."""
        return bool(self._ask("setParam", (self.caller, name, value), timeout)[0] == 1)

    def delete_param(self, name: str, timeout: float | None = None) -> bool:
        """Delete a parameter; say whether it was there."""
        return bool(self._ask("deleteParam", (self.caller, name), timeout)[0] == 1)

    def register_service(self, node: str, name: str, uri: str, node_uri: str) -> None:
        """Say that `node` serves `name` at `uri`; who served it before no longer does."""
        self._value("registerService", name, uri, node_uri, caller=node)

    def register_publisher(self, node: str, topic: str, kind: str, node_uri: str) -> None:
        """Say that `node` publishes `topic`."""
        self._value("registerPublisher", topic, kind, node_uri, caller=node)

    def register_subscriber(self, node: str, topic: str, kind: str, node_uri: str) -> list[str]:
        """Say that `node` subscribes to `topic`; return the addresses of its publishers."""
        return list(self._value("registerSubscriber", topic, kind, node_uri, caller=node))

    def unregister_service(self, node: str, name: str, uri: str) -> bool:
        """Withdraw a service, if it is registered at just this address; say whether it was."""
        return bool(self._value("unregisterService", name, uri, caller=node))

    def unregister_publisher(self, node: str, topic: str, node_uri: str) -> bool:
        """Withdraw a publisher, if it is registered for just this node; say whether it was."""
        return bool(self._value("unregisterPublisher", topic, node_uri, caller=node))

    def unregister_subscriber(self, node: str, topic: str, node_uri: str) -> bool:
        """Withdraw a subscriber, if it is registered for just this node; say whether it was."""
        return bool(self._value("unregisterSubscriber", topic, node_uri, caller=node))

    def close(self) -> None:
        """Close the connections that were kept for the next question."""
        _close(self._idle)

    def _found(self, method: str, name: str, timeout: float | None) -> str | None:
        code, _, value = self._ask(method, (self.caller, name), timeout)
        return str(value) if code == 1 else None

    def _value(self, method: str, *args: str, caller: str = "", timeout: float | None = None) -> Any:  # noqa: ANN401
        code, words, value = self._ask(method, (caller or self.caller, *args), timeout)
        if code != 1:
            raise GraphError(f"The master at {self.uri} refused {method}{args}: {words}")
        return value

    def _ask(self, method: str, args: tuple[Any, ...], timeout: float | None = None) -> Any:  # noqa: ANN401
        limit = self.timeout if timeout is None else min(timeout, self.timeout)
        deadline = time.monotonic() + limit
        try:
            answer = self._exchange(dumps(args, method).encode(), deadline)
            return loads(answer)[0][0]
        except TimeoutError as error:
            raise MasterSilent(
                f"The program at {self.uri} takes connections and did not answer within {limit:g} s. If "
                "it is the master, it hangs or is stopped (SIGSTOP): let it go on, or end it and start anew."
            ) from error
        except OSError as error:
            raise MasterUnreachable(
                f"No ROS master at {self.uri} ({error.strerror or error}). A notebook's own master comes "
                "back when the set-up cell with join() is run again; a shared one has to be started again: "
                f"`roscore -p {self._address[1]}`. If the master is elsewhere, correct ROS_MASTER_URI."
            ) from error
        except (HTTPException, ExpatError, Fault, LookupError, TypeError, ValueError) as error:
            raise NotAMaster(
                f"What answers at {self.uri} is not a ROS master ({type(error).__name__}: {error}). Correct "
                "ROS_MASTER_URI, or unset it to have a master of your own."
            ) from error

    def _exchange(self, body: bytes, deadline: float) -> bytes:
        """Send a question over a kept connection, or a new one when there is none or it has gone stale."""
        while self._idle:
            connection = self._idle.pop()
            if connection.pid != os.getpid():
                continue  # inherited by a fork: the parent is using it
            try:
                return self._over(connection, body, deadline)
            except STALE:
                continue
        return self._over(_Connection(self._address), body, deadline)

    def _over(self, connection: _Connection, body: bytes, deadline: float) -> bytes:
        answer = None
        try:
            answer = connection.exchange(body, deadline)
        finally:
            if answer is None:
                connection.close()
        self._idle.append(connection)
        return answer


def _close(connections: deque[_Connection]) -> None:
    while connections:
        connections.pop().close()


class _Connection(HTTPConnection):
    """An HTTP connection with a deadline for a whole exchange, however slowly the bytes drip."""

    sock: _DeadlineSocket | None

    def __init__(self, address: tuple[str, int]) -> None:
        super().__init__(*address)
        self.pid = os.getpid()
        self._deadline = 0.0

    def connect(self) -> None:
        """Connect before the deadline."""
        limit = max(self._deadline - time.monotonic(), 0.001)
        plain = socket.create_connection((self.host, self.port), limit)
        plain.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.sock = _DeadlineSocket(fileno=plain.detach())

    def exchange(self, body: bytes, deadline: float) -> bytes:
        """Send a request and return the body of the answer."""
        self._deadline = deadline
        if self.sock is None:
            self.connect()
        assert self.sock is not None
        self.sock.deadline = deadline
        self.request("POST", "/RPC2", body, {"Content-Type": "text/xml"})
        response = self.getresponse()
        answer = response.read()
        if response.status != 200:
            raise HTTPException(f"{response.status} {response.reason}")
        return answer


class _DeadlineSocket(socket.socket):
    """A socket whose every operation ends at `deadline`, a time of time.monotonic()."""

    deadline = 0.0

    def recv_into(self, *args: Any, **kwargs: Any) -> int:  # noqa: ANN401
        """Receive before the deadline."""
        self.settimeout(max(self.deadline - time.monotonic(), 0.001))
        return super().recv_into(*args, **kwargs)

    def sendall(self, *args: Any, **kwargs: Any) -> None:  # noqa: ANN401
        """Send before the deadline."""
        self.settimeout(max(self.deadline - time.monotonic(), 0.001))
        super().sendall(*args, **kwargs)


def address_of(uri: str) -> tuple[str, int]:
    """Return host and port of a master's URI; raises MalformedMasterUri."""
    try:
        parts = urlsplit(uri)
        if parts.scheme == "http" and parts.hostname and parts.port:
            return parts.hostname, parts.port
    except ValueError:
        pass  # a port that is no number, or a bracket that is not closed
    raise MalformedMasterUri(
        f"ROS_MASTER_URI is {uri!r}, and has to be of the form http://HOST:PORT, such as "
        "http://localhost:11311. Correct it, or unset it to have a master of your own."
    )
