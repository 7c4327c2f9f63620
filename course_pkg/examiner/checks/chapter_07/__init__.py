"""The checks of chapter 07: services found by type, asked and answered, by whoever knows only the graph."""

from course_pkg.examiner.checks.chapter_07.anything import call_what_is_there
from course_pkg.examiner.checks.chapter_07.finding import find_by_type
from course_pkg.examiner.checks.chapter_07.lines import type_the_call
from course_pkg.examiner.checks.chapter_07.switches import move_and_verify, on_or_off

__all__ = ["call_what_is_there", "find_by_type", "move_and_verify", "on_or_off", "type_the_call"]
