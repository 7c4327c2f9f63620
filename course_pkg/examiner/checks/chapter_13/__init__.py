"""The checks of chapter 13: an action's two ends, a parameter, and the choice among four."""

from course_pkg.examiner.checks.chapter_13.choosing import the_choice
from course_pkg.examiner.checks.chapter_13.fetching import the_action
from course_pkg.examiner.checks.chapter_13.limiting import the_client
from course_pkg.examiner.checks.chapter_13.settings import the_parameter

__all__ = ["the_action", "the_choice", "the_client", "the_parameter"]
