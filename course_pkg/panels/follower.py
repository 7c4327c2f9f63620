"""A thread that looks at something again and again and tells of it only when it changed."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Sight = TypeVar("Sight")


class Follower(Generic[Sight]):
    """Calls `look` every `every` s on a thread of its own, from start() to stop().

    `seen` gets a sight that differs from the one before, `failed` an error whose text differs.
    Both run on the thread.
    """

    def __init__(
        self,
        look: Callable[[], Sight],
        seen: Callable[[Sight], None],
        failed: Callable[[Exception], None],
        *,
        every: float = 1.0,
    ) -> None:
        self._look = look
        self._seen = seen
        self._failed = failed
        self._every = every
        self._stop: threading.Event | None = None

    def start(self) -> None:
        """Begin to follow; a second start changes nothing."""
        if self._stop is None:
            self._stop = threading.Event()
            thread = threading.Thread(
                target=self._follow, args=(self._stop,), daemon=True, name="panel-follower"
            )
            thread.start()

    def stop(self) -> None:
        """End the thread within one look, without waiting: the caller may hold what the thread waits for."""
        if self._stop is not None:
            self._stop.set()
            self._stop = None

    def once(self) -> None:
        """Look now, on this thread."""
        self._look_and_tell(None, threading.Event())

    def _follow(self, stop: threading.Event) -> None:
        before: Sight | str | None = None
        while not stop.is_set():
            before = self._look_and_tell(before, stop)
            stop.wait(self._every)

    def _look_and_tell(self, before: Sight | str | None, stop: threading.Event) -> Sight | str:
        sight: Sight | str
        try:
            sight = self._look()
            if sight != before and not stop.is_set():
                self._seen(sight)
        except Exception as error:  # noqa: BLE001 - a thread must not die in silence: its owner shows the error
            sight = f"{type(error).__name__}: {error}"
            if sight != before and not stop.is_set():
                self._failed(error)
        return sight
