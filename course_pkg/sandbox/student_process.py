"""The student's process of one part: it runs the cells as a kernel does, and then runs the check client.

The student's code controls this process, so no points depend on messages of this process.
"""

from __future__ import annotations

import json
import os
import random
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from course_pkg.sandbox.job import PartJob
from course_pkg.waiting import interrupt_after

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

REPEAT = 0.5  # This is the time in s between two alarms; a cell may catch the first alarm.
LONGEST = 2000  # An error message has at most this number of characters.

Send = Callable[[Mapping[str, str]], None]


class CellTooSlow(BaseException):
    """A cell has reached its time limit."""


def prepare() -> InteractiveShell:
    """Import the modules that submissions use, and return the shell that runs submissions.

    Processes that are forked later need no imports.
    """
    import rosmaster.master  # noqa: F401
    import rospy  # noqa: F401
    from IPython.core.history import HistoryManager
    from IPython.core.interactiveshell import InteractiveShell

    from course_pkg import ServicePanel, check, join, predict  # noqa: F401
    from course_pkg.ros import NodeProcess, PrivateGraph  # noqa: F401
    from course_pkg.types import message_type, service_type

    HistoryManager.enabled = False  # type: ignore[assignment] # a history needs a file and a thread
    for kind in ("geometry_msgs/Twist", "sensor_msgs/Image", "std_msgs/Float64", "turtlesim/Pose"):
        message_type(kind)
    for kind in ("std_srvs/SetBool", "course_pkg/geometry", "turtlesim/Spawn"):
        service_type(kind)
    shell = InteractiveShell.instance(colors="NoColor")
    shell.run_cell("import rospy\ndel rospy", store_history=False)
    return shell


def run_part(job: PartJob, shell: InteractiveShell, send: Send) -> None:
    """Run the cells of a job, and then its check.

    If a cell raises an error, send a message, and run the next cell.
    """
    random.seed()  # Without this line, every forked process would use the same random numbers.
    _run(shell, "before", job.before, job.setup_timeout, send)
    for number, source in enumerate(job.answers, 1):
        _run(shell, f"answer {number}", source, job.answer_timeout, send)
    _run(shell, "after", job.after, job.setup_timeout, send)
    from course_pkg.checking.processes.client import check

    check(job.check)


def message_writer(descriptor: int) -> Send:
    """Return a function that writes messages to a file descriptor as lines of JSON, and that never blocks."""
    os.set_blocking(descriptor, False)

    def send(message: Mapping[str, str]) -> None:
        with suppress(OSError):
            os.write(descriptor, json.dumps(message).encode() + b"\n")

    return send


def _run(shell: InteractiveShell, name: str, source: str, seconds: float, send: Send) -> None:
    if not source.strip():
        return
    _make_folder(source)
    with interrupt_after(seconds, CellTooSlow, REPEAT):
        result = shell.run_cell(source, store_history=False)
    error = result.error_before_exec or result.error_in_exec
    if isinstance(error, CellTooSlow):
        send({"cell": name, "error": f"The cell was stopped because it ran for more than {seconds:g} s."})
    elif error is not None:
        send({"cell": name, "error": f"{type(error).__name__}: {error}"[:LONGEST]})


def _make_folder(source: str) -> None:
    """Create the folder of the file that a cell writes.

    In the notebook, an earlier cell creates this folder.
    """
    first, _, _ = source.partition("\n")
    if first.startswith("%%writefile "):
        with suppress(OSError):
            Path(first.split()[-1]).parent.mkdir(parents=True, exist_ok=True)
