"""A server of a check's own that goes wrong as planned, fault by fault, and comes back.

What a client sees of a fault is what it sees of the real one: a stopped process takes connections and says
nothing, a killed one leaves its registration and nobody at the address, a restarted one has a new address.
"""

from __future__ import annotations

import socket
import struct
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import cast

from course_pkg.errors import GraphError
from course_pkg.examiner.node import Node
from course_pkg.examiner.plain import Message, Plain, ServiceClass
from course_pkg.examiner.scripted import Act, HangUp, Late, Refuse, ScriptedServer, Silence

Work = Callable[[Message], Mapping[str, Plain]]  # what the server is for: a request's response, by field


@dataclass(frozen=True)
class Stumble:
    """Answer with an error, worded as rospy words an exception that a handler did not mean to raise."""

    reason: str


@dataclass(frozen=True)
class Frozen:
    """Take the connection and say nothing, as a process does that is stopped by SIGSTOP."""


@dataclass(frozen=True)
class Crash:
    """Be gone without an answer, and be back at another address after `back` s.

    A killed process leaves its registration; one with a `farewell` withdraws it.
    """

    back: float
    farewell: bool = False


@dataclass(frozen=True)
class Fault:
    """What happens to one call; `worked` says that the work is done before it happens."""

    what: Act | Stumble | Frozen | Crash
    worked: bool = False


class FaultyServer(ScriptedServer):
    """Does its `work` for each request, but first what `plan` holds, one fault a call."""

    def __init__(self, node: Node, name: str, kind: ServiceClass, work: Work) -> None:
        super().__init__(node, name, kind, self._scripted)
        self.plan: deque[Fault] = deque()
        self.arrivals: list[float] = []  # of requests and of frozen connections; s of time.monotonic()
        self._work = work
        self._planning = threading.Lock()
        self._moving = threading.RLock()  # of what is registered where
        self._returns: list[threading.Timer] = []

    def leave(self) -> None:
        """Stop serving, for good."""
        with self._moving:
            for timer in self._returns:
                timer.cancel()
            super().leave()

    def _scripted(self, request: Message) -> Act:
        fault = self._arrived()
        response = self._work(request) if fault is None or fault.worked else {}
        if fault is None:
            return response
        if isinstance(fault.what, Late):
            return Late(fault.what.delay, response)
        return cast(Act, fault.what)  # _act knows the others, too

    def _arrived(self, *, frozen: bool = False) -> Fault | None:
        """Take the next fault and note the time; `frozen`: only one that comes before a request."""
        with self._planning:
            due = bool(self.plan) and (not frozen or isinstance(self.plan[0].what, Frozen))
            if due or not frozen:
                self.arrivals.append(time.monotonic())
            return self.plan.popleft() if due else None

    def _greet(self, sock: socket.socket, header: Mapping[str, str]) -> bool:
        """Answer the handshake, unless the plan is to be frozen; who only looks does not use a fault up."""
        if header.get("probe") == "1":
            with self._planning:
                frozen = bool(self.plan) and isinstance(self.plan[0].what, Frozen)
            return not frozen and super()._greet(sock, header)
        if self._arrived(frozen=True) is None:
            return super()._greet(sock, header)
        self._over.wait()
        return False

    def _act(self, sock: socket.socket, act: Act) -> bool:
        if isinstance(act, Stumble):
            words = f"error processing request: {act.reason}".encode()
            sock.sendall(b"\x00" + struct.pack("<I", len(words)) + words)
            return True
        if isinstance(act, Crash):
            self._crash(act)
            return False
        return super()._act(sock, act)

    def _crash(self, crash: Crash) -> None:
        with self._moving, suppress(GraphError):
            if self._over.is_set():
                return
            self._close_port()
            if crash.farewell:
                self._node.master.unregister_service(self._node.name, self._name, self._uri)
            self._returns.append(threading.Timer(crash.back, self._return))
            self._returns[-1].daemon = True
            self._returns[-1].start()

    def _return(self) -> None:
        """Serve again at another address, as a program does that was started again."""
        with self._moving, suppress(GraphError):
            if self._over.is_set():
                return
            self._listener = socket.create_server(("127.0.0.1", 0))
            self._uri = f"rosrpc://localhost:{self._listener.getsockname()[1]}"
            threading.Thread(target=self._accept, daemon=True).start()
            self._node.master.register_service(self._node.name, self._name, self._uri, self._node.uri)


__all__ = [
    "Crash",
    "Fault",
    "FaultyServer",
    "Frozen",
    "HangUp",
    "Late",
    "Refuse",
    "Silence",
    "Stumble",
    "Work",
]
