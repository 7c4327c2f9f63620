"""The checks of chapter 12: servers and clients that handle errors, crashes and simultaneous calls."""

from course_pkg.chapters.ch12_survive_trouble.checks.diagnosis import diagnose
from course_pkg.chapters.ch12_survive_trouble.checks.policies import choose_a_policy
from course_pkg.chapters.ch12_survive_trouble.checks.repeated_requests import charge_once
from course_pkg.chapters.ch12_survive_trouble.checks.robust_client import a_robust_client
from course_pkg.chapters.ch12_survive_trouble.checks.time_limit import a_call_with_a_limit
from course_pkg.chapters.ch12_survive_trouble.checks.watchdog import a_watchdog

__all__ = [
    "a_call_with_a_limit",
    "a_robust_client",
    "a_watchdog",
    "charge_once",
    "choose_a_policy",
    "diagnose",
]
