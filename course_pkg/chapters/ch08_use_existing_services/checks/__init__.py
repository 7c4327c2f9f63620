"""The checks of chapter 08: find and call services, convert one service to another, and diagnose failures."""

from course_pkg.chapters.ch08_use_existing_services.checks.calls_of_any_type import call_of_any_type
from course_pkg.chapters.ch08_use_existing_services.checks.command_lines import line_for_a_terminal
from course_pkg.chapters.ch08_use_existing_services.checks.diagnosis import find_the_cause
from course_pkg.chapters.ch08_use_existing_services.checks.lamp import translate
from course_pkg.chapters.ch08_use_existing_services.checks.services_by_type import find_by_type
from course_pkg.chapters.ch08_use_existing_services.checks.switches import move_and_verify

__all__ = [
    "call_of_any_type",
    "find_by_type",
    "find_the_cause",
    "line_for_a_terminal",
    "move_and_verify",
    "translate",
]
