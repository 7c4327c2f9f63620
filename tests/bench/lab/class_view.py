"""Measures how long a result takes from a student's outbox to the teacher's page, in a browser."""

from __future__ import annotations

import random
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import ExitStack
from pathlib import Path

from course_pkg.ports import free_port
from course_pkg.sharing.outbox import FOLDER, Outbox
from course_pkg.sharing.sender import Sender
from tests.browser.chromium import chromium
from tests.class_view.classes import tokens_in
from tests.support import eventually

STUDENTS = 60
RATE = 10  # The senders send this many results per second.
SECONDS = 30
PARTS = ("05.1", "05.2", "05.3", "05.4")
VERDICTS = ("passed", "not yet", "not yet")
# After each new version of the page, this script records the time (ms since 1970) of the first frame that the
# browser draws.
WATCH = """
() => {
  window.shown = [];
  new MutationObserver(() => {
    const version = Number(document.body.dataset.version);
    requestAnimationFrame(() => setTimeout(() => window.shown.push([version, Date.now()])));
  }).observe(document.body, { attributes: true, attributeFilter: ["data-version"] });
}
"""


def live_main() -> None:
    """Print the median, the 95th percentile and the maximum time for 60 senders and 10 results per second."""
    choice = random.Random(60)  # noqa: S311 -- a class, not secrets
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        data, port = Path(folder, "data"), free_port()
        command = [sys.executable, "-m", "course_pkg.cli", "class", "--data", data]
        command += ["--students", str(STUDENTS), "--port", str(port)]
        with (
            subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as service,
            ExitStack() as stack,
            chromium() as browser,
        ):
            assert service.stdout
            stack.callback(service.kill)
            page = browser.new_page()
            page.goto(service.stdout.readline().split()[-1])
            page.wait_for_selector("body[data-version]")
            page.evaluate(WATCH)
            senders = [
                Sender(f"http://127.0.0.1:{port}", token, Outbox(Path(folder, student, FOLDER)), print)
                for student, token in tokens_in(data).items()
            ]
            threads = [threading.Thread(target=sender.run) for sender in senders]
            for thread in threads:
                thread.start()
            for sender in senders:
                stack.callback(sender.stopped.set)
            written: list[float] = []
            outboxes = [Outbox(Path(folder, student, FOLDER)) for student in tokens_in(data)]
            began = time.monotonic()
            while (now := time.monotonic()) < began + SECONDS:
                report = {"check": choice.choice(PARTS), "verdict": choice.choice(VERDICTS)}
                assertions = [{"text": "area", "holds": False, "hint": choice.choice("ABCDEFG") * 40}]
                choice.choice(outboxes).put({**report, "assertions": assertions})
                written.append(time.time() * 1000)
                time.sleep(max(0.0, began + len(written) / RATE - now))
            eventually(lambda: page.evaluate("Number(document.body.dataset.version)") == len(written))
            shown = page.evaluate("window.shown")
            stack.close()
            for thread in threads:
                thread.join(20)
    # Results can arrive in a different order. So the time of the n-th result is the time when the page shows
    # n results.
    times = sorted(
        next(when for version, when in shown if version > number) - put for number, put in enumerate(written)
    )
    print(
        f"{len(times)} results of {STUDENTS} students to the page: median {statistics.median(times):.0f} ms, "
        f"95 % {times[int(0.95 * len(times))]:.0f} ms, maximum {times[-1]:.0f} ms"
    )
