"""What an error means, what to do about it, and where the course teaches it; needs no rospy itself.

`known` looks up the words of one error. `explain` takes whatever a student has in hand, an exception or text.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.graph.explanations.asking import explain
    from course_pkg.graph.explanations.explanation import Explanation
    from course_pkg.graph.explanations.finding import known

__all__ = ["Explanation", "explain", "known"]

__getattr__ = lazily(
    __name__,
    {"asking": "explain", "explanation": "Explanation", "finding": "known"},
)
