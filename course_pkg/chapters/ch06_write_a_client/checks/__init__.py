"""The checks of chapter 06: the student's clients call servers of the checks."""

from course_pkg.chapters.ch06_write_a_client.checks.arguments import read_the_arguments
from course_pkg.chapters.ch06_write_a_client.checks.asking import the_geometry_client
from course_pkg.chapters.ch06_write_a_client.checks.catching import catch_what_can_happen
from course_pkg.chapters.ch06_write_a_client.checks.fitting import does_it_fit
from course_pkg.chapters.ch06_write_a_client.checks.reserves import ask_the_next_one
from course_pkg.chapters.ch06_write_a_client.checks.waiting import is_anybody_there

__all__ = [
    "ask_the_next_one",
    "catch_what_can_happen",
    "does_it_fit",
    "is_anybody_there",
    "read_the_arguments",
    "the_geometry_client",
]
