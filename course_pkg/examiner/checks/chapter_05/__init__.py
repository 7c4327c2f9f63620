"""The checks of chapter 05: the student's servers, called from outside."""

from course_pkg.examiner.checks.chapter_05.boxes import a_box_that_cannot_be, area_and_volume
from course_pkg.examiner.checks.chapter_05.memory import a_counter_that_resets, a_switch_that_tells
from course_pkg.examiner.checks.chapter_05.opening import open_and_close

__all__ = [
    "a_box_that_cannot_be",
    "a_counter_that_resets",
    "a_switch_that_tells",
    "area_and_volume",
    "open_and_close",
]
