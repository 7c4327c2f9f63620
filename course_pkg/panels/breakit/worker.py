"""A thread for the jobs of the lab, such as causing a fault, which take longer than a page may wait."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable


class Worker:
    """Does jobs in their order on a thread, which exists only while there are jobs.

    `failed` gets the error of a job, on that thread.
    """

    def __init__(self, failed: Callable[[Exception], None]) -> None:
        self._failed = failed
        self._jobs: deque[Callable[[], None]] = deque()
        self._turn = threading.Lock()
        self._thread: threading.Thread | None = None

    def do(self, job: Callable[[], None]) -> None:
        """Do `job` after the jobs before it; return at once."""
        with self._turn:
            self._jobs.append(job)
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, daemon=True, name="lab-worker")
                self._thread.start()

    def drop(self) -> None:
        """Drop the jobs that have not begun."""
        with self._turn:
            self._jobs.clear()

    def finish(self, timeout: float) -> bool:
        """Wait until there are no jobs, at most `timeout` s; return whether there are none."""
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
            except Exception as error:  # noqa: BLE001 -- the thread must go on: its owner shows the error
                self._failed(error)
