"""The checks of chapter 10 are about simultaneous calls, waiting handlers, races and deadlocks."""

from course_pkg.chapters.ch10_let_a_handler_wait.checks.basket import wait_for_another_call
from course_pkg.chapters.ch10_let_a_handler_wait.checks.calls_at_once import calls_at_once
from course_pkg.chapters.ch10_let_a_handler_wait.checks.detecting import wait_for_a_customer
from course_pkg.chapters.ch10_let_a_handler_wait.checks.diagnosis import find_the_cause
from course_pkg.chapters.ch10_let_a_handler_wait.checks.shop import no_lock_across_a_call
from course_pkg.chapters.ch10_let_a_handler_wait.checks.stock import safe_with_fifty_clients
from course_pkg.chapters.ch10_let_a_handler_wait.checks.two_locks import move_without_deadlock

__all__ = [
    "calls_at_once",
    "find_the_cause",
    "move_without_deadlock",
    "no_lock_across_a_call",
    "safe_with_fifty_clients",
    "wait_for_a_customer",
    "wait_for_another_call",
]
