"""The checks of chapter 02: the student's topics, heard and spoken to from outside."""

from course_pkg.examiner.checks.chapter_02.listening import a_mirror, only_the_newest
from course_pkg.examiner.checks.chapter_02.speaking import a_notice, count_aloud
from course_pkg.examiner.checks.chapter_02.watching import watch_a_stream

__all__ = ["a_mirror", "a_notice", "count_aloud", "only_the_newest", "watch_a_stream"]
