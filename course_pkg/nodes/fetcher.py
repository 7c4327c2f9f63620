"""The node `fetcher`: a robot that fetches things one after the other, as the action `fetch`.

A goal says how many `things`, and how long each takes. The feedback is sent after each thing, and the result
says how many were fetched, also of a goal that was cancelled.
"""

from __future__ import annotations

from typing import Any

import actionlib
import rospy

from course_pkg.graph.program import undisturbed
from course_pkg.graph.stepping import step_onto_graph
from course_pkg.msg import FetchAction, FetchFeedback, FetchResult

LONGEST = 60.0  # s for a single thing


def fetch(goal: Any, server: Any) -> None:  # noqa: ANN401 -- classes that catkin and actionlib bring
    """Fetch what `goal` asks for, and stop between two things when that is asked for."""
    if goal.things < 0 or not 0.0 <= goal.seconds <= LONGEST:
        server.set_aborted(FetchResult(), f"no robot fetches {goal.things} things in {goal.seconds:g} s each")
        return
    for fetched in range(goal.things):
        if server.is_preempt_requested():
            server.set_preempted(FetchResult(fetched))
            return
        rospy.sleep(goal.seconds)
        server.publish_feedback(FetchFeedback(fetched + 1))
    server.set_succeeded(FetchResult(goal.things))


def main() -> None:
    """Carry out goals until the node is shut down."""
    if not step_onto_graph("fetcher"):
        return
    with undisturbed():
        server: Any = actionlib.SimpleActionServer(
            "fetch", FetchAction, lambda goal: fetch(goal, server), auto_start=False
        )
        server.start()
    rospy.spin()
