"""The judge of one part, forked when the student's desk calls: a trusted process in the part's network."""

from __future__ import annotations

import json
import os
import socket
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

from course_pkg.errors import LinkError
from course_pkg.examiner.judge import judge, record
from course_pkg.examiner.parts import find
from course_pkg.examiner.report import Report, Verdict
from course_pkg.grading import namespaces
from course_pkg.grading.ward.errands import SplitLink
from course_pkg.grading.ward.job import PartJob


def judge_part(
    job: PartJob,
    network: int,
    port: int,
    desk: socket.socket,
    errands: socket.socket,
    out: int,
    *,
    walls: bool,
) -> NoReturn:
    """Carry out the check of `job` and write its record to `out`, as one JSON object."""
    if walls:
        namespaces.enter(network, namespaces.NETWORK)
    os.environ.update(
        ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOSTNAME="localhost", COURSE_SEED=str(job.seed)
    )
    try:
        with tempfile.TemporaryDirectory(prefix="course-judge-") as folder:
            report = judge(SplitLink(desk, errands), Path(folder), only=job.check)
    except LinkError as error:
        report = replace(
            _undecided(job, f"The kernel gave no answer that counts: {error}."), verdict=Verdict.FAILED
        )
    except Exception as error:  # noqa: BLE001 -- whatever a submission made of the graph, it earns nothing by it
        report = _undecided(job, f"The check could not be carried out ({type(error).__name__}: {error}).")
    with os.fdopen(out, "w") as file:
        json.dump(record(report, job.seed), file)
    os._exit(0)


def _undecided(job: PartJob, note: str) -> Report:
    part = find(job.check)
    return Report(job.check, Verdict.UNDECIDED, part.goal, 0, part.points, note=note)
