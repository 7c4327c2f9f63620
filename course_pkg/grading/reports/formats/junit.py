"""junit.xml, for programs that show test results.

Each submission is a test suite, and each part is a test case.

A part that was not examined is an error, not a skipped test, because readers overlook skipped tests.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

from course_pkg.checking.report import Report, Verdict
from course_pkg.files import write_atomically
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.gradebook import Book, name_of


def write(book: Book, out: Path) -> None:
    """Write junit.xml."""
    root = ElementTree.Element("testsuites", name="course grade")
    for grade in book.grades:
        root.append(_suite(grade))
    for key in ("tests", "failures", "errors"):
        root.set(key, str(sum(int(suite.get(key, "0")) for suite in root)))
    ElementTree.indent(root, " ")
    text = ElementTree.tostring(root, encoding="unicode")
    write_atomically(out / "junit.xml", f'<?xml version="1.0" encoding="utf-8"?>\n{text}\n')


def _suite(grade: Grade) -> ElementTree.Element:
    name = f"{name_of(grade.student)} chapter {clean.line(grade.chapter, 20) or '?'}"
    suite = ElementTree.Element("testsuite", name=name)
    if grade.problem or not grade.reports:
        _case(suite, "submission", "error", grade.problem or "There is no answer to examine.", "")
    for report in grade.reports:
        _part(suite, report)
    if grade.notes:
        ElementTree.SubElement(suite, "system-out").text = "\n".join(map(clean.line, grade.notes))
    counts = {"tests": "testcase", "failures": "testcase/failure", "errors": "testcase/error"}
    for key, path in counts.items():
        suite.set(key, str(len(suite.findall(path))))
    return suite


def _part(suite: ElementTree.Element, report: Report) -> None:
    kinds = {Verdict.PASSED: "", Verdict.UNDECIDED: "error"}
    name = f"{report.check} {report.goal}"
    _case(suite, name, kinds.get(report.verdict, "failure"), report.headline(), str(report))


def _case(suite: ElementTree.Element, name: str, kind: str, message: str, words: str) -> None:
    case = ElementTree.SubElement(
        suite, "testcase", classname=suite.get("name", "").replace(".", "_"), name=clean.line(name, 200)
    )
    if kind:
        ElementTree.SubElement(case, kind, message=clean.line(message)).text = clean.text(words)
