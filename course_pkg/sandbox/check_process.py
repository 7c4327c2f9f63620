"""The check runner: a trusted process that runs the check of one part of an exercise.

Each check runs in a new check runner, a forked process that enters the network namespace of the part.
"""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Callable
from dataclasses import replace
from typing import NoReturn

from course_pkg.checking.parts import find
from course_pkg.checking.processes.runner import record, run_check
from course_pkg.checking.report import Report, Verdict
from course_pkg.errors import ChannelError
from course_pkg.sandbox.command_runner import SplitChannel
from course_pkg.sandbox.isolation import Isolation
from course_pkg.sandbox.job import PartJob
from course_pkg.sandbox.linux import namespaces, users


def check_part(
    job: PartJob,
    network: int,
    port: int,
    client: socket.socket,
    commands: socket.socket,
    out: int,
    *,
    kernel: Callable[[], int],
    isolation: Isolation,
) -> NoReturn:
    """Run the check of the job, and write its record to the file `out`, as one JSON object.

    `kernel` is a function that returns the id of the process in which the answer runs.
    """
    if isolation.namespaces:
        namespaces.enter(network, namespaces.NETWORK)
    if isolation.users:
        users.become(isolation.users.trusted)
    os.environ.update(
        ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOSTNAME="localhost", COURSE_SEED=str(job.seed)
    )
    try:
        report = run_check(SplitChannel(client, commands), only=job.check, kernel=kernel)
    except ChannelError as error:
        report = replace(
            _undecided(job, f"The kernel gave no valid answer: {error}."), verdict=Verdict.FAILED
        )
    except Exception as error:  # noqa: BLE001 -- a submission that breaks the graph must get no points
        report = _undecided(job, f"The check could not be run ({type(error).__name__}: {error}).")
    with os.fdopen(out, "w") as file:
        json.dump(record(report, job.seed), file)
    os._exit(0)


def _undecided(job: PartJob, note: str) -> Report:
    part = find(job.check)
    return Report(job.check, Verdict.UNDECIDED, part.goal, 0, part.points, note=note)
