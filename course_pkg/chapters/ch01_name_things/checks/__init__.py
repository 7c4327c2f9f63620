"""The checks of chapter 01: naming nodes and services, finding services, and finding running publishers."""

from course_pkg.chapters.ch01_name_things.checks.finding import ask_it_wherever_it_lives, who_really_publishes
from course_pkg.chapters.ch01_name_things.checks.names import a_measurer_for_each_room, a_viewer_for_each_arm

__all__ = [
    "a_measurer_for_each_room",
    "a_viewer_for_each_arm",
    "ask_it_wherever_it_lives",
    "who_really_publishes",
]
