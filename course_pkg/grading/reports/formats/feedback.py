"""feedback/<student>.html: a page that explains the grade to the student."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from course_pkg.checking.report import GOALS, Assertion, Report, Verdict
from course_pkg.files import write_atomically
from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.gradebook import Book, about_lateness, name_of, not_handed_in, of_points
from course_pkg.grading.reports.page import KINDS, Frame, banner, paragraph, text

CODE = 20_000  # The page shows at most this many characters of a student's code.
CELLS = 20  # The page lists at most this many cells of nbval's run.


def write(book: Book, out: Path) -> None:
    """Write a page for each student."""
    frame = Frame()
    for student in book.students:
        grades = [grade.for_student() for grade in book.of(student)]
        title = f"Feedback for {name_of(student)}"
        path = out / "feedback" / f"{clean.file_name(student or 'nobody')}.html"
        write_atomically(path, frame.page(title, _body(title, grades, book, student)))


def _body(title: str, grades: list[Grade], book: Book, student: str) -> Iterator[str]:
    yield f"<h1>{text(title)}</h1>"
    if len(book.counted(student)) > 1:
        yield paragraph(of_points(book.earned(student), book.possible_for(student)), "lead")
    yield paragraph(not_handed_in(book, student))
    for grade in grades:
        yield f"<section>{''.join(_chapter(grade))}</section>"


def _chapter(grade: Grade) -> Iterator[str]:
    title = f"Chapter {grade.chapter}" if grade.chapter else "Other files"
    score = f": {of_points(grade.earned, grade.possible)}" if grade.reports else ""
    yield f"<h2>{text(title + score)}</h2>"
    yield paragraph(about_lateness(grade))
    yield banner("Why this work could not be graded", [grade.problem])
    yield banner("About your submission", grade.notes)
    for report in grade.reports:
        shown = replace(report, note="") if report.note == grade.problem else report
        yield _part(shown, grade.code.get(report.check, ""))
    yield from _cells(grade)


def _part(report: Report, code: str) -> str:
    """Return the HTML of a part: the student's code, the passed and failed assertions, and the note."""
    kind, sign = KINDS[report.verdict]
    score = of_points(report.points, report.possible) if report.possible else ""
    head = f"<h3>{text(report.check)} <span>{sign} {report.verdict.value}</span></h3>"
    sections = "".join(
        f"{paragraph(heading)}<ul class=assertions>{''.join(map(_assertion, assertions))}</ul>"
        for heading, assertions in report.sections()
    )
    return (
        f'<article class="part {kind}"><header>{head}<span class="muted">{score}</span></header>'
        f"{paragraph(report.goal)}{_code(code)}{sections}{paragraph(report.note)}{_credits(report)}"
        f"{_printed(report)}{_review(report)}</article>"
    )


def _code(code: str) -> str:
    """Return the student's code, which the reader can unfold."""
    return (
        f"<details><summary>Your code</summary><pre>{clean.html(code, CODE)}</pre></details>" if code else ""
    )


def _review(report: Report) -> str:
    sentences = (f"<p>{clean.html(sentence)}</p>" for sentence in report.about_review())
    return f'<div class="review">{"".join(sentences)}</div>' if report.review else ""


def _credits(report: Report) -> str:
    items = "".join(f"<li>{text(line, 600)}</li>" for line in report.credits())
    return f"{paragraph(GOALS)}<ul>{items}</ul>" if items else ""


def _assertion(assertion: Assertion) -> str:
    kind, sign, word = ("holds", "✓", "holds") if assertion.holds else ("broken", "✗", "failed")
    pairs = "".join(
        f"<dt>{label}</dt><dd>{_value(label, value)}</dd>" for label, value in assertion.details()
    )
    details = f"<dl>{pairs}</dl>" if pairs else ""
    return (
        f'<li class="{kind}"><span class="mark" aria-hidden="true">{sign}</span>'
        f'<span class="unseen">{word}: </span>{text(assertion.text, 600)}{details}</li>'
    )


def _value(label: str, value: str) -> str:
    return text(value, 1000) if label == "hint" else f"<code>{clean.html(value, 1000)}</code>"


def _printed(report: Report) -> str:
    if report.verdict is Verdict.PASSED or not report.printed.strip():
        return ""
    shown = clean.html(report.printed)
    return f"<details><summary>Printed during the check</summary><pre>{shown}</pre></details>"


def _cells(grade: Grade) -> Iterator[str]:
    """Yield the result of nbval, and the cells with other outputs than the solution."""
    if not grade.cells:
        return
    others = [cell for cell in grade.cells if cell.outcome != "passed"]
    passed = len(grade.cells) - len(others)
    yield "<h3>Your answers in the whole notebook</h3>"
    yield paragraph(
        f"The chapter's notebook was run from top to bottom with your answers. {passed} of "
        f"{len(grade.cells)} cells gave the same result as with the right answers. You get no "
        "points for these cells. They show which later cells depend on your answers."
    )
    if others:
        items = (
            f"<li><code>{text(cell.line or cell.cell, 100)}</code><br>{text(cell.finding, 500)}</li>"
            for cell in others[:CELLS]
        )
        yield f'<ul class="cells">{"".join(items)}</ul>'
    if len(others) > CELLS:
        yield paragraph(f"{len(others) - CELLS} more cells gave a different result.", "muted")
