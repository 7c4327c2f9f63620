"""The node `spawn_turtle_plus`: makes MyTurtle, which then goes as turtle1 goes."""

from __future__ import annotations

import sys

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty

from course_pkg.graph import prepare_node
from course_pkg.srv import ChangeSpeed
from course_pkg.turtlesim.spawning import NAME, require, spawn_or_exit

SPEED = 10.0  # m/s


def main() -> None:
    """Spawn, have turtle1 change over and hurry, and pass on whatever it is told from then on."""
    rospy.init_node("spawn_turtle_plus")
    prepare_node()
    spawn_or_exit()
    for service in ("toggle_forward", "change_speed"):
        require(service)
    try:
        rospy.ServiceProxy("toggle_forward", Empty)()
        rospy.ServiceProxy("change_speed", ChangeSpeed)(SPEED)
    except rospy.ServiceException as error:
        sys.exit(f"turtle1's driver refused: {error}")
    publisher = rospy.Publisher(f"{NAME}/cmd_vel", Twist, queue_size=1)
    rospy.Subscriber("turtle1/cmd_vel", Twist, publisher.publish, queue_size=1)
    rospy.spin()
