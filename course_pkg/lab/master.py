"""The master of a command of `course`: the user's own where ROS_MASTER_URI names one, else a private one."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from course_pkg.graph.master import PrivateMaster
from course_pkg.lab.ports import free_port


@contextmanager
def master_of_this_command() -> Iterator[None]:
    """Run the block with a master that answers, its address in ROS_MASTER_URI."""
    if os.environ.get("ROS_MASTER_URI"):
        yield
        return
    with PrivateMaster() as master, _named(master.uri):
        yield


@contextmanager
def master_coming_up() -> Iterator[Callable[[], object]]:
    """Set ROS_MASTER_URI to a master's address at once, and yield a function that waits until it answers."""
    if os.environ.get("ROS_MASTER_URI"):
        yield lambda: None
        return
    from concurrent.futures import ThreadPoolExecutor  # 5 ms that `course run` need not spend

    port = free_port()
    master = PrivateMaster(port)
    with ThreadPoolExecutor(max_workers=1) as pool, _named(f"http://localhost:{port}"):
        start = pool.submit(master.start)
        try:
            yield start.result
        finally:
            start.exception()  # waits: what is half up cannot be ended
            master.stop()


@contextmanager
def _named(uri: str) -> Iterator[None]:
    os.environ["ROS_MASTER_URI"] = uri
    try:
        yield
    finally:
        del os.environ["ROS_MASTER_URI"]
