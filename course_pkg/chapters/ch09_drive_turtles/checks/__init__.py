"""The checks of chapter 09: programs that spawn and drive turtles, and a launch file."""

from course_pkg.chapters.ch09_drive_turtles.checks.follow import bring_a_second_turtle
from course_pkg.chapters.ch09_drive_turtles.checks.improved import change_speed_and_stop
from course_pkg.chapters.ch09_drive_turtles.checks.launch_file import two_turtles_or_one
from course_pkg.chapters.ch09_drive_turtles.checks.rate import change_the_rate
from course_pkg.chapters.ch09_drive_turtles.checks.spawn import wait_and_spawn
from course_pkg.chapters.ch09_drive_turtles.checks.toggle import toggle_direction

__all__ = [
    "bring_a_second_turtle",
    "change_speed_and_stop",
    "change_the_rate",
    "toggle_direction",
    "two_turtles_or_one",
    "wait_and_spawn",
]
