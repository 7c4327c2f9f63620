"""Makes the results of `course grade` for a class, and runs `course review` for these results."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import replace
from pathlib import Path

from course_pkg.checking.report import Verdict
from course_pkg.grading.grade import Flag, Grade
from course_pkg.grading.reports import read_grades, write_reports
from course_pkg.grading.review.items import Wanted
from course_pkg.grading.review.server import application
from course_pkg.grading.review.session import Session
from tests.grading.grades import NASTY, nasty, report
from tests.web_pages.servers import served

TOKEN = "secret"  # noqa: S105 -- only this test's server knows it
RIGHT = 'mistakes = {"A": "polls too rarely"}\n'


def graded(student: str, code: str = RIGHT, **more: object) -> Grade:
    """Return a grade in which 05.1 has failed and the check of 05.2 did not finish."""
    reports = (
        report("05.1", Verdict.FAILED),
        report("05.2", Verdict.FAILED, assertions=(), inconclusive=True),
    )
    made = Grade(student, "05", reports, origin=f"{student}/05.ipynb", code={"05.1": code, "05.2": "x = 1"})
    return replace(made, **more)  # type: ignore[arg-type]


def class_of_four() -> list[Grade]:
    """Return four grades: two with identical answers, one with a flag, and one with harmful texts."""
    flag = Flag("copies", "05.1", "The code is almost the same.", 1, RIGHT.strip(), ("s01",))
    hostile = nasty("=evil", code={"05.1": f"</code><img src=x onerror=alert(1)>{NASTY}"})
    return [graded("s01"), graded("s02"), graded("s03", "other = 1", flags=(flag,)), hostile]


def write_class(out: Path, grades: list[Grade] | None = None) -> Path:
    """Write the reports of a class into a folder, and return the folder."""
    write_reports(class_of_four() if grades is None else grades, out)
    return out


@contextmanager
def serving(out: Path, wanted: Wanted | None = None) -> Iterator[str]:
    """Run the review server for a folder in a thread, and yield the server's address without the token."""
    session = Session(out, read_grades(out), wanted or Wanted())
    with served(lambda port: nullcontext(application(session, TOKEN, lambda: port))) as url:
        yield url
