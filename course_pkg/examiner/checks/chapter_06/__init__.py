"""The checks of chapter 06: the student's clients, served by servers that do what a check tells them to."""

from course_pkg.examiner.checks.chapter_06.arguments import read_the_arguments
from course_pkg.examiner.checks.chapter_06.asking import the_geometry_client
from course_pkg.examiner.checks.chapter_06.catching import catch_what_can_happen
from course_pkg.examiner.checks.chapter_06.reserves import ask_the_next_one
from course_pkg.examiner.checks.chapter_06.waiting import is_anybody_there

__all__ = [
    "ask_the_next_one",
    "catch_what_can_happen",
    "is_anybody_there",
    "read_the_arguments",
    "the_geometry_client",
]
