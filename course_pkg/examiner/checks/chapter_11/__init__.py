"""The checks of chapter 11: the student's C++, compiled elsewhere, and called as any server or client."""

from course_pkg.examiner.checks.chapter_11.handler import the_server
from course_pkg.examiner.checks.chapter_11.lists import the_list_file
from course_pkg.examiner.checks.chapter_11.spinning import the_spinner
from course_pkg.examiner.checks.chapter_11.waiting import the_client

__all__ = ["the_client", "the_list_file", "the_server", "the_spinner"]
