"""The node `dying_server`.

A call of the service `dying` ends the process without a response, like a crash.
"""

from __future__ import annotations

import os
from typing import NoReturn

import rospy
from std_srvs.srv import Trigger

from course_pkg.ros.node.preparation import prepare_node


def main() -> None:
    """Offer the service `dying` until the first call ends the process."""
    rospy.init_node("dying_server")
    prepare_node()
    rospy.Service("dying", Trigger, _die)
    rospy.spin()


def _die(_: object) -> NoReturn:
    os._exit(1)  # The process ends without a clean-up, so the registration at the master remains.
