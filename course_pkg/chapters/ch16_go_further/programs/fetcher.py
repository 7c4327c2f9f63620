"""The node `fetcher`: a robot with the action `fetch`; the robot fetches the things of a goal one by one.

A goal contains the number of things (`things`), and the time for each thing in s (`seconds`). The robot
publishes feedback after each thing. The result contains the number of fetched things, even after a
cancellation.
"""

from __future__ import annotations

import actionlib
import rospy

from course_pkg.msg import FetchAction, FetchFeedback, FetchGoal, FetchResult
from course_pkg.ros.node.program import start_node, undisturbed

LONGEST = 60.0  # LONGEST is the maximum time in s for a single thing.


def fetch(goal: FetchGoal, server: actionlib.SimpleActionServer) -> None:
    """Execute the goal `goal`; a goal with invalid numbers is aborted.

    If the goal is cancelled, the robot stops after the current thing.
    """
    if goal.things < 0 or not 0.0 <= goal.seconds <= LONGEST:
        server.set_aborted(
            FetchResult(), (f"the goal is impossible: {goal.things} things in {goal.seconds:g} s each")
        )
        return
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched))
            return
        rospy.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched + 1))
    server.set_succeeded(FetchResult(goal.things))


def main() -> None:
    """Execute goals until the node is shut down."""
    if not start_node("fetcher"):
        return
    with undisturbed():
        server: actionlib.SimpleActionServer = actionlib.SimpleActionServer(
            "fetch", FetchAction, lambda goal: fetch(goal, server), auto_start=False
        )
        server.start()
    rospy.spin()
