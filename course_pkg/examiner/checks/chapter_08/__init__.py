"""The checks of chapter 08: turtles are made, driven, steered, and go alike."""

from course_pkg.examiner.checks.chapter_08.launching import two_turtles_or_one
from course_pkg.examiner.checks.chapter_08.pairs import bring_a_second_turtle, go_alike
from course_pkg.examiner.checks.chapter_08.spawning import wait_and_spawn
from course_pkg.examiner.checks.chapter_08.steering import change_the_rate, change_the_speed, start_and_stop
from course_pkg.examiner.checks.chapter_08.toggling import change_over

__all__ = [
    "bring_a_second_turtle",
    "change_over",
    "change_the_rate",
    "change_the_speed",
    "go_alike",
    "start_and_stop",
    "two_turtles_or_one",
    "wait_and_spawn",
]
