"""The checks of chapter 10: servers and clients in trouble that is made on purpose."""

from course_pkg.examiner.checks.chapter_10.diagnosing import diagnose
from course_pkg.examiner.checks.chapter_10.locking import safe_under_fifty
from course_pkg.examiner.checks.chapter_10.paying import a_robust_client
from course_pkg.examiner.checks.chapter_10.repeating import charge_once
from course_pkg.examiner.checks.chapter_10.selling import no_lock_across_a_call
from course_pkg.examiner.checks.chapter_10.watching import a_watchdog

__all__ = [
    "a_robust_client",
    "a_watchdog",
    "charge_once",
    "diagnose",
    "no_lock_across_a_call",
    "safe_under_fifty",
]
