"""Tests with a dask scheduler that has no workers or ends during the run."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.grade import Submission
from course_pkg.grading.queue import Pool, Task, grade_all
from course_pkg.grading.run.cluster import Cluster, cluster_of
from tests.support import eventually

distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def scheduler(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[subprocess.Popen[bytes], str]]:
    """Start a scheduler without workers, and yield its process and its address."""
    file = tmp_path_factory.mktemp("scheduler") / "scheduler.json"
    words = ["--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(file)]
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", *words]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as process:
        eventually(lambda: _address(file), timeout=60)
        yield process, _address(file)
        process.kill()


def _address(file: Path) -> str:
    try:
        return str(json.loads(file.read_text())["address"])
    except (OSError, ValueError, KeyError):
        return ""


def test_a_scheduler_without_workers(scheduler: tuple[subprocess.Popen[bytes], str]) -> None:
    """If the scheduler has no workers, the error message contains the command that starts workers."""
    _, address = scheduler
    expected = rf"no worker .*\./course run dask worker {address}"
    with pytest.raises(GradingError, match=expected), cluster_of(address, patience=0.5):
        pass


def test_workers_that_end_during_the_run(scheduler: tuple[subprocess.Popen[bytes], str]) -> None:
    """If all workers have ended, the run ends after a time limit."""
    _, address = scheduler
    with distributed.Client(address, timeout=20) as client:
        cluster = Cluster(client, client.get_executor(), address, 0.0)
        with pytest.raises(GradingError, match="no worker"):
            cluster.require()


def test_a_scheduler_that_ends_during_the_run(scheduler: tuple[subprocess.Popen[bytes], str]) -> None:
    """If the scheduler ends, the run ends with one error message."""
    process, address = scheduler

    class Killing(Cluster):
        def require(self) -> None:
            process.kill()
            process.wait(20)

    with distributed.Client(address, timeout=2) as client:
        cluster = Killing(client, client.get_executor(pure=False), address, 20.0)
        task = Task(Submission("s01", "05", b"", "", problem="no notebook"), "secret", "key", False)
        with pytest.raises(GradingError, match=r"connection to the dask scheduler .* lost.*are saved"):
            list(grade_all([task], Pool(cluster.executor, 1, cluster)))
        with pytest.raises(GradingError, match="lost"):
            Cluster.require(cluster)
