"""Wards side by side: an answer mostly waits, for nodes to start and for messages to come."""

from __future__ import annotations

import os
import threading
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType

from course_pkg.grading.walls import refusal
from course_pkg.grading.ward.job import PartJob, PartOutcome
from course_pkg.grading.wards import Ward


class Lanes:
    """Runs the jobs of a list ahead of whoever asks for their outcomes, in order; a context manager."""

    def __init__(self, jobs: Sequence[PartJob], count: int = 0) -> None:
        self._jobs = list(jobs)
        self._places = {job: number for number, job in enumerate(self._jobs)}
        self._count = count or os.cpu_count() or 1
        self._begun: dict[int, Future[PartOutcome]] = {}
        self._pool = ThreadPoolExecutor(self._count)
        self._own = threading.local()
        self._wards: list[Ward] = []

    def __enter__(self) -> Lanes:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._pool.shutdown(cancel_futures=True)
        for ward in self._wards:
            ward.close()

    def outcome(self, job: PartJob) -> PartOutcome:
        """Return how `job` ended; the next ones of the list begin meanwhile."""
        first = self._places[job]
        for number in range(first, min(first + self._count, len(self._jobs))):
            if number not in self._begun:
                self._begun[number] = self._pool.submit(self._run, self._jobs[number])
        return self._begun[first].result()

    def _run(self, job: PartJob) -> PartOutcome:
        if not hasattr(self._own, "ward"):  # it ends with the thread that began it
            self._own.ward = Ward(walls=not refusal())
            self._wards.append(self._own.ward)
        ward: Ward = self._own.ward
        return ward.run(job)
