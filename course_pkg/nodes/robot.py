"""The node `robot`: a moving arm that publishes its joint states on the topic `joint_states`."""

from __future__ import annotations

import math
import time
from typing import NamedTuple

import rospy
from sensor_msgs.msg import JointState

from course_pkg.ros.node.program import number_parameter, start_node, undisturbed

RATE = 20.0  # The robot publishes at this rate in Hz.


class Joint(NamedTuple):
    """A joint that swings between `middle - reach` and `middle + reach` (rad); `period` is in s."""

    name: str
    middle: float
    reach: float
    period: float

    def position(self, at: float) -> float:
        """Return the joint's angle in rad at the time `at` (s since the start)."""
        return self.middle + self.reach * math.sin(math.tau * at / self.period)

    def velocity(self, at: float) -> float:
        """Return the joint's angular velocity in rad/s at the time `at` (s since the start)."""
        return self.reach * math.tau / self.period * math.cos(math.tau * at / self.period)


ARM = (
    Joint("base", 0.0, 1.2, 8.0),
    Joint("shoulder", 0.4, 0.6, 5.0),
    Joint("elbow", -0.8, 0.9, 3.2),
    Joint("wrist", 0.1, 0.3, 2.0),
)


def main() -> None:
    """Publish the joint state until the node is shut down; the parameter ~rate (default 20) is in Hz."""
    if not start_node("robot"):
        return
    rate = rospy.Rate(number_parameter("~rate", RATE, 0.1, 1000.0))
    with undisturbed():
        publisher = rospy.Publisher("joint_states", JointState, queue_size=10, tcp_nodelay=True)
    started = time.monotonic()
    while not rospy.is_shutdown():
        message = joint_state(time.monotonic() - started)
        message.header.stamp = rospy.Time.now()
        publisher.publish(message)
        try:
            rate.sleep()
        except rospy.ROSInterruptException:  # The node was shut down during the sleep.
            return


def joint_state(at: float) -> JointState:
    """Return the joints' positions (rad) and velocities (rad/s) at the time `at` (s since the start)."""
    return JointState(
        name=[joint.name for joint in ARM],
        position=[joint.position(at) for joint in ARM],
        velocity=[joint.velocity(at) for joint in ARM],
    )
