"""rospy's logging, without what it does to a notebook's.

init_node() closes and removes the root logger's handlers, sends every library's messages to the node's log
file, and prints from any thread into whichever cell is running.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from contextlib import contextmanager

OURS = ("rospy", "rosout", "rosgraph", "xmlrpc", "roslib")  # the loggers that belong to ROS


@contextmanager
def logging_kept() -> Iterator[None]:
    """Give the root logger its handlers back after the block, and ROS's loggers a file of their own."""
    root = logging.getLogger()
    handlers, level = root.handlers[:], root.level
    try:
        yield
    finally:
        new = [handler for handler in root.handlers if handler not in handlers]
        root.handlers[:] = handlers
        root.setLevel(level)
        for name in OURS:
            _keep_apart(logging.getLogger(name), new)


def _keep_apart(logger: logging.Logger, files: list[logging.Handler]) -> None:
    """Have a logger of ROS write to its file; and print only what the main thread, the cell's own, says."""
    for handler in logger.handlers:
        if type(handler).__name__ == "RosStreamHandler":
            handler.addFilter(_from_main_thread)
    for handler in files:
        if handler not in logger.handlers:
            logger.addHandler(handler)
    logger.setLevel(logger.level or logging.INFO)
    logger.propagate = False


def _from_main_thread(record: logging.LogRecord) -> bool:
    return record.thread == threading.main_thread().ident
