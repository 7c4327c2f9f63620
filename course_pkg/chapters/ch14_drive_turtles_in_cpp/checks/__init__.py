"""The checks of chapter 14: the checks of chapter 09 for C++ programs, and checks of callbacks."""

from course_pkg.chapters.ch14_drive_turtles_in_cpp.checks.report import more_threads, own_queue
from course_pkg.chapters.ch14_drive_turtles_in_cpp.checks.session_counter import count_sessions
from course_pkg.chapters.ch14_drive_turtles_in_cpp.checks.turtle_programs import (
    bring_a_second_turtle,
    change_speed_and_stop,
    change_the_rate,
    toggle_direction,
    two_turtles_or_one,
    wait_and_spawn,
)

__all__ = [
    "bring_a_second_turtle",
    "change_speed_and_stop",
    "change_the_rate",
    "count_sessions",
    "more_threads",
    "own_queue",
    "toggle_direction",
    "two_turtles_or_one",
    "wait_and_spawn",
]
