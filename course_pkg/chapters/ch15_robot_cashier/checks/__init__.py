"""The checks of chapter 15: each check starts programs of the student, and provides all other nodes."""

from course_pkg.chapters.ch15_robot_cashier.checks.ask_customer import the_client
from course_pkg.chapters.ch15_robot_cashier.checks.detector import the_detector, the_silent_camera
from course_pkg.chapters.ch15_robot_cashier.checks.launch_file import the_launch_file
from course_pkg.chapters.ch15_robot_cashier.checks.mirror import the_mirror
from course_pkg.chapters.ch15_robot_cashier.checks.price_sum import the_sum
from course_pkg.chapters.ch15_robot_cashier.checks.printed_lines import the_printed_till
from course_pkg.chapters.ch15_robot_cashier.checks.till_reset import the_reset
from course_pkg.chapters.ch15_robot_cashier.checks.vision import the_vision
from course_pkg.chapters.ch15_robot_cashier.checks.visits import the_visits
from course_pkg.chapters.ch15_robot_cashier.checks.whole_system import the_whole_system

__all__ = [
    "the_client",
    "the_detector",
    "the_launch_file",
    "the_mirror",
    "the_printed_till",
    "the_reset",
    "the_silent_camera",
    "the_sum",
    "the_vision",
    "the_visits",
    "the_whole_system",
]
