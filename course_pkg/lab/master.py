"""The master of a `course` command: the master at ROS_MASTER_URI if it is set, otherwise a private master."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from course_pkg.ros.process.roscore import Roscore


@contextmanager
def master_of_this_command() -> Iterator[None]:
    """Run the block with a running master; ROS_MASTER_URI contains the master's address."""
    if os.environ.get("ROS_MASTER_URI"):
        yield
        return
    with Roscore() as master, _named(master.uri):
        yield


@contextmanager
def starting_master(port: int) -> Iterator[Callable[[], object]]:
    """Set ROS_MASTER_URI, and start a master on `port` in the background.

    The yielded function waits until the master answers, and raises the exceptions of Roscore.start().
    """
    if os.environ.get("ROS_MASTER_URI"):
        yield lambda: None
        return
    # imported here, because the import takes 5 ms and `course run` does not need it
    from concurrent.futures import ThreadPoolExecutor

    master = Roscore(port)
    with ThreadPoolExecutor(max_workers=1) as pool, _named(f"http://localhost:{port}"):
        start = pool.submit(master.start)
        try:
            yield start.result
        finally:
            start.exception()  # wait for the end of the start, because stop() works only after it
            master.stop()


@contextmanager
def _named(uri: str) -> Iterator[None]:
    os.environ["ROS_MASTER_URI"] = uri
    try:
        yield
    finally:
        del os.environ["ROS_MASTER_URI"]
