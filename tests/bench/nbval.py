"""Prints how long nbval takes over all solutions: one after the other, and several at once.

usage: ./course run python tests/bench/nbval.py [WORKERS …]
The default is the number of workers that `course` itself takes on this machine.
"""

from __future__ import annotations

import os
import resource
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from course_pkg.authoring.validate import validate, workers_here

SOLUTIONS = sorted((Path(__file__).parents[2] / "solutions").glob("*.ipynb"))
BAR = 0.45  # of the serial run
LIMIT = 3600.0  # s


def main(counts: Sequence[int]) -> int:
    """Run serially, then with each number of workers, and print the ratios."""
    print(
        f"{len(SOLUTIONS)} solutions, {os.cpu_count()} cores; load {os.getloadavg()[0]:.1f} before the start"
    )
    serial, busy = measure(1)
    print(f"serial: {serial:.1f} s, of which the processor works {busy:.1f} s")
    for count in counts:
        seconds, busy = measure(count)
        ratio = seconds / serial
        print(
            f"{count} at once: {seconds:.1f} s, processor {busy:.1f} s; ratio {ratio:.2f}, "
            f"bar {BAR}: {'met' if ratio <= BAR else 'MISSED'}"
        )
    return 0


def measure(workers: int) -> tuple[float, float]:
    """Return the seconds of one run, and those that its processes spent on a core."""
    before, started = _spent(), time.perf_counter()
    outcome = validate(SOLUTIONS, workers=workers, timeout=LIMIT)
    seconds = time.perf_counter() - started
    if outcome.returncode:
        print(outcome.stdout[-3000:])
        sys.exit(f"A solution does not show what it stored, with {workers} at once: no figure counts.")
    return seconds, _spent() - before


def _spent() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


if __name__ == "__main__":
    sys.exit(main([int(count) for count in sys.argv[1:]] or [workers_here(len(SOLUTIONS))]))
