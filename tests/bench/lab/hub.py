"""Measures a hub with many students.

Each student uses the HTTP and WebSocket interface. The student logs in and starts the server. Then the
student runs the code cells of chapter 05 with pauses, and runs a check with a right answer in each round.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import psutil

from tests.hub.running import hub, passwords
from tests.hub.student import Student
from tests.hub.test_hub import IMPORTS, RIGHT
from tests.lab.commands import all_gone, below

NOTEBOOK = "notebooks/05_write_a_server.ipynb"


@dataclass
class Work:
    """The measurements for one student; times are in s."""

    start: float = 0.0
    checks: list[float] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)


def students(count: int, pause: float, rounds: int) -> None:
    """Print the times of the checks and the memory for each student."""
    names = [f"student{number:02}" for number in range(count)]
    with tempfile.TemporaryDirectory() as temporary, hub(Path(temporary), names) as (process, address):
        known, barrier = passwords(Path(temporary)), threading.Barrier(count + 1)
        works = [Work() for _ in names]
        threads = [
            threading.Thread(target=_study, args=(address, name, known[name], work, pause, rounds, barrier))
            for name, work in zip(names, works, strict=True)
        ]
        before = _memory(process.pid)
        for thread in threads:
            thread.start()
        processor = time.process_time()
        barrier.wait()
        working = (_memory(process.pid) - before) / count
        for thread in threads:
            thread.join()
        idle = (_memory(process.pid) - before) / count
        _print(works, before, working, idle, processor)
        family = below(process)
        process.kill()
        print(f"after SIGKILL of the hub: {len(family)} processes ended: {all_gone(family)}")


def _study(
    address: str, name: str, password: str, work: Work, pause: float, rounds: int, barrier: threading.Barrier
) -> None:
    try:
        with Student(address, name) as student:
            begun = time.monotonic()
            if not student.log_in(password):
                raise AssertionError("no login")
            student.start_server()
            notebook = student.open_notebook(NOTEBOOK)
            student.run(IMPORTS)
            work.start = time.monotonic() - begun
            cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
            _cells(student, [cell for cell in cells if "check(" not in cell], work, pause, rounds)
            barrier.wait()
    except Exception as error:  # noqa: BLE001 -- it is reported as a wrong result
        work.wrong.append(f"{name}: {error!r}"[:300])
        barrier.abort()


def _cells(student: Student, cells: Sequence[str], work: Work, pause: float, rounds: int) -> None:
    for number in range(rounds):
        time.sleep(pause)
        student.run(cells[number % len(cells)])
        time.sleep(pause)
        student.run(RIGHT)
        shown, seconds = student.run('check("05.1")')
        work.checks.append(seconds)
        if "05.1 passed" not in shown:
            work.wrong.append(shown[:300])


def _memory(pid: int) -> float:
    """Return the PSS in MiB of a process and its descendants."""
    total = 0
    for each in [pid, *[child.pid for child in psutil.Process(pid).children(recursive=True)]]:
        try:
            total += psutil.Process(each).memory_full_info().pss
        except psutil.Error:
            continue
    return total / (1 << 20)


def _print(works: Sequence[Work], hub: float, working: float, idle: float, processor: float) -> None:
    checks = [seconds for work in works for seconds in work.checks]
    wrong = [each for work in works for each in work.wrong]
    high = statistics.quantiles(checks, n=20)[-1] if len(checks) > 1 else float("nan")
    started = sorted(work.start for work in works)
    print(f"{len(works)} students, {len(checks)} checks, {len(wrong)} wrong {wrong[:3]}")
    middle, last = statistics.median(checks), max(checks)
    print(f"check: median {middle:.2f} s, 95th percentile {high:.2f} s (bar 3 s), slowest {last:.2f} s")
    print(f"login to a ready kernel: median {statistics.median(started):.1f} s, slowest {started[-1]:.1f} s")
    print(f"memory (PSS): hub {hub:.0f} MiB; for each student {working:.0f} MiB at the end of the work")
    print(f"              {idle:.0f} MiB after the students have left")
    print(f"processor time of the simulation: {time.process_time() - processor:.0f} s")


def students_main() -> None:
    """Run the measurement with the arguments of the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", type=int)
    parser.add_argument("--pause", type=float, default=10.0, help="s between two cells")
    parser.add_argument("--rounds", type=int, default=6)
    options = parser.parse_args()
    students(options.count, options.pause, options.rounds)
    sys.stdout.flush()
