"""One thing after the other, off the thread that asks for it."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable


class Worker:
    """Does jobs in their order on a thread that is there only while there are any.

    `failed` hears of an error of a job, on that thread.
    """

    def __init__(self, failed: Callable[[Exception], None]) -> None:
        self._failed = failed
        self._jobs: deque[Callable[[], None]] = deque()
        self._turn = threading.Lock()
        self._thread: threading.Thread | None = None

    def do(self, job: Callable[[], None]) -> None:
        """Have `job` done, after those that were asked for before, and return at once."""
        with self._turn:
            self._jobs.append(job)
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, daemon=True, name="lab-worker")
                self._thread.start()

    def drop(self) -> None:
        """Forget the jobs that have not begun."""
        with self._turn:
            self._jobs.clear()

    def finish(self, timeout: float) -> bool:
        """Wait until there is nothing left to do, at most `timeout` s; return whether that is so."""
        thread = self._thread
        if thread is not None and thread is not threading.current_thread():
            thread.join(timeout)
        return self._thread is None

    def _next(self) -> Callable[[], None] | None:
        with self._turn:
            if not self._jobs:
                self._thread = None
                return None
            return self._jobs.popleft()

    def _work(self) -> None:
        while (job := self._next()) is not None:
            try:
                job()
            except Exception as error:  # noqa: BLE001 -- a thread must not die in silence: its owner shows it
                self._failed(error)
