"""Measures the speed of grading, kills and continues runs of the grader, and grades the solutions."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from course_pkg.authoring.cells import check_of, code_cells, exercise_of
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.grading.run.summary import GRADED, NEED_A_LOOK
from course_pkg.ros.process.supervisor import descendants
from course_pkg.setup import Places
from tests.grading.submitted import WRONG, hand_in

# speed: compares `course grade` with nbgrader. Arguments: `[SUBMISSIONS] [plain] [many[:COUNT]]`. SUBMISSIONS
# students (default 30) hand in the notebook of chapter 05. Every third student has one wrong answer. Three
# commands grade the notebooks: `course grade` without nbval, `course grade --validate all`, and `nbgrader
# autograde` with a notebook that has the same cells. The ratio of two commands is computed from their
# durations per notebook. If the argument `plain` is given, only the first command runs. If the argument
# `many` is given, `course grade` also grades 1,000 (or COUNT) submissions, and the benchmark measures the
# memory. nbgrader is installed into a folder of the cache.

NBGRADER = "nbgrader==0.9.6"
CHAPTER = "05"
RIGHT = "area = request.width * request.length"
SPEED_WRONG = "area = request.width + request.length"
BAR, MANY_BAR = 10.0, 0.9


def speed_main() -> None:
    """Measure each grading command, and print a table with the durations."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    words = sys.argv[2:]
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        here = Path(folder)
        handed_in(here / "submissions", count)
        ours = timed(lambda: speed_grade(here / "submissions", here / "out", "none")) / count
        report("course grade, points alone", ours)
        for word in words:
            if word.startswith("many"):
                many(here, ours, int(word.partition(":")[2] or 1000))
        if "plain" not in words:
            whole = timed(lambda: speed_grade(here / "submissions", here / "whole", "all")) / count
            report("course grade --validate all", whole)
            theirs = nbgrader(here, min(count, 4))
            report("nbgrader autograde", theirs)
            print(f"ratio {theirs / ours:.1f} (bar {BAR:g}); all of them run by nbval {theirs / whole:.1f}")


def report(what: str, seconds: float) -> None:
    """Print one line of the results."""
    print(f"{what:32}{seconds:8.2f} s a notebook", flush=True)


def timed(work: Callable[[], object]) -> float:
    """Run a function, and return its duration in s."""
    began = time.monotonic()
    work()
    return time.monotonic() - began


def handed_in(folder: Path, count: int) -> None:
    """Write several different submissions. Every third submission has one wrong answer."""
    solution = read(NotebookStore().solutions([CHAPTER])[0])
    for number in range(count):
        notebook = json.loads(json.dumps(solution))
        for cell in code_cells(notebook):
            if exercise_of(cell):
                wrong = number % 3 == 2 and exercise_of(cell) == "05.1"
                text = cell["source"].replace(RIGHT, SPEED_WRONG) if wrong else cell["source"]
                cell["source"] = f"{text}\n# {number}"
        path = folder / f"student{number:04}" / f"{CHAPTER}_write_a_server.ipynb"
        path.parent.mkdir(parents=True)
        path.write_text(json.dumps(notebook), "utf-8")


def speed_grade(submissions: Path, out: Path, validate: str) -> None:
    """Grade the submissions with `course grade`."""
    command = [Places.of().checkout / "course", "grade", submissions, "--out", out, "--validate", validate]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    assert subprocess.run(command, check=False, **quiet).returncode in (GRADED, NEED_A_LOOK)


def many(here: Path, few: float, count: int) -> None:
    """Grade many submissions, and print the throughput and the memory usage."""
    handed_in(here / "many", count)
    with watched() as seen:
        each = timed(lambda: speed_grade(here / "many", here / "many-out", "none")) / count
    report(f"course grade, {count} submissions", each)
    early, late = statistics.median(seen[10:40]), statistics.median(seen[-40:-10])
    print(
        f"throughput {few / each:.2f} of that with few submissions (bar {MANY_BAR:g}); "
        f"memory {early:.0f} -> {late:.0f} MiB"
    )


@contextmanager
def watched() -> Iterator[list[float]]:
    """Once per second, append the memory of all child processes in MiB to the yielded list."""
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
    """Grade several copies of a notebook with nbgrader, and return the duration in s for each copy."""
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
    """Return the chapter's notebook as an nbgrader assignment."""
    notebook = json.loads(json.dumps(read(NotebookStore().solutions([CHAPTER])[0])))
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
    """Return the Python interpreter of an environment with nbgrader."""
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


