"""`course autograde` grades the submission in /autograder, and writes results.json even after an error.

Gradescope starts the script `run_autograder` as root in a new container for each submission. The folder
/autograder/source contains the unpacked zip file of the autograder: settings.json, and optionally the folder
`private`. The folder /autograder/submission contains the files that the student handed in. The file
/autograder/submission_metadata.json contains the time of the submission, and the deadline. The script writes
the result into the file /autograder/results/results.json.

Layout: https://gradescope-autograders.readthedocs.io/en/latest/specs/.
"""

from __future__ import annotations

import json
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from course_pkg.checking.parts import secret_paths
from course_pkg.errors import CourseError, GradingError, WorkerFailed
from course_pkg.files import write_atomically
from course_pkg.grading.autograder.handed_in import handed_in
from course_pkg.grading.autograder.settings import days_late, read_settings
from course_pkg.grading.extras import read_extras
from course_pkg.grading.grade import Grade, Submission
from course_pkg.grading.marking import Run, mark
from course_pkg.grading.plan import plan
from course_pkg.grading.points import PointsTable, read_points
from course_pkg.grading.reports.formats.gradescope import results_of
from course_pkg.sandbox.job import PartJob, PartResult
from course_pkg.sandbox.linux import bubblewrap, users
from course_pkg.sandbox.worker_client import SandboxWorker
from course_pkg.setup import Places
from course_pkg.types.fields import Plain
from course_pkg.waiting import Deadline

WEAKER = (
    "This machine forbids namespaces, so the code was less isolated than with `course grade`. The code ran "
    "as another user, with limits on time and memory, and it could use the network."
)
OUT_OF_TIME = "the time limit of the autograder was reached; ask your instructor"
OURS = "The autograder failed ({}). This is not a mistake in your work. Please tell your instructor."


def prepare() -> int:
    """Make the checks and the solutions of this checkout unreadable for all users except root."""
    for folder in {path.parent for path in secret_paths()}:
        (folder / "__pycache__").mkdir(exist_ok=True)  # Python writes compiled fixtures into this folder.
    for path in [*secret_paths(), Places.of().checkout / "solutions"]:
        path.chmod(0o700 if path.is_dir() else 0o600)
    return 0


def autograde(root: Path) -> int:
    """Grade the submission in the folder `root`, which is /autograder, and write results.json."""
    try:
        results = _results(root)
    except CourseError as error:
        results = _without_points(str(error))
    except Exception as error:  # noqa: BLE001 -- without results.json, the student would see no reason
        sys.stderr.write(f"{type(error).__name__}: {error}\n")
        results = _without_points(OURS.format(type(error).__name__))
    (root / "results").mkdir(exist_ok=True)
    write_atomically(root / "results" / "results.json", json.dumps(results, indent=1) + "\n")
    return 0


def _without_points(why: str) -> dict[str, Plain]:
    return {"score": 0, "output": why, "output_format": "text", "stdout_visibility": "hidden", "tests": []}


def _results(root: Path) -> dict[str, Plain]:
    settings = read_settings(root / "source" / "settings.json")
    deadline = Deadline(settings.minutes * 60)
    private = root / "source" / "private"
    extras = read_extras(private if private.is_dir() else None)
    points = read_points(extras.points)
    found, messages = handed_in(root / "submission", settings.chapters)
    weaker = bool(bubblewrap.refusal())
    if weaker:
        _require_users(root)
        messages.append(WEAKER)
    late, policy = days_late(root / "submission_metadata.json"), settings.policy
    if policy and late is None:
        messages.append(
            "The autograder does not know when you handed in your work, so it did not deduct "
            "points for lateness."
        )
    with _runner(deadline, str(extras.folder or ""), weaker=weaker) as run:
        grades = [_grade(each, points, run).for_student() for each in found]
    if policy and late:
        grades = [replace(each, late=late, factor=policy.factor(late)) for each in grades]
    results = results_of(grades)
    return {**results, "output": "\n".join(filter(None, [*messages, str(results["output"])]))}


def _require_users(root: Path) -> None:
    if reason := users.refusal([root]):
        raise GradingError(
            f"Nothing was graded, because this machine cannot isolate students' code. {reason} "
            "Please tell your instructor."
        )


def _grade(submission: Submission, points: PointsTable, run: Run) -> Grade:
    secret = os.urandom(16).hex()
    return points.weighed(mark(submission, plan(submission.chapter), run, secret, "", sandboxed=True))


@contextmanager
def _runner(deadline: Deadline, private: str, *, weaker: bool) -> Iterator[Run]:
    """Yield a function that runs one part of the submission.

    At the time limit of the autograder, the yielded function stops the running part. After this, the function
    runs no other part.
    """
    with SandboxWorker(users=weaker, private=private) as worker:

        def run(job: PartJob) -> PartResult:
            try:
                if not deadline.passed:
                    return worker.run(job)
            except WorkerFailed:
                if not deadline.passed:
                    raise
            return PartResult(None, OUT_OF_TIME, lost=True)

        timer = threading.Timer(deadline.left, worker.kill)
        timer.start()
        try:
            yield run
        finally:
            timer.cancel()
    if weaker:
        _, lock = users.reserve()  # This call ends processes that still run because their worker was killed.
        lock.close()
