"""Tests that kill `course grade` and `course review` with SIGKILL at random moments."""

from __future__ import annotations

import hashlib
import http.client
import os
import random
import shutil
import signal
import subprocess
import threading
import time
from contextlib import suppress
from pathlib import Path

import pytest

from course_pkg.grading.review.overrides import read_overrides
from course_pkg.ros.process.supervisor import descendants
from course_pkg.setup import Places
from tests.grading.submitted import WRONG, hand_in
from tests.support import eventually
from tests.web_pages.servers import ask

pytestmark = [pytest.mark.usefixtures("sandbox"), pytest.mark.slow, pytest.mark.timeout(1200)]
COURSE = Places.of().checkout / "course"
TIMES = 20
BLANK = dict.fromkeys([f"05.{number}" for number in range(2, 9)], "")
HEAD = "student,chapter,part,points,comment,answer\n"
ROWS = "s01,05,Part 05.1,1.5,Well tried.,\ns02,05,Part 05.2,0.25,Read the goal again.,\n"
# These files contain the moment of the run, or differences from an earlier run, so two runs write different
# files.
TIMED = {".grading", "results", "junit.xml", "class.html", "changes.csv"}


def _run(folder: Path, out: Path, *words: str) -> subprocess.Popen[bytes]:
    command = [COURSE, "grade", folder, "--out", out, "--validate", "none", *words]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def _grade(folder: Path, out: Path, *words: str) -> float:
    """Run `course grade` until its end, and return the duration in s."""
    began = time.monotonic()
    assert _run(folder, out, *words).wait(timeout=200) in (0, 3)
    return time.monotonic() - began


def _reports(out: Path) -> dict[str, str]:
    """Return a digest of each report, without the temporary files of a killed run."""
    files = [
        path for path in out.rglob("*") if path.is_file() and path.relative_to(out).parts[0] not in TIMED
    ]
    return {
        str(path.relative_to(out)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in files
        if not path.name.startswith(".")
    }


def _kill(process: subprocess.Popen[bytes], after: float) -> None:
    """Kill the command after `after` s, and wait until no process of the command is left."""
    with suppress(subprocess.TimeoutExpired):
        process.wait(after)
    family = descendants(process.pid)
    process.send_signal(signal.SIGKILL)
    process.wait()
    eventually(lambda: not any(os.path.exists(f"/proc/{pid}/exe") for pid in family), timeout=30)


def _prepare(out: Path, whole: Path) -> None:
    """Make a folder with the file overrides.csv, and with a copy of the secret in the folder `whole`.

    With the same secret, the checks draw the same inputs, so their reports have the same text.
    """
    (out / ".grading").mkdir(parents=True)
    (out / "overrides.csv").write_text(HEAD + ROWS)
    shutil.copy(whole / ".grading" / "secret", out / ".grading" / "secret")


@pytest.fixture(scope="module")
def submissions(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write four submissions: two wrong answers, a right answer, and a blank notebook."""
    folder = tmp_path_factory.mktemp("submissions")
    for student, answer in {"s01": WRONG, "s02": f"# 2{WRONG}", "s03": None, "s04": ""}.items():
        hand_in(folder, student, answers=BLANK if answer is None else {**BLANK, "05.1": answer})
    return folder


@pytest.mark.parametrize("again", [False, True], ids=["grading", "reports"])
def test_kills_during_a_run(submissions: Path, tmp_path: Path, again: bool) -> None:
    """After each kill, the next run writes the same points and comments as a run without a kill.

    If `again` is true, all grades are already stored, so the killed run only writes the reports.
    """
    whole = tmp_path / "whole"
    whole.mkdir()
    (whole / "overrides.csv").write_text(HEAD + ROWS)
    took = _grade(submissions, whole)
    took = _grade(submissions, whole) if again else took
    expected = _reports(whole)
    out = tmp_path / "out"
    for number in range(TIMES):
        if not again:
            out = tmp_path / f"out{number}"
        if not out.exists():
            _prepare(out, whole)
            if again:
                _grade(submissions, out)
        moment = random.uniform(0.1, took)  # noqa: S311 -- not a secret
        _kill(_run(submissions, out), moment)
        assert (out / "overrides.csv").read_text() == HEAD + ROWS, f"killed after {moment:.2f} s"
        _grade(submissions, out)
        assert _reports(out) == expected, f"killed after {moment:.2f} s"


def test_kills_during_a_review(submissions: Path, tmp_path: Path) -> None:
    """After each kill, overrides.csv has all confirmed changes, and `course grade` uses these changes."""
    out = tmp_path / "out"
    _grade(submissions, out)
    confirmed: dict[int, tuple[float, str]] = {}
    count = 0
    for _ in range(TIMES):
        command = [COURSE, "review", out, "--no-browser"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            assert process.stdout
            url, _, token = process.stdout.readline().split()[-1].partition("/?token=")
            own = {"Authorization": f"token {token}"}
            moment = random.uniform(0.0, 1.0)  # noqa: S311 -- not a secret
            threading.Timer(moment, process.kill).start()
            pending = None
            with suppress(OSError, http.client.HTTPException):
                while True:
                    count += 1
                    number = count % 4
                    pending = number, (count % 100 / 100, f"Comment {count}: {'x' * 3000}")
                    points, comment = pending[1]
                    sent = {"number": number, "points": str(points), "comment": comment}
                    assert ask(f"{url}/save", sent, **own)[0] == 200
                    confirmed[number] = pending[1]
        rows = read_overrides(out).rows
        found = {(row.points, row.comment) for row in rows.values()}
        allowed = {number: {value} for number, value in confirmed.items()}
        if pending:
            allowed.setdefault(pending[0], set()).add(pending[1])
        assert len(rows) >= len(confirmed)
        for number in confirmed:
            assert found & allowed[number], f"killed after {moment:.2f} s"
    _grade(submissions, out)
    stored = (out / "overrides.csv").read_bytes()
    for row in read_overrides(out).rows.values():
        assert row.comment in (out / "feedback" / f"{row.student}.html").read_text("utf-8")
    _grade(submissions, out, "--fresh")
    assert (out / "overrides.csv").read_bytes() == stored