# kill: kills the grader by SIGKILL at random moments. Arguments: `[TIMES]`. Six submissions are graded once
# without a kill. Then the benchmark starts TIMES runs (default 20), kills each run after a random time, and
# continues the run. After each run, the grades must be the same as without a kill, and all processes must
# have ended.

COURSE = Places.of().checkout / "course"


def kill_main() -> None:
    """Repeatedly kill a run of the grading, and continue the run in the same folder.

    Print the number of runs in which no process remained and the grades were the same as in a run without a
    kill.
    """
    times = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        here = Path(folder)
        for number in range(6):
            answers = {"05.1": WRONG} if number % 2 else {"05.2": f"# {number}"}
            hand_in(here / "in", f"s{number:02}", answers=answers)
        began = time.monotonic()
        grade_without_nbval(here / "in", here / "undisturbed")
        whole = time.monotonic() - began
        expected = (here / "undisturbed" / "grades.csv").read_bytes()
        right = sum(continued(here / "in", here / f"killed{n}", whole, expected) for n in range(times))
    print(f"{right} of {times} runs were continued to the same grades, with no process left (bar: all)")
    sys.exit(right != times)


def continued(submissions: Path, out: Path, whole: float, expected: bytes) -> bool:
    """Kill a run of the grading, and continue this run.

    Return whether the grades are right and no process remains.
    """
    moment = random.uniform(0.2, whole)  # noqa: S311 -- not a secret
    process = start(submissions, out)
    time.sleep(moment)
    family = descendants(process.pid)
    process.send_signal(signal.SIGKILL)
    process.wait()
    left = still_there(family)
    kept = len(list((out / ".grading").glob("*.json"))) if out.exists() else 0
    grade_without_nbval(submissions, out)
    same = (out / "grades.csv").read_bytes() == expected
    words = f"killed after {moment:5.1f} s: {kept} kept, {len(left)} processes left"
    print(f"{words}, grades {'the same' if same else 'DIFFERENT'}", flush=True)
    return same and not left


def still_there(pids: list[int]) -> list[int]:
    """Wait at most 10 s until the given processes exit, and return the processes that still run."""
    deadline = time.monotonic() + 10.0
    while time.monotonic() < deadline:
        pids = [pid for pid in pids if alive(pid)]
        if not pids:
            break
        time.sleep(0.1)
    return pids


def alive(pid: int) -> bool:
    """Return whether a process runs; a zombie does not count as running."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def start(submissions: Path, out: Path) -> subprocess.Popen[bytes]:
    """Start `course grade` without nbval."""
    command = [COURSE, "grade", submissions, "--out", out, "--validate", "none"]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ})


def grade_without_nbval(submissions: Path, out: Path) -> None:
    """Grade all submissions. Exit if grading fails."""
    if start(submissions, out).wait():
        sys.exit("grading failed")


# reference: grades the solutions. Arguments: `[RUNS]`. Each chapter's solution is graded RUNS times (default
# 20), and several submissions are graded at the same time. In each run, each part must pass.


def reference_main() -> None:
    """Grade the solutions, and print each part that did not pass."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    lost: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        here = Path(folder)
        for number in range(runs):
            for path in NotebookStore().solutions():
                target = hand_in(here / "in", f"s{number:02}", path.name[:2])
                notebook = json.loads(target.read_text("utf-8"))
                # `course grade` grades identical notebooks only once, so the benchmark adds a different text
                # to each notebook.
                notebook["cells"][0]["source"] += f"\n{number}"
                target.write_text(json.dumps(notebook), "utf-8")
        grade_without_nbval(here / "in", here / "out")
        graded = 0
        for record in sorted((here / "out" / "results").rglob("*.json")):
            for report in json.loads(record.read_text("utf-8"))["reports"]:
                graded += 1
                if report["verdict"] != "passed":
                    lost[report["check"]] += 1
                    print(
                        record.parent.name,
                        report["check"],
                        report["verdict"],
                        report["note"],
                        [r for r in report["assertions"] if not r["holds"]],
                    )
    print(f"{graded - sum(lost.values())} of {graded} parts passed (bar: all); lost: {dict(lost)}")
    sys.exit(bool(lost))
