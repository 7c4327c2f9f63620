"""The checks of chapter 12: the robot cashier, each of its rules looked at from outside."""

from course_pkg.examiner.checks.chapter_12.arm import an_arm
from course_pkg.examiner.checks.chapter_12.asking import answers_and_refusals
from course_pkg.examiner.checks.chapter_12.eye import an_eye
from course_pkg.examiner.checks.chapter_12.frames import a_frame
from course_pkg.examiner.checks.chapter_12.launching import the_whole_system
from course_pkg.examiner.checks.chapter_12.printing import a_printed_till
from course_pkg.examiner.checks.chapter_12.program import a_program
from course_pkg.examiner.checks.chapter_12.resetting import a_register
from course_pkg.examiner.checks.chapter_12.robot import two_things_at_once
from course_pkg.examiner.checks.chapter_12.till import a_till
from course_pkg.examiner.checks.chapter_12.waiting import a_bounded_wait

__all__ = [
    "a_bounded_wait",
    "a_frame",
    "a_printed_till",
    "a_program",
    "a_register",
    "a_till",
    "an_arm",
    "an_eye",
    "answers_and_refusals",
    "the_whole_system",
    "two_things_at_once",
]
