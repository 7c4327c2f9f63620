"""The node `spawn_turtle_plus`: spawns MyTurtle, and sends the velocities of turtle1 also to MyTurtle."""

from __future__ import annotations

import sys

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty

from course_pkg.chapters.ch09_drive_turtles.programs.spawn_turtle import NAME, require, spawn_or_exit
from course_pkg.ros import prepare_node
from course_pkg.srv import ChangeSpeed

SPEED = 2.0  # The speed is in m/s.


def main() -> None:
    """Spawn MyTurtle, toggle turtle1's direction, set its speed, and send its velocities to MyTurtle."""
    rospy.init_node("spawn_turtle_plus")
    prepare_node()
    spawn_or_exit()
    for service in ("toggle_forward", "change_speed"):
        require(service)
    try:
        rospy.ServiceProxy("toggle_forward", Empty)()
        rospy.ServiceProxy("change_speed", ChangeSpeed)(SPEED)
    except rospy.ServiceException as error:
        sys.exit(f"the driver of turtle1 refused the call: {error}")
    publisher = rospy.Publisher(f"{NAME}/cmd_vel", Twist, queue_size=1)
    rospy.Subscriber("turtle1/cmd_vel", Twist, publisher.publish, queue_size=1)
    rospy.spin()
