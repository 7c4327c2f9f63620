"""The node `dying_server`: takes a call on `dying` and ends before it answers, as a crash would."""

from __future__ import annotations

import os
from typing import NoReturn

import rospy
from std_srvs.srv import Trigger

from course_pkg.graph.preparation import prepare_node


def main() -> None:
    """Serve until the first call."""
    rospy.init_node("dying_server")
    prepare_node()
    rospy.Service("dying", Trigger, _die)
    rospy.spin()


def _die(_: object) -> NoReturn:
    os._exit(1)  # no clean-up, no farewell to the master: a crash
