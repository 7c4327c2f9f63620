"""What the checks of several clients share."""

from course_pkg.examiner import Exam

GEOMETRY = "course_pkg/geometry"
NO_RETURN = "None was returned, as by a function that comes to its end without a return line."


def volumes(exam: Exam, count: int) -> list[float]:
    """Return volumes that a float32 holds exactly, with a fraction, so that rounding shows."""
    return [whole + 0.375 for whole in exam.draw.integers(count, 1000, 9000)]
