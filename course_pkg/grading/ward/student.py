"""The student's side of one part: cells as a kernel runs them, then the desk that a judge asks.

This process belongs to what it runs: nothing that it says earns a point.
"""

from __future__ import annotations

import json
import os
import random
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from course_pkg.grading.ward.job import PartJob

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

AGAIN = 0.5  # s between alarms, for a cell that swallows the first
LINE = 2000  # characters of an error that are passed on

Say = Callable[[dict[str, object]], None]


class CellTooSlow(BaseException):
    """A cell has had its time."""


def prepare() -> InteractiveShell:
    """Import what submissions use, and make the shell that runs them; the forks have it all at once."""
    import rosmaster.master  # noqa: F401
    import rospy  # noqa: F401
    from IPython.core.history import HistoryManager
    from IPython.core.interactiveshell import InteractiveShell

    from course_pkg import ServicePanel, check, join, predict  # noqa: F401
    from course_pkg.graph import Island, NodeProcess  # noqa: F401
    from course_pkg.interfaces import message_type, service_type

    HistoryManager.enabled = False  # type: ignore[assignment] # no file, no thread
    for kind in ("geometry_msgs/Twist", "sensor_msgs/Image", "std_msgs/Float64", "turtlesim/Pose"):
        message_type(kind)
    for kind in ("std_srvs/SetBool", "course_pkg/geometry", "turtlesim/Spawn"):
        service_type(kind)
    shell = InteractiveShell.instance(colors="NoColor")
    shell.run_cell("import rospy\ndel rospy", store_history=False)
    return shell


def attend(job: PartJob, shell: InteractiveShell, say: Say) -> None:
    """Run the cells of `job`, then its check; errors of cells are said, and stop nothing."""
    _reseed()
    _run(shell, "before", job.before, job.settling, say)
    for number, source in enumerate(job.answers, 1):
        _run(shell, f"answer {number}", source, job.patience, say)
    _run(shell, "after", job.after, job.settling, say)
    from course_pkg.examiner.desk import check

    check(job.check)


def speaker(descriptor: int) -> Say:
    """Return what writes a line of JSON to `descriptor`, and never waits for a reader."""
    os.set_blocking(descriptor, False)

    def say(words: dict[str, object]) -> None:
        with suppress(OSError):
            os.write(descriptor, json.dumps(words).encode() + b"\n")

    return say


def _run(shell: InteractiveShell, name: str, source: str, seconds: float, say: Say) -> None:
    if not source.strip():
        return
    _make_room(source)
    with _alarm(seconds):
        result = shell.run_cell(source, store_history=False)
    error = result.error_before_exec or result.error_in_exec
    if isinstance(error, CellTooSlow):
        say({"cell": name, "error": f"The cell was not done after {seconds:g} s, and was broken off."})
    elif error is not None:
        say({"cell": name, "error": f"{type(error).__name__}: {error}"[:LINE]})


def _make_room(source: str) -> None:
    """Make the folder of a file that a cell writes: in the notebook, a cell not run here has made it."""
    first, _, _ = source.partition("\n")
    if first.startswith("%%writefile "):
        with suppress(OSError):
            Path(first.split()[-1]).parent.mkdir(parents=True, exist_ok=True)


@contextmanager
def _alarm(seconds: float) -> Iterator[None]:
    def ring(*_: object) -> None:
        raise CellTooSlow

    signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds, AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def _reseed() -> None:
    """Draw chance anew: every fork would begin with the same."""
    random.seed()
