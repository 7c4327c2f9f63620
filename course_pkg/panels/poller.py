"""A thread that reads a value again and again, and reports it when it has changed."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Value = TypeVar("Value")


class Poller(Generic[Value]):
    """Calls `read` every `every` s on a thread of its own, from start() to stop().

    `changed` gets a value that differs from the one before, `failed` an error whose text differs. Both run
    on the thread.
    """

    def __init__(
        self,
        read: Callable[[], Value],
        changed: Callable[[Value], None],
        failed: Callable[[Exception], None],
        *,
        every: float = 1.0,
    ) -> None:
        self._read = read
        self._changed = changed
        self._failed = failed
        self._every = every
        self._stop: threading.Event | None = None

    def start(self) -> None:
        """Begin to poll; a second start changes nothing."""
        if self._stop is None:
            self._stop = threading.Event()
            thread = threading.Thread(target=self._poll, args=(self._stop,), daemon=True, name="panel-poller")
            thread.start()

    def stop(self) -> None:
        """End the thread after at most one read. Do not wait: the caller may hold a lock that it needs."""
        if self._stop is not None:
            self._stop.set()
            self._stop = None

    def once(self) -> None:
        """Read now, on this thread."""
        self._read_and_report(None, threading.Event())

    def _poll(self, stop: threading.Event) -> None:
        before: Value | str | None = None
        while not stop.is_set():
            before = self._read_and_report(before, stop)
            stop.wait(self._every)

    def _read_and_report(self, before: Value | str | None, stop: threading.Event) -> Value | str:
        now: Value | str
        try:
            now = self._read()
            if now != before and not stop.is_set():
                self._changed(now)
        except Exception as error:  # noqa: BLE001 - the thread must go on: its owner shows the error
            now = f"{type(error).__name__}: {error}"
            if now != before and not stop.is_set():
                self._failed(error)
        return now
