"""The checks of chapter 03: one job in three designs, what polling costs, and which design fits a job."""

from course_pkg.examiner.checks.chapter_03.deciding import decide_and_defend, what_polling_costs
from course_pkg.examiner.checks.chapter_03.greeting import greet_everyone
from course_pkg.examiner.checks.chapter_03.polling import poll_with_a_deadline
from course_pkg.examiner.checks.chapter_03.waiting import a_question_that_waits

__all__ = [
    "a_question_that_waits",
    "decide_and_defend",
    "greet_everyone",
    "poll_with_a_deadline",
    "what_polling_costs",
]
