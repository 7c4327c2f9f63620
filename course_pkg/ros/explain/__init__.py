"""Explain an error: its cause, what to do, and the chapter about it. This package works without rospy.

`known` finds the explanation of one error message. `explain` accepts an exception, or any text that contains
an error message.
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
