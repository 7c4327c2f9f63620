"""The student's catkin workspace, and explanations of error messages from its build.

This package does not need rospy.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.workspace.cpp_support import missing_for_cpp
    from course_pkg.workspace.explanation import explain
    from course_pkg.workspace.fault import Fault
    from course_pkg.workspace.own_packages import OwnPackages, make_own_workspace, own_workspace

__all__ = [
    "Fault",
    "OwnPackages",
    "explain",
    "make_own_workspace",
    "missing_for_cpp",
    "own_workspace",
]

__getattr__ = lazily(
    __name__,
    {
        "cpp_support": "missing_for_cpp",
        "explanation": "explain",
        "fault": "Fault",
        "own_packages": "OwnPackages make_own_workspace own_workspace",
    },
)
