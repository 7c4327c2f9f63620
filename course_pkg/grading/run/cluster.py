"""Uses the dask cluster of `course grade --scheduler`: waits for workers, and detects their loss."""

from __future__ import annotations

import logging
import sys
import time
from collections.abc import Iterator
from concurrent.futures import CancelledError, Executor
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from course_pkg.errors import GradingError

if TYPE_CHECKING:
    from distributed import Client

PATIENCE = 20.0  # A scheduler must respond, and a worker must connect, within this time in s.
# Every `INTERVAL` s, the run tests again whether the cluster still has workers.
INTERVAL = 1.0
AGAIN = "The finished grades are saved. Correct the problem above, and type the same command again."


class Cluster:
    """An executor that uses a dask cluster, and the number of threads in the cluster."""

    def __init__(self, client: Client, executor: Executor, scheduler: str, patience: float) -> None:
        self._client, self._scheduler, self._patience = client, scheduler, patience
        self._seen = time.monotonic()
        self.executor = executor
        self.workers = max(1, sum(client.ncores().values()))

    def require(self) -> None:
        """Raise GradingError if the scheduler has ended, or if no worker has connected in time.

        The maximum time without a worker is `patience` (s).
        """
        if self._client.status != "running":
            raise self._lost()
        if self._client.scheduler_info(n_workers=-1)["workers"]:
            self._seen = time.monotonic()
        elif time.monotonic() - self._seen > self._patience:
            raise no_workers(self._scheduler, self._patience)

    @property
    def failures(self) -> tuple[type[BaseException], ...]:
        """The types of exceptions that dask raises if the cluster cannot run a task."""
        from distributed.scheduler import KilledWorker

        return CancelledError, KilledWorker, ImportError, RuntimeError

    def explained(self, error: BaseException) -> GradingError:
        """Return an error that explains dask's exception `error`, and says what the user can do."""
        if isinstance(error, CancelledError):
            return self._lost()
        if isinstance(error, (ImportError, RuntimeError)):
            return GradingError(
                f"The dask workers cannot run the course ({type(error).__name__}: {error}). Start the "
                "scheduler and the workers with `./course run dask …`, and use the same version of the "
                f"course. {AGAIN}"
            )
        return GradingError(
            "Several dask workers ended while they graded the same notebook. Read the workers' "
            "output: the usual cause is too little memory. Start fewer workers, and give each worker "
            f"--nthreads 1. {AGAIN}"
        )

    def _lost(self) -> GradingError:
        return GradingError(
            f"The connection to the dask scheduler at {self._scheduler} was lost during the run. "
            f"Check that the scheduler is running and that this machine can reach it. {AGAIN}"
        )


def no_workers(scheduler: str, patience: float) -> GradingError:
    """Return the error for a scheduler without workers."""
    return GradingError(
        f"The dask scheduler at {scheduler} has had no worker for {patience:g} s, so nothing can be graded. "
        f"Start workers with this command: ./course run dask worker {scheduler} --nthreads 1 --nworkers 4. "
        "Then type your command again."
    )


@contextmanager
def cluster_of(scheduler: str, patience: float = PATIENCE) -> Iterator[Cluster]:
    """Yield the cluster at the address `scheduler`, such as tcp://192.0.2.7:8786.

    Raises GradingError if dask.distributed is not installed, if no scheduler answers within `patience` s, or
    if the scheduler gets no worker within `patience` s.
    """
    try:
        from distributed import Client
    except ImportError as error:
        raise GradingError(
            "--scheduler needs dask.distributed, which is not installed on this computer. Type: "
            "./course run python -m pip install distributed"
        ) from error
    _silence()
    try:
        client = Client(scheduler, timeout=patience)
    except (OSError, ValueError, TimeoutError) as error:
        raise GradingError(
            f"No dask scheduler answers at {scheduler}: {error}. Start a scheduler with: "
            "./course run dask scheduler"
        ) from error
    try:
        if not client.ncores():
            sys.stderr.write(
                f"The dask scheduler has no worker yet. The run waits {patience:g} s for a worker.\n"
            )
        try:
            client.wait_for_workers(1, timeout=patience)
        except (TimeoutError, OSError) as error:
            raise no_workers(scheduler, patience) from error
        yield Cluster(client, client.get_executor(pure=False), scheduler, patience)
    finally:
        # Without this timeout, close() would wait for a scheduler that has ended.
        with suppress(OSError, TimeoutError):
            client.close(timeout=1)


def _silence() -> None:
    """Hide dask's own messages about lost connections, because the run prints its own message."""
    for name in ("distributed.client", "distributed.comm", "distributed.core"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
