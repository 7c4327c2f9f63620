"""Starting rospy in a notebook's kernel: a second time in one process, and without the kernel's logging.

rospy is made to end once: after signal_shutdown(), an interrupted rospy.spin(), or another node with the
same name, it stays shut down, and init_node() does nothing and reports nothing. In a notebook that costs the
student everything that the kernel holds. So what rospy keeps about having ended is put back to how it was
before the first init_node().

init_node() also closes and removes the root logger's handlers, sends every library's messages to the node's
log file, and prints from any thread into whichever cell is running.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType

import rospy
from rospy import client, core
from rospy.impl import rosout, tcpros_base
from rospy.impl.registration import get_service_manager, get_topic_manager

ARGUMENTS = "_init_node_args"  # where rospy keeps the arguments of the first call
BEGINNING: tuple[tuple[ModuleType, str, object], ...] = (
    (core, "_shutdown_flag", False),
    (core, "_in_shutdown", False),
    (core, "_client_ready", False),
    (client, ARGUMENTS, None),
    (tcpros_base, "_tcpros_server", None),
    (rosout, "_rosout_pub", None),
)
LOGGERS = ("rospy", "rosout", "rosgraph", "xmlrpc", "roslib")  # those that belong to ROS


def can_begin_again() -> bool:
    """Return whether this rospy is built as begin_again() expects."""
    known = all(hasattr(module, name) for module, name, _ in BEGINNING)
    return known and hasattr(get_topic_manager(), "closed")


def begin_again() -> None:
    """Make rospy ready for init_node(), with no registrations; the old node has to be shut down."""
    assert rospy.core.is_shutdown()
    for module, name, value in BEGINNING:
        setattr(module, name, value)
    get_topic_manager().closed = False
    get_service_manager().unregister_all()
    printer = logging.getLogger("rosout")
    for handler in printer.handlers[:]:
        if isinstance(handler, rosout.RosOutHandler):
            printer.removeHandler(handler)


def allow_init_node() -> None:
    """Let each further rospy.init_node() change nothing, as in a cell that is also a program of its own.

    rospy compares the arguments with those of the first call, and raises ROSException if they differ.
    """
    setattr(client, ARGUMENTS, _AnyArguments())


class _AnyArguments:
    """Equals every value."""

    def __eq__(self, other: object) -> bool:
        return True

    def __hash__(self) -> int:
        return 0


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
        for name in LOGGERS:
            _separate(logging.getLogger(name), new)


def _separate(logger: logging.Logger, files: list[logging.Handler]) -> None:
    """Make a logger of ROS write to its file, and print only what comes from the main thread, the cell's."""
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
