"""The number of calls of each caller of a service. This module does not import rospy."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass

# At most this many callers are stored for a service. Each run of a command-line tool is a caller with a new
# name.
CALLERS = 100
# The tuple contains the caller, the number of its calls, the time of its latest call (s since the epoch), and
# the number of its running calls.
CallerCount = tuple[str, int, float, int]


@dataclass
class _Count:
    calls: int = 0
    last: float = 0.0
    running: int = 0


class CallCounter:
    """Counts the requests of each service by caller; several threads may share the counter."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._services: dict[str, dict[str, _Count]] = {}

    def begin(self, service: str, caller: str) -> None:
        """Count a request that has reached its handler."""
        with self._lock:
            callers = self._services.setdefault(service, {})
            counted = callers.pop(caller, None) or _Count()
            counted.calls += 1
            counted.last = time.time()
            counted.running += 1
            callers[caller] = counted  # The latest caller is at the end of the dict.
            if len(callers) > CALLERS:
                self._forget_one(callers)

    def end(self, service: str, caller: str) -> None:
        """Record that the handler of a request has ended."""
        with self._lock:
            counted = self._services.get(service, {}).get(caller)
            if counted is not None:
                counted.running -= 1

    def callers(self, service: str) -> list[CallerCount]:
        """Return the callers of a service, the latest first."""
        with self._lock:
            callers = self._services.get(service, {})
            return [(name, each.calls, each.last, each.running) for name, each in reversed(callers.items())]

    def _forget_one(self, callers: dict[str, _Count]) -> None:
        """Delete the caller with the oldest call.

        If possible, delete only a caller that has no running call.
        """
        idle = (name for name, each in callers.items() if not each.running)
        callers.pop(next(idle, next(iter(callers))))
