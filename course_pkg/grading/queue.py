"""Grade many submissions, a few at a time, in threads of this machine or in workers of a dask cluster.

The code is the same for both: a `Task` (plain data) is submitted to an object with the interface of
concurrent.futures.Executor, and the result is a grade as plain data.
"""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from course_pkg.checking.parts import chapters
from course_pkg.errors import GradingError
from course_pkg.grading.extras import Extras, read_extras
from course_pkg.grading.grade import Grade, Submission, grade_from
from course_pkg.grading.marking import mark
from course_pkg.grading.plan import Plan, plan
from course_pkg.grading.rebuild.rebuilder import Rebuilder
from course_pkg.grading.validation import validated, wanted
from course_pkg.sandbox.worker_client import SandboxWorker

AHEAD = 2  # number of submitted tasks for each running task; this limits the memory that many tasks need


@dataclass(frozen=True)
class Task:
    """One submission, and the options for its grade."""

    submission: Submission
    secret: str
    key: str
    sandboxed: bool
    private: str = ""  # the folder of an instructor's extras
    validate: str = "none"  # the students whose notebooks nbval runs: "all", "missing" points, "none"

    def grade(self) -> dict[str, Any]:
        """Grade the submission in this process, with the sandbox worker of this thread."""
        tools = _tools(os.getpid(), threading.get_ident(), self.sandboxed, self.private)
        planned, extras = _plan(self.submission.chapter), _extras(os.getpid(), self.private)
        grade = mark(
            self.submission, planned, extras, tools.run, self.secret, self.key, sandboxed=self.sandboxed
        )
        if self.submission.content and wanted(grade, self.validate):
            grade = validated(grade, self.submission, planned)
        return grade.as_dict()


def grade_all(tasks: Iterable[Task], executor: Executor, workers: int) -> Iterator[Grade]:
    """Yield the grades of `tasks` when they are ready; at most `workers` tasks run at the same time."""
    todo, under_way = deque(tasks), set[Future[dict[str, Any]]]()
    while todo or under_way:
        while todo and len(under_way) < workers * AHEAD:
            under_way.add(executor.submit(Task.grade, todo.popleft()))
        done, under_way = wait(under_way, return_when=FIRST_COMPLETED)
        yield from (grade_from(future.result()) for future in done)


@contextmanager
def executor_of(scheduler: str, jobs: int) -> Iterator[tuple[Executor, int]]:
    """Yield an executor and its number of workers: threads here, or the cluster of `scheduler`."""
    if not scheduler:
        with ThreadPoolExecutor(jobs, thread_name_prefix="grading") as pool:
            yield pool, jobs
        return
    try:
        from distributed import Client
    except ImportError as error:
        raise GradingError(
            "--scheduler needs dask.distributed, which is not installed here. Type: "
            "./course run python -m pip install distributed"
        ) from error
    try:
        client = Client(scheduler, timeout=20)
    except (OSError, ValueError, TimeoutError) as error:
        raise GradingError(f"No dask scheduler answers at {scheduler}: {error}.") from error
    with client, client.get_executor(pure=False) as pool:
        yield pool, jobs or max(1, sum(client.ncores().values()))


@cache
def _tools(_pid: int, _thread: int, sandboxed: bool, private: str) -> SandboxWorker:
    """Return the sandbox worker of one thread of one process; the worker ends with the thread."""
    return SandboxWorker(sandboxed=sandboxed, private=private)


@cache
def _extras(_pid: int, private: str) -> Extras:
    return read_extras(Path(private) if private else None)


@cache
def _plan(chapter: str) -> Plan:
    return (
        plan(chapter) if chapter in chapters() else Plan(chapter, Rebuilder({"cells": []}), ())
    )  # there is a problem, so there is nothing to examine
