"""Run answers as students would, many a minute: each in processes of its own, on a master of its own.

A warm process that has everything imported forks them: a master, a judge that waits outside, and the
student, whose `check()` finds that judge through COURSE_EXAMINER. A whole run costs no import at all.
Python that forks must have one thread, so the warm process never joins a graph itself.
"""

from __future__ import annotations

import json
import linecache
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, NoReturn

from course_pkg.errors import ExamError
from course_pkg.examiner.answers import Answer
from course_pkg.examiner.parts import every_part
from course_pkg.examiner.report import Report, report_from

LIMIT = 150.0  # s for one answer; a check's own deadline is below
WARM = "from course_pkg.examiner.rehearsal import warm; warm()"


class Rehearsal:
    """A warm process; use it as a context manager, and `run` answers one after the other."""

    def __enter__(self) -> Rehearsal:
        self._process = subprocess.Popen(
            [sys.executable, "-c", WARM], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._process.communicate()  # an end of its input ends it

    def run(self, answer: Answer, source: str | None = None, seed: int | None = None) -> Report:
        """Run `answer`, or `source` in its place, and return what the check reported."""
        cells = [answer.before, answer.source if source is None else source, answer.after]
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps({"check": answer.check, "cells": cells, "seed": seed}) + "\n")
        self._process.stdin.flush()
        outcome = json.loads(self._process.stdout.readline() or '{"error": "the rehearsal ended"}')
        if "error" in outcome:
            raise ExamError(f"{answer.check} {answer.title}: {outcome['error']}")
        return report_from(outcome["report"])


def warm() -> None:
    """Import what every run needs, then fork a run for each line of stdin."""
    import rosmaster.master  # noqa: F401 -- imported for the forks

    list(every_part())
    for line in sys.stdin:
        sys.stdout.write(json.dumps(_rehearse(json.loads(line))) + "\n")
        sys.stdout.flush()


def _rehearse(job: dict[str, Any]) -> dict[str, Any]:
    """Fork one run, wait for its report, and end all of its processes."""
    reading, writing = os.pipe()
    with tempfile.TemporaryDirectory(prefix="course-rehearsal-") as folder:
        leader = _fork(lambda: _student(job, folder, writing))
        os.close(writing)
        try:
            return _reported(reading)
        finally:
            os.close(reading)
            with suppress(ProcessLookupError):
                os.killpg(leader, signal.SIGKILL)
            os.waitpid(leader, 0)


def _reported(reading: int) -> dict[str, Any]:
    data, deadline = b"", time.monotonic() + LIMIT
    while (
        not data.endswith(b"\n") and select.select([reading], [], [], max(deadline - time.monotonic(), 0))[0]
    ):
        if not (chunk := os.read(reading, 65536)):
            break
        data += chunk
    try:
        outcome: dict[str, Any] = json.loads(data)
    except ValueError:
        return {"error": f"no report within {LIMIT:g} s, or the process ended"}
    return outcome


def _student(job: dict[str, Any], folder: str, writing: int) -> None:
    """Be the student: run the cells, then the check. Leads a group, so that one signal ends all of it."""
    os.setsid()
    os.chdir(folder)
    port = _free_port()
    os.environ.update(
        ROS_MASTER_URI=f"http://localhost:{port}",
        ROS_LOG_DIR=folder,
        COURSE_STATE=folder,
        COURSE_EXAMINER=os.path.join(folder, "judge"),
    )
    if job["seed"] is not None:
        os.environ["COURSE_SEED"] = str(job["seed"])
    _fork(lambda: _master(port))
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(os.environ["COURSE_EXAMINER"])
    listener.listen()
    _fork(lambda: _judge(listener))
    _await_port(port)
    outcome = _checked(job)
    os.write(writing, json.dumps(outcome).encode() + b"\n")


def _checked(job: dict[str, Any]) -> dict[str, Any]:
    from course_pkg.examiner.desk import check

    names: dict[str, Any] = {"__name__": "__main__"}
    sys.modules["__main__"].__dict__.update(names)
    before, *others = job["cells"]
    if words := _run_cell(before, "<cell 0>", names):
        return {"error": f"the cells before the answer raised {words}"}
    for number, cell in enumerate(others, 1):
        _run_cell(cell, f"<cell {number}>", names)
    return {"report": check(job["check"], names).as_dict()}


def _run_cell(source: str, name: str, names: dict[str, Any]) -> str:
    """Run a cell as a kernel does: its source can be looked up, and its error is returned, not raised."""
    linecache.cache[name] = (len(source), None, source.splitlines(keepends=True), name)
    if source.startswith("%%writefile "):
        return _write_file(*source.removeprefix("%%writefile ").split("\n", 1))
    try:
        exec(compile(source, name, "exec"), names)  # noqa: S102 -- a cell
    except Exception as error:  # noqa: BLE001 -- whatever the cell raises
        return f"{type(error).__name__}: {error}"
    return ""


def _write_file(path: str, text: str) -> str:
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_text(text, "utf-8")
    return ""


def _judge(listener: socket.socket) -> None:
    from course_pkg.examiner.judge import judge
    from course_pkg.examiner.link import Link

    link = Link(listener.accept()[0])
    judge(link, Path(os.environ["COURSE_STATE"]) / "results")


def _master(port: int) -> None:
    import rosmaster.master

    rosmaster.master.Master(port, num_workers=3).start()
    signal.pause()


def _await_port(port: int) -> None:
    deadline = time.monotonic() + 5.0
    while time.monotonic() < deadline:
        with suppress(ConnectionRefusedError), socket.create_connection(("127.0.0.1", port), timeout=1.0):
            return
        time.sleep(0.005)
    raise ExamError(f"the master did not start on port {port}")


def _free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port: int = listener.getsockname()[1]
        return port


def _fork(work: Callable[[], None]) -> int:
    """Run `work` in a child and return its pid; the child writes nothing to this process's output."""
    if not (pid := os.fork()):
        _be_the_child(work)
    return pid


def _be_the_child(work: Callable[[], None]) -> NoReturn:
    status = 1
    try:
        silence = os.open(os.devnull, os.O_RDWR)
        os.dup2(silence, 0)
        os.dup2(silence, 1)
        work()
        status = 0
    finally:
        os._exit(status)
