"""Several sandbox workers that work at the same time. An answer often waits for nodes and messages."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType

from course_pkg.sandbox.bubblewrap import refusal
from course_pkg.sandbox.job import PartJob, PartResult
from course_pkg.sandbox.worker_client import SandboxWorker


class WorkerPool:
    """Runs jobs in `count` sandboxes at the same time; a context manager."""

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
        """Add the jobs to the queue that are not in it yet; jobs with long deadlines come first."""
        for job in sorted(jobs, key=lambda each: -each.deadline):
            if job not in self._futures:
                self._futures[job] = self._threads.submit(self._run, job)

    def result(self, job: PartJob) -> PartResult:
        """Wait for the end of `job`, and return its result."""
        self.submit([job])
        return self._futures[job].result()

    def _run(self, job: PartJob) -> PartResult:
        if not hasattr(self._own, "worker"):  # a sandbox worker ends when the thread that started it ends
            self._own.worker = SandboxWorker(sandboxed=self._sandboxed)
            self._workers.append(self._own.worker)
        worker: SandboxWorker = self._own.worker
        return worker.run(job)
