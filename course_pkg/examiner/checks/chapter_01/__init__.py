"""The checks of chapter 01: names are resolved, given, searched for, and held against who lives."""

from course_pkg.examiner.checks.chapter_01.finding import ask_it_wherever_it_lives, who_really_publishes
from course_pkg.examiner.checks.chapter_01.names import a_measurer_for_each_room, resolve_names

__all__ = ["a_measurer_for_each_room", "ask_it_wherever_it_lives", "resolve_names", "who_really_publishes"]
