"""SIGKILL of the grader at random moments: `course run python tests/bench/grading_kill.py [TIMES]`.

Six submissions are graded once undisturbed. Then, TIMES times (20), a run is killed after a random time and
continued; its grades must be those of the undisturbed one, and no process may be left.
"""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from course_pkg.graph.leashed import descendants
from course_pkg.provision import Places
from tests.grading.submitted import WRONG, hand_in

COURSE = Places.of().checkout / "course"


def main() -> None:
    """Kill and continue, and print how often all was well."""
    times = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        here = Path(folder)
        for number in range(6):
            answers = {"05.1": WRONG} if number % 2 else {"05.2": f"# {number}"}
            hand_in(here / "in", f"s{number:02}", answers=answers)
        began = time.monotonic()
        grade(here / "in", here / "undisturbed")
        whole = time.monotonic() - began
        expected = (here / "undisturbed" / "grades.csv").read_bytes()
        right = sum(continued(here / "in", here / f"killed{n}", whole, expected) for n in range(times))
    print(f"{right} of {times} runs were continued to the same grades, with no process left (bar: all)")
    sys.exit(right != times)


def continued(submissions: Path, out: Path, whole: float, expected: bytes) -> bool:
    """Kill a run, continue it, and return whether all is as if nothing had been."""
    moment = random.uniform(0.2, whole)  # noqa: S311 -- a moment, no secret
    process = start(submissions, out)
    time.sleep(moment)
    family = descendants(process.pid)
    process.send_signal(signal.SIGKILL)
    process.wait()
    left = still_there(family)
    kept = len(list((out / ".grading").glob("*.json"))) if out.exists() else 0
    grade(submissions, out)
    same = (out / "grades.csv").read_bytes() == expected
    words = f"killed after {moment:5.1f} s: {kept} kept, {len(left)} processes left"
    print(f"{words}, grades {'the same' if same else 'OTHERS'}", flush=True)
    return same and not left


def still_there(pids: list[int]) -> list[int]:
    """Return those of `pids` that live on after 10 s."""
    deadline = time.monotonic() + 10.0
    while time.monotonic() < deadline:
        pids = [pid for pid in pids if alive(pid)]
        if not pids:
            break
        time.sleep(0.1)
    return pids


def alive(pid: int) -> bool:
    """Return whether a process runs, and is not only not yet waited for."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def start(submissions: Path, out: Path) -> subprocess.Popen[bytes]:
    """Start the command that an instructor types."""
    command = [COURSE, "grade", submissions, "--out", out, "--validate", "none"]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ})


def grade(submissions: Path, out: Path) -> None:
    """Grade to the end."""
    if start(submissions, out).wait():
        sys.exit("grading failed")


if __name__ == "__main__":
    main()
