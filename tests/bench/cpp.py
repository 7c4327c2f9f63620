"""Prints how long chapter 11's builds take from cold, and what one file costs by itself.

usage: ./course run python tests/bench/cpp.py [RUNS]

The files and the commands are those of the solution's own cells, in a workspace that is made anew each time.
"""

from __future__ import annotations

import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from course_pkg.authoring.cells import code_cells
from course_pkg.authoring.shelf import read
from course_pkg.building.cpp import compile_command

SOLUTION = next((Path(__file__).parents[2] / "solutions").glob("11_*.ipynb"))
BAR = 15.0  # s
WRITING = re.compile(r"%%writefile (?P<more>-a )?(?P<path>src/cpp_services/\S+)\n(?P<text>.*)", re.DOTALL)


def main(runs: int) -> int:
    """Measure each run in a workspace of its own."""
    print(f"{os.cpu_count()} cores; load {os.getloadavg()[0]:.1f} before the start")
    rounds = [measure() for _ in range(runs)]
    for seconds, alone in rounds:
        steps = " + ".join(f"{step:.1f}" for step in seconds)
        print(f"builds {steps} = {sum(seconds):.1f} s; the compiler alone, one file: {alone:.1f} s")
    median = statistics.median(sum(seconds) for seconds, _ in rounds)
    files = statistics.median(sum(seconds) / alone for seconds, alone in rounds)
    print(f"median {median:.1f} s, as long as {files:.1f} files one by one")
    print(f"bar {BAR:.0f} s: {'met' if median <= BAR else 'MISSED'}")
    return 0


def measure() -> tuple[list[float], float]:
    """Return the seconds of each build from cold, and those of the compiler for one of the files."""
    with tempfile.TemporaryDirectory(prefix="course-cpp-") as folder:
        seconds = list(built(Path(folder)))
        source = f"{folder}/src/cpp_services/src/geometry_server.cpp"
        return seconds, timed(compile_command(source, f"{folder}/alone"), folder)


def built(folder: Path) -> Iterator[float]:
    """Do what the cells do, and yield the seconds of each build."""
    for cell in code_cells(read(SOLUTION)):
        if found := WRITING.match(cell["source"]):
            path = folder / found["path"]
            path.parent.mkdir(parents=True, exist_ok=True)
            with path.open("a" if found["more"] else "w") as file:
                file.write(found["text"] + "\n")
        for line in re.findall(r"^!(sed .*|catkin_make [^>;]*)", cell["source"], re.MULTILINE):
            spent = timed(["bash", "-c", line], str(folder))
            if line.startswith("catkin_make"):
                yield spent


def timed(command: list[str], folder: str) -> float:
    """Return how long a command takes, in s; end the whole where it fails."""
    started = time.perf_counter()
    done = subprocess.run(
        command, cwd=folder, env={**os.environ, "PWD": folder}, capture_output=True, text=True, check=False
    )
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return time.perf_counter() - started


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if sys.argv[1:] else 3))
