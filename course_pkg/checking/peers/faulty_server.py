"""A server of a check: it executes a list of planned faults, such as a crash with a later restart.

A client cannot distinguish a planned fault from a real fault. A suspended process accepts connections but
does not respond. After a kill, the server's registration remains at the master, but its port is closed. A
restarted process has a new address.
"""

from __future__ import annotations

import socket
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import cast

from course_pkg.checking.peers.node import Node
from course_pkg.checking.peers.scripted_server import Act, Late, ScriptedServer, send_error
from course_pkg.checking.plain_values import Message, ServiceClass, Value
from course_pkg.errors import GraphError

# A function of this type returns the fields of the response to a request.
Work = Callable[[Message], Mapping[str, Value]]


@dataclass(frozen=True)
class Stumble:
    """Respond with the error message that rospy sends when a handler raises an unexpected exception."""

    reason: str


@dataclass(frozen=True)
class Frozen:
    """Accept the connection, but do not respond, like a process after SIGSTOP."""


@dataclass(frozen=True)
class Crash:
    """End without a response; later, serve again at another address.

    `back` is the time in s until the server serves again.

    The server's registration remains at the master, as after a SIGKILL. If `unregisters` is true, the server
    first unregisters, like a process that ends normally.
    """

    back: float
    unregisters: bool = False


@dataclass(frozen=True)
class Fault:
    """The fault of one call; if `worked` is true, the server calls `work` before the fault."""

    what: Act | Stumble | Frozen | Crash
    worked: bool = False


class FaultyServer(ScriptedServer):
    """For each request, calls the function `work`, or executes the next fault in the list `plan`."""

    def __init__(self, node: Node, name: str, kind: ServiceClass, work: Work) -> None:
        super().__init__(node, name, kind, self._scripted)
        self.plan: deque[Fault] = deque()
        # The times of all requests and of all connections with a Frozen fault, from time.monotonic().
        self.arrivals: list[float] = []
        self._work = work
        self._plan_lock = threading.Lock()
        # A thread holds this lock while it registers or unregisters an address.
        self._registering = threading.RLock()
        self._restarts: list[threading.Timer] = []

    def leave(self) -> None:
        """Stop serving, and cancel a restart."""
        with self._registering:
            for timer in self._restarts:
                timer.cancel()
            super().leave()

    def _scripted(self, request: Message) -> Act:
        fault = self._arrived()
        response = self._work(request) if fault is None or fault.worked else {}
        if fault is None:
            return response
        if isinstance(fault.what, Late):
            return Late(fault.what.delay, response)
        return cast(Act, fault.what)  # _act() also executes faults of other types than Act.

    def _arrived(self, *, frozen: bool = False) -> Fault | None:
        """Record the time of a call, and remove the fault of this call from the plan.

        If `frozen` is true and the next fault is not Frozen, do nothing. A Frozen fault occurs in the
        handshake, before the request. All other faults occur after the request.
        """
        with self._plan_lock:
            due = bool(self.plan) and (not frozen or isinstance(self.plan[0].what, Frozen))
            if due or not frozen:
                self.arrivals.append(time.monotonic())
            return self.plan.popleft() if due else None

    def _greet(self, sock: socket.socket, header: Mapping[str, str]) -> bool:
        """Reply to the handshake if the next fault is not Frozen.

        A probe, such as the probe of rosservice, does not use a planned fault; the next real call gets it.
        """
        if header.get("probe") == "1":
            with self._plan_lock:
                frozen = bool(self.plan) and isinstance(self.plan[0].what, Frozen)
            return not frozen and super()._greet(sock, header)
        if self._arrived(frozen=True) is None:
            return super()._greet(sock, header)
        self._over.wait()
        return False

    def _act(self, sock: socket.socket, act: Act) -> bool:
        if isinstance(act, Stumble):
            send_error(sock, f"error processing request: {act.reason}")
            return True
        if isinstance(act, Crash):
            self._crash(act)
            return False
        return super()._act(sock, act)

    def _crash(self, crash: Crash) -> None:
        with self._registering, suppress(GraphError):
            if self._over.is_set():
                return
            self._close_port()
            if crash.unregisters:
                self._node.master.unregister_service(self._node.name, self._name, self._uri)
            self._restarts.append(threading.Timer(crash.back, self._restart))
            self._restarts[-1].daemon = True
            self._restarts[-1].start()

    def _restart(self) -> None:
        """Serve again at another address, as a restarted program does."""
        with self._registering, suppress(GraphError):
            if self._over.is_set():
                return
            self._listener = socket.create_server(("127.0.0.1", 0))
            self._uri = f"rosrpc://localhost:{self._listener.getsockname()[1]}"
            threading.Thread(target=self._accept, daemon=True).start()
            self._node.register(self._name, self._uri)
