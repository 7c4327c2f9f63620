"""Writes grades into files for spreadsheets, learning platforms, other programs, students and instructors."""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.grading.reports.records import read_grades, record_path, write_record
    from course_pkg.grading.reports.writing import write_reports

__all__ = ["read_grades", "record_path", "write_record", "write_reports"]

__getattr__ = lazily(
    __name__, {"records": "read_grades record_path write_record", "writing": "write_reports"}
)
