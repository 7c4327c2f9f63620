"""The checks of chapter 04: the student's definitions and packages, built elsewhere, and their program."""

from course_pkg.examiner.checks.chapter_04.compatibility import who_talks_to_whom
from course_pkg.examiner.checks.chapter_04.definition import the_lamp
from course_pkg.examiner.checks.chapter_04.lists import the_list_file
from course_pkg.examiner.checks.chapter_04.manifest import the_manifest
from course_pkg.examiner.checks.chapter_04.program import the_program

__all__ = ["the_lamp", "the_list_file", "the_manifest", "the_program", "who_talks_to_whom"]
