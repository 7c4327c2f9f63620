"""Beginning again in a process whose node was shut down.

rospy is made to end once: after signal_shutdown(), an interrupted rospy.spin(), or another node with the
same name, it stays shut down, and init_node() does nothing without a word. In a notebook that costs the
student everything that the kernel holds. So what rospy keeps about having ended is put back to how it was
before the first init_node().
"""

from __future__ import annotations

import logging
from types import ModuleType

import rospy
from rospy import client, core
from rospy.impl import rosout, tcpros_base
from rospy.impl.registration import get_service_manager, get_topic_manager

BEGINNING: tuple[tuple[ModuleType, str, object], ...] = (
    (core, "_shutdown_flag", False),
    (core, "_in_shutdown", False),
    (core, "_client_ready", False),
    (client, "_init_node_args", None),
    (tcpros_base, "_tcpros_server", None),
    (rosout, "_rosout_pub", None),
)


def can_begin_again() -> bool:
    """Whether this rospy is built as this module expects."""
    known = all(hasattr(module, name) for module, name, _ in BEGINNING)
    return known and hasattr(get_topic_manager(), "closed")


def begin_again() -> None:
    """Have rospy ready for init_node(), with nothing on its books; the old node has to be shut down."""
    assert rospy.core.is_shutdown()
    for module, name, value in BEGINNING:
        setattr(module, name, value)
    get_topic_manager().closed = False
    get_service_manager().unregister_all()
    printer = logging.getLogger("rosout")
    for handler in printer.handlers[:]:
        if isinstance(handler, rosout.RosOutHandler):
            printer.removeHandler(handler)
