"""A thread that reads a value repeatedly, and reports the value when it has changed."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Value = TypeVar("Value")


class Poller(Generic[Value]):
    """Calls `read` every `every` s on its own thread, between start() and stop().

    `changed` is called with each value that differs from the previous one. `failed` is called with an error
    if its text differs from the previous error's text. The poller's thread makes both calls.
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
        """Start to poll; a second call changes nothing."""
        if self._stop is None:
            self._stop = threading.Event()
            thread = threading.Thread(target=self._poll, args=(self._stop,), daemon=True, name="panel-poller")
            thread.start()

    def stop(self) -> None:
        """Stop the thread after at most one more read.

        This does not wait for the thread, because `read` may need a lock that the caller holds.
        """
        if self._stop is not None:
            self._stop.set()
            self._stop = None

    def once(self) -> None:
        """Read once on the calling thread, and report the value."""
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
        except Exception as error:  # noqa: BLE001 - the thread must continue: its owner shows the error
            now = f"{type(error).__name__}: {error}"
            if now != before and not stop.is_set():
                self._failed(error)
        return now
