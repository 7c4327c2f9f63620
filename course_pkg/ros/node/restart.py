"""Start rospy in a notebook's kernel, even several times, without changing the kernel's logging.

rospy can start only once in a process. rospy is shut down by signal_shutdown(), by an interrupted
rospy.spin(), and by another node with the same name. After this, a second init_node() does nothing and raises
no error. This module therefore sets rospy's variables to the values that they had before the first
init_node().

init_node() also removes the root logger's handlers. Without these handlers, the log messages of all threads
would appear below the running cell. This module therefore restores the handlers.
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

ARGUMENTS = "_init_node_args"  # This variable of rospy stores the arguments of the first init_node() call.
BEGINNING: tuple[tuple[ModuleType, str, object], ...] = (
    (core, "_shutdown_flag", False),
    (core, "_in_shutdown", False),
    (core, "_client_ready", False),
    (client, ARGUMENTS, None),
    (tcpros_base, "_tcpros_server", None),
    (rosout, "_rosout_pub", None),
)
LOGGERS = ("rospy", "rosout", "rosgraph", "xmlrpc", "roslib")


def can_begin_again() -> bool:
    """Return whether this release of rospy has all variables that begin_again() sets."""
    known = all(hasattr(module, name) for module, name, _ in BEGINNING)
    return known and hasattr(get_topic_manager(), "closed")


def begin_again() -> None:
    """Make rospy ready for another init_node(), and clear rospy's lists of registrations.

    The old node must already be shut down.
    """
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
    """Make every later rospy.init_node() do nothing.

    A cell may contain a whole program that calls rospy.init_node(). If its arguments differed from the
    arguments of the first call, rospy would raise ROSException.
    """
    setattr(client, ARGUMENTS, _AnyArguments())


class _AnyArguments:
    """An object that equals every value."""

    def __eq__(self, other: object) -> bool:
        return True

    def __hash__(self) -> int:
        return 0


@contextmanager
def logging_kept() -> Iterator[None]:
    """Restore the root logger's handlers after the `with` block; only ROS's loggers get the new handlers."""
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
    """Make a ROS logger write to the log file, and print only messages of the main thread."""
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
