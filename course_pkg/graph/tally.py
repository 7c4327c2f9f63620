"""Who called which service of this process, how often, and when last."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass

KEPT = 100  # callers of a service: every run of a command-line tool is a caller with a name of its own


@dataclass
class _Count:
    calls: int = 0
    last: float = 0.0
    running: int = 0


class Tally:
    """Counts requests; threads may share it."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._services: dict[str, dict[str, _Count]] = {}

    def begun(self, service: str, caller: str) -> None:
        """Count a request that has reached its handler."""
        with self._turn:
            callers = self._services.setdefault(service, {})
            counted = callers.pop(caller, None) or _Count()
            counted.calls += 1
            counted.last = time.time()
            counted.running += 1
            callers[caller] = counted  # the latest stands last
            if len(callers) > KEPT:
                self._forget_one(callers)

    def ended(self, service: str, caller: str) -> None:
        """Take note that the handler of a request is through."""
        with self._turn:
            counted = self._services.get(service, {}).get(caller)
            if counted is not None:
                counted.running -= 1

    def callers(self, service: str) -> list[list[object]]:
        """Return [caller, calls, when last (s since the epoch), how many are running], the latest first."""
        with self._turn:
            callers = self._services.get(service, {})
            return [[name, each.calls, each.last, each.running] for name, each in reversed(callers.items())]

    def _forget_one(self, callers: dict[str, _Count]) -> None:
        """Forget who has not called for longest, and is not waiting for an answer."""
        idle = (name for name, each in callers.items() if not each.running)
        callers.pop(next(idle, next(iter(callers))))
