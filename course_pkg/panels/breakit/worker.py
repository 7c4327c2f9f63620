"""A thread for the panel's long jobs, such as causing a fault."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable


class Worker:
    """Runs jobs one after another on a thread; the thread ends when the queue is empty.

    If a job raises an error, the thread calls the function `failed` with this error.
    """

    def __init__(self, failed: Callable[[Exception], None]) -> None:
        self._failed = failed
        self._jobs: deque[Callable[[], None]] = deque()
        self._turn = threading.Lock()
        self._thread: threading.Thread | None = None

    def do(self, job: Callable[[], None]) -> None:
        """Add a job to the queue, and return at once."""
        with self._turn:
            self._jobs.append(job)
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, daemon=True, name="lab-worker")
                self._thread.start()

    def drop(self) -> None:
        """Remove from the queue all jobs that have not started yet."""
        with self._turn:
            self._jobs.clear()

    def finish(self, timeout: float) -> bool:
        """Wait until all jobs are done, for at most `timeout` s; return whether all jobs are done."""
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
            except Exception as error:  # noqa: BLE001 -- the thread must continue: its owner shows the error
                self._failed(error)
