"""The master that a command of `course` runs with."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def master_of_this_command() -> Iterator[str]:
    """Yield the address of the user's own master if ROS_MASTER_URI names one, else of a private one."""
    given = os.environ.get("ROS_MASTER_URI")
    if given:
        yield given
        return
    from course_pkg.graph.master import PrivateMaster

    with PrivateMaster() as master:
        os.environ["ROS_MASTER_URI"] = master.uri
        try:
            yield master.uri
        finally:
            del os.environ["ROS_MASTER_URI"]
