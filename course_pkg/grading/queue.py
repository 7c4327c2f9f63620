"""Grades many submissions in parallel, in threads of this machine or in workers of a dask cluster.

Threads and clusters use the same code, because both have the interface of concurrent.futures.Executor. A task
and its result consist of plain data, which can be sent to another machine.
"""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    Executor,
    Future,
    ThreadPoolExecutor,
    wait,
)
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

from course_pkg.checking.parts import chapters
from course_pkg.grading.extras import read_extras
from course_pkg.grading.grade import Grade, Submission, grade_from
from course_pkg.grading.marking import mark
from course_pkg.grading.nbval.validation import validated, wanted
from course_pkg.grading.plan import Plan, plan
from course_pkg.grading.rebuild.rebuilder import Rebuilder
from course_pkg.grading.run.cluster import INTERVAL, Cluster, cluster_of
from course_pkg.sandbox.worker_client import SandboxWorker

AHEAD = 2  # At most this many tasks per worker are submitted at the same time, to save memory.


@dataclass(frozen=True)
class Task:
    """One submission, and the options with which it is graded."""

    submission: Submission
    secret: str
    key: str
    sandboxed: bool
    private: str = ""  # `private` is the path of an instructor's private folder, or "".
    # nbval runs the notebook if `validate` is "all", or if `validate` is "missing" and the notebook does not
    # have all points.
    validate: str = "none"
    # `parts` contains the parts that are graded; an empty tuple means all parts. If parts are selected, nbval
    # does not run.
    parts: tuple[str, ...] = ()

    def grade(self) -> dict[str, Any]:
        """Grade the submission in this process, with the sandbox worker of this thread."""
        tools = _tools(os.getpid(), threading.get_ident(), self.sandboxed, self.private)
        _declare(os.getpid(), self.private)
        planned = _plan(self.submission.chapter)
        if self.parts:
            planned = replace(
                planned, parts=tuple(each for each in planned.parts if each.part.check in self.parts)
            )
        grade = mark(self.submission, planned, tools.run, self.secret, self.key, sandboxed=self.sandboxed)
        if self.submission.content and not self.parts and wanted(grade, self.validate):
            grade = validated(grade, self.submission, planned)
        return grade.as_dict()


@dataclass(frozen=True)
class Pool:
    """An executor and the number of its workers; `cluster` is None if the workers are threads."""

    executor: Executor
    workers: int
    cluster: Cluster | None = None


def grade_all(tasks: Iterable[Task], pool: Pool) -> Iterator[tuple[Task, Grade]]:
    """Yield each task with its grade as soon as the grade is ready.

    Raises GradingError if the cluster has ended.
    """
    todo, under_way = deque(tasks), dict[Future[dict[str, Any]], Task]()
    while todo or under_way:
        while todo and len(under_way) < pool.workers * AHEAD:
            task = todo.popleft()
            under_way[pool.executor.submit(Task.grade, task)] = task
        done, _ = wait(under_way, INTERVAL, return_when=FIRST_COMPLETED)
        yield from ((under_way.pop(future), _result(future, pool.cluster)) for future in done)
        if pool.cluster and not done:
            pool.cluster.require()


def _result(future: Future[dict[str, Any]], cluster: Cluster | None) -> Grade:
    if cluster is None:
        return grade_from(future.result())
    try:
        return grade_from(future.result())
    except cluster.failures as error:
        raise cluster.explained(error) from error


@contextmanager
def pool_of(scheduler: str, jobs: int) -> Iterator[Pool]:
    """Yield a pool of threads in this process, or of workers of the dask cluster at the address `scheduler`.

    `jobs` is the number of threads or workers to use; for a cluster, 0 means all workers.
    """
    if scheduler:
        with cluster_of(scheduler) as cluster:
            yield Pool(cluster.executor, jobs or cluster.workers, cluster)
        return
    with ThreadPoolExecutor(jobs, thread_name_prefix="grading") as threads:
        yield Pool(threads, jobs)


@cache
def _tools(_pid: int, _thread: int, sandboxed: bool, private: str) -> SandboxWorker:
    """Return the sandbox worker of this thread; each thread has a separate worker."""
    return SandboxWorker(sandboxed=sandboxed, private=private)


@cache
def _declare(_pid: int, private: str) -> None:
    """Add the private parts to the course in this process."""
    read_extras(Path(private) if private else None)


@cache
def _plan(chapter: str) -> Plan:
    return (
        plan(chapter) if chapter in chapters() else Plan(chapter, Rebuilder({"cells": []}), ())
    )  # A submission with a problem has no parts to examine.
