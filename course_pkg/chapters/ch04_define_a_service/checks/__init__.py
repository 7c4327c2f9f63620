"""The checks of chapter 04: they build the student's package in another folder, and run its program."""

from course_pkg.chapters.ch04_define_a_service.checks.compatibility import who_talks_to_whom
from course_pkg.chapters.ch04_define_a_service.checks.definition import the_lamp
from course_pkg.chapters.ch04_define_a_service.checks.lists import the_list_file
from course_pkg.chapters.ch04_define_a_service.checks.manifest import the_manifest
from course_pkg.chapters.ch04_define_a_service.checks.program import the_program

__all__ = ["the_lamp", "the_list_file", "the_manifest", "the_program", "who_talks_to_whom"]
