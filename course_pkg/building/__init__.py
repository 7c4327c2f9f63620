"""A catkin workspace of the student's own, and what its build says. Knows no master and no rospy."""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.building.cpp import missing_for_cpp
    from course_pkg.building.explanation import explain
    from course_pkg.building.fault import Fault
    from course_pkg.building.workspace import Workspace, my_workspace

__all__ = ["Fault", "Workspace", "explain", "missing_for_cpp", "my_workspace"]

__getattr__ = lazily(
    __name__,
    {
        "cpp": "missing_for_cpp",
        "explanation": "explain",
        "fault": "Fault",
        "workspace": "Workspace my_workspace",
    },
)
