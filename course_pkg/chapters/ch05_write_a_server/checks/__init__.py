"""The checks of chapter 05: a separate process calls the student's servers."""

from course_pkg.chapters.ch05_write_a_server.checks.arm import close_for_maintenance
from course_pkg.chapters.ch05_write_a_server.checks.boxes import a_box_that_cannot_be, area_and_volume
from course_pkg.chapters.ch05_write_a_server.checks.memory import a_counter_that_resets, a_switch_that_tells

__all__ = [
    "a_box_that_cannot_be",
    "a_counter_that_resets",
    "a_switch_that_tells",
    "area_and_volume",
    "close_for_maintenance",
]
