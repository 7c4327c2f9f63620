"""Runs several sandbox workers at the same time."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType

from course_pkg.sandbox.job import PartJob, PartResult
from course_pkg.sandbox.linux.bubblewrap import refusal
from course_pkg.sandbox.worker_client import SandboxWorker


class WorkerPool:
    """A context manager that runs jobs in several sandboxes at the same time."""

    def __init__(self, count: int) -> None:
        self._futures: dict[PartJob, Future[PartResult]] = {}
        self._threads = ThreadPoolExecutor(count)
        self._own = threading.local()
        self._sandboxed = not refusal()
        self._workers: list[SandboxWorker] = []

    def __enter__(self) -> WorkerPool:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._threads.shutdown(cancel_futures=True)
        for worker in self._workers:
            worker.close()

    def submit(self, jobs: Iterable[PartJob]) -> None:
        """Add new jobs to the queue. Jobs with long deadlines run first."""
        for job in sorted(jobs, key=lambda each: -each.deadline):
            if job not in self._futures:
                self._futures[job] = self._threads.submit(self._run, job)

    def result(self, job: PartJob) -> PartResult:
        """Wait until the given job has finished, and return its result."""
        self.submit([job])
        return self._futures[job].result()

    def _run(self, job: PartJob) -> PartResult:
        # Each thread needs a separate worker, because a worker ends when the thread that started the worker
        # ends.
        if not hasattr(self._own, "worker"):
            self._own.worker = SandboxWorker(sandboxed=self._sandboxed)
            self._workers.append(self._own.worker)
        worker: SandboxWorker = self._own.worker
        return worker.run(job)
