"""What an error means, what to do about it, and which chapter teaches it; needs no rospy.

`known` looks up one error message. `explain` accepts an exception, or any text with an error in it.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.ros.explain.explainer import explain
    from course_pkg.ros.explain.explanation import Explanation, known

__all__ = ["Explanation", "explain", "known"]

__getattr__ = lazily(
    __name__,
    {"explainer": "explain", "explanation": "Explanation known"},
)
