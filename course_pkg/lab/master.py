"""The master of a `course` command: the one at ROS_MASTER_URI if the user has set it, else a private one."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from course_pkg.ros.process.roscore import Roscore


@contextmanager
def master_of_this_command() -> Iterator[None]:
    """Run the block with a master that answers, and with its address in ROS_MASTER_URI."""
    if os.environ.get("ROS_MASTER_URI"):
        yield
        return
    with Roscore() as master, _named(master.uri):
        yield


@contextmanager
def starting_master(port: int) -> Iterator[Callable[[], object]]:
    """Set ROS_MASTER_URI and yield immediately, while a master starts on `port`.

    The yielded function waits until the master answers; it raises what Roscore.start() raises.
    """
    if os.environ.get("ROS_MASTER_URI"):
        yield lambda: None
        return
    from concurrent.futures import ThreadPoolExecutor  # here, because `course run` need not spend 5 ms on it

    master = Roscore(port)
    with ThreadPoolExecutor(max_workers=1) as pool, _named(f"http://localhost:{port}"):
        start = pool.submit(master.start)
        try:
            yield start.result
        finally:
            start.exception()  # wait first: a master that is still starting cannot be stopped
            master.stop()


@contextmanager
def _named(uri: str) -> Iterator[None]:
    os.environ["ROS_MASTER_URI"] = uri
    try:
        yield
    finally:
        del os.environ["ROS_MASTER_URI"]
