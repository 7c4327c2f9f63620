"""Grading against nbgrader: `course run python tests/bench/grading.py [SUBMISSIONS] [plain] [many[:COUNT]]`.

The notebook of chapter 05, handed in by SUBMISSIONS students (30), a third of them with a wrong answer each,
is graded by `course grade` without nbval's run, by `course grade --validate all`, and by `nbgrader autograde`
of a notebook of the same cells, in one run; the ratio is that of the times a notebook. With `many`, 1,000
submissions (or COUNT) are graded besides, and the memory of all the grader's processes is watched; with
`plain`, only points are compared.

nbgrader is installed into a folder of its own under the cache, the version of the comparison pinned below.
What remains of the time, and in what: the table says.
"""

from __future__ import annotations

import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from course_pkg.authoring.cells import check_of, code_cells, exercise_of
from course_pkg.authoring.shelf import Shelf, read
from course_pkg.graph.leashed import descendants
from course_pkg.provision import Places

NBGRADER = "nbgrader==0.9.6"
CHAPTER = "05"
RIGHT = "area = request.width * request.length"
WRONG = "area = request.width + request.length"
BAR, MANY_BAR = 10.0, 0.9


def main() -> None:
    """Measure, and print the table."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    words = sys.argv[2:]
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        here = Path(folder)
        handed_in(here / "submissions", count)
        ours = timed(lambda: grade(here / "submissions", here / "out", "none")) / count
        report("course grade, points alone", ours)
        for word in words:
            if word.startswith("many"):
                many(here, ours, int(word.partition(":")[2] or 1000))
        if "plain" not in words:
            whole = timed(lambda: grade(here / "submissions", here / "whole", "all")) / count
            report("course grade --validate all", whole)
            theirs = nbgrader(here, min(count, 4))
            report("nbgrader autograde", theirs)
            print(f"ratio {theirs / ours:.1f} (bar {BAR:g}); all of them run by nbval {theirs / whole:.1f}")


def report(what: str, seconds: float) -> None:
    """Print one line of the table."""
    print(f"{what:32}{seconds:8.2f} s a notebook", flush=True)


def timed(work: Callable[[], object]) -> float:
    """Return how long `work` takes, in s."""
    began = time.monotonic()
    work()
    return time.monotonic() - began


def handed_in(folder: Path, count: int) -> None:
    """Write `count` submissions, all of them different, every third with a wrong answer."""
    solution = read(Shelf().solutions([CHAPTER])[0])
    for number in range(count):
        notebook = json.loads(json.dumps(solution))
        for cell in code_cells(notebook):
            if exercise_of(cell):
                wrong = number % 3 == 2 and exercise_of(cell) == "05.1"
                text = cell["source"].replace(RIGHT, WRONG) if wrong else cell["source"]
                cell["source"] = f"{text}\n# {number}"
        path = folder / f"student{number:04}" / f"{CHAPTER}_write_a_server.ipynb"
        path.parent.mkdir(parents=True)
        path.write_text(json.dumps(notebook), "utf-8")


def grade(submissions: Path, out: Path, validate: str) -> None:
    """Grade by the command that an instructor types."""
    command = [Places.of().checkout / "course", "grade", submissions, "--out", out, "--validate", validate]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def many(here: Path, few: float, count: int) -> None:
    """Grade `count`, and say how the time for each and the memory compare with few."""
    handed_in(here / "many", count)
    with watched() as seen:
        each = timed(lambda: grade(here / "many", here / "many-out", "none")) / count
    report(f"course grade, {count} submissions", each)
    early, late = statistics.median(seen[10:40]), statistics.median(seen[-40:-10])
    print(
        f"throughput {few / each:.2f} of that of few (bar {MANY_BAR:g}); memory {early:.0f} -> {late:.0f} MiB"
    )


@contextmanager
def watched() -> Iterator[list[float]]:
    """Yield the memory (MiB) of all processes below this one, a number a second."""
    seen: list[float] = []
    over = threading.Event()

    def look() -> None:
        while not over.wait(1.0):
            seen.append(sum(map(_resident, descendants(os.getpid()))) / 2**20)

    thread = threading.Thread(target=look)
    thread.start()
    try:
        yield seen
    finally:
        over.set()
        thread.join()


def _resident(pid: int) -> int:
    try:
        resident, shared = Path(f"/proc/{pid}/statm").read_text().split()[1:3]
    except OSError:
        return 0
    return (int(resident) - int(shared)) * os.sysconf("SC_PAGE_SIZE")


def nbgrader(here: Path, count: int) -> float:
    """Return the seconds that nbgrader takes for each of `count` notebooks of the same cells."""
    python = nbgrader_python()
    course = here / "nbgrader"
    assignment = course / "source" / "ps" / "notebook.ipynb"
    assignment.parent.mkdir(parents=True)
    assignment.write_text(json.dumps(as_assignment()), "utf-8")
    (course / "nbgrader_config.py").write_text("c = get_config()\nc.CourseDirectory.course_id = 'bench'\n")
    path = f"{python.parent}:{os.environ['PATH']}"
    environ = {**os.environ, "PATH": path, "HOME": str(here)}
    environ.pop("ROS_MASTER_URI", None)

    def run(*words: str) -> None:
        subprocess.run(
            [python, "-m", "nbgrader", *words], cwd=course, env=environ, check=True, capture_output=True
        )

    run("generate_assignment", "ps", "--force")
    for number in range(count):
        target = course / "submitted" / f"student{number}" / "ps" / "notebook.ipynb"
        target.parent.mkdir(parents=True)
        shutil.copy(assignment, target)
    return timed(lambda: run("autograde", "ps", "--ExecutePreprocessor.timeout=120")) / count


def as_assignment() -> dict[str, object]:
    """Return the notebook with nbgrader's marks: exercises are answers, check cells are tests."""
    notebook = json.loads(json.dumps(read(Shelf().solutions([CHAPTER])[0])))
    for cell in code_cells(notebook):
        cell["outputs"], cell["execution_count"] = [], None
        part = exercise_of(cell) or check_of(cell)
        if part:
            cell["metadata"]["nbgrader"] = {
                "grade": bool(check_of(cell)),
                "grade_id": cell["id"],
                "locked": bool(check_of(cell)),
                "points": 2,
                "schema_version": 3,
                "solution": bool(exercise_of(cell)),
                "task": False,
            }
            if exercise_of(cell):
                cell["metadata"]["nbgrader"].pop("points")
    return dict(notebook)


def nbgrader_python() -> Path:
    """Return the interpreter of an environment that has nbgrader, made once."""
    places = Places.of()
    folder = places.cache.parent / "bench-nbgrader"
    python = folder / "bin" / "python"
    if not (folder / "ready").exists():
        system = shutil.which("python3", path="/usr/bin") or sys.executable
        bare = [system, "-m", "venv", "--system-site-packages", "--without-pip", folder]
        subprocess.run(bare, check=True)
        pip = [places.python, "-m", "pip", "--python", python, "install", "--quiet"]
        subprocess.run([*pip, NBGRADER, "anywidget==0.11.0", "ipywidgets==8.1.9", "ipykernel"], check=True)
        (folder / "ready").touch()
    return python


if __name__ == "__main__":
    main()
