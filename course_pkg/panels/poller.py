"""A thread that reads a value repeatedly, and reports each change."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Value = TypeVar("Value")


class Poller(Generic[Value]):
    """Calls the function `read` repeatedly on a separate thread, from start() to stop().

    `every` is the time in s between two calls.

    The poller calls the function `changed` with each value that differs from the previous value. If `read`
    raises an error, the poller calls the function `failed` with this error. It does not call `failed` again
    while `read` raises errors with the same text. After start(), `read`, `changed` and `failed` run on the
    separate thread.
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
        """Start the thread, unless the thread is already running."""
        if self._stop is None:
            self._stop = threading.Event()
            thread = threading.Thread(target=self._poll, args=(self._stop,), daemon=True, name="panel-poller")
            thread.start()

    def stop(self) -> None:
        """Tell the thread to stop; the thread may call the function `read` once more.

        The method does not wait for the end of the thread, because `read` may need a lock that the caller has
        acquired.
        """
        if self._stop is not None:
            self._stop.set()
            self._stop = None

    def once(self) -> None:
        """Call the function `read` once on the calling thread, and report the value."""
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
