"""The checks of chapter 16: an action server, an action client, a parameter, and a whole node."""

from course_pkg.chapters.ch16_go_further.checks.action_client import bounded_goal
from course_pkg.chapters.ch16_go_further.checks.action_server import executed_goal
from course_pkg.chapters.ch16_go_further.checks.parameters import speed_parameter
from course_pkg.chapters.ch16_go_further.checks.parcel_robot import parcel_robot

__all__ = ["bounded_goal", "executed_goal", "parcel_robot", "speed_parameter"]
