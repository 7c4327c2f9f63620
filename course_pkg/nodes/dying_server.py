"""The node `dying_server`: takes a call on `dying` and ends before it answers, as a crash would."""

from __future__ import annotations

import os
from typing import NoReturn

import rospy
from std_srvs.srv import Trigger


def main() -> None:
    """Serve until the first call."""
    rospy.init_node("dying_server")
    rospy.Service("dying", Trigger, _die)
    rospy.spin()


def _die(_: object) -> NoReturn:
    os._exit(1)  # no clean-up, no farewell to the master: a crash
