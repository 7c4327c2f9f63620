"""The checks of chapter 03: poll, greet customers from a topic, find design mistakes, and choose designs."""

from course_pkg.chapters.ch03_choose.checks.deciding import decide_and_defend
from course_pkg.chapters.ch03_choose.checks.greeting import greet_everyone
from course_pkg.chapters.ch03_choose.checks.mistakes import find_the_mistake
from course_pkg.chapters.ch03_choose.checks.polling import poll_with_a_deadline

__all__ = ["decide_and_defend", "find_the_mistake", "greet_everyone", "poll_with_a_deadline"]
