"""class.html: the results of each part, the most frequent hints, and the students who need a look."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from course_pkg.checking.report import Verdict
from course_pkg.files import write_atomically
from course_pkg.grading import clean
from course_pkg.grading.reports import roster
from course_pkg.grading.reports.asked import Column
from course_pkg.grading.reports.flags import flag_sections
from course_pkg.grading.reports.gradebook import (
    WITHOUT_SANDBOX,
    Book,
    attention,
    name_of,
    not_handed_in,
    notes,
    of_points,
    points,
    report_of,
    reviews,
)
from course_pkg.grading.reports.page import KINDS, Frame, banner, paragraph, table, text

HINTS = 12
UNSANDBOXED = (
    "The code of these submissions ran without a sandbox. It had access to this machine, to the "
    "checks and to other submissions, so the points may be wrong."
)
ABSENT = "\N{EN DASH}"


def write(book: Book, out: Path) -> None:
    """Write class.html."""
    write_atomically(out / "class.html", Frame().page("Results of the class", _body(book)))


def _body(book: Book) -> Iterator[str]:
    yield "<h1>Results of the class</h1>"
    yield paragraph(_summary(book), "lead")
    yield "" if book.sandboxed else banner("Not reliable", [UNSANDBOXED])
    yield paragraph(roster.lead(book))
    if not book.grades:
        yield paragraph("Nothing was handed in, so there is nothing to show.")
        yield from roster.section(book)
        return
    yield "<h2>Everybody</h2>"
    yield _everybody(book)
    yield "<h2>Students who need a look</h2>"
    yield _looks(book)
    yield _absent(book)
    yield _reviewed(book)
    yield from roster.section(book)
    yield from flag_sections(book)
    yield "<h2>Most frequent hints</h2>"
    yield _hints(book)
    yield "<h2>Results of each part</h2>"
    yield _key()
    for chapter in book.chapters:
        for column in book.columns_of(chapter):
            yield _spread(book, column)


def _summary(book: Book) -> str:
    count = len([student for student in book.students if student])
    if not book.total:
        return f"{count} students"
    shares = [
        book.earned(student) / possible
        for student in book.students
        if student and (possible := book.possible_for(student))
    ]
    share = f"{sum(shares) / len(shares):.0%}" if shares else ""
    mean = f", {share} of the possible points on average" if shares else ""
    named = f"Chapter {book.chapters[0]}" if len(book.chapters) == 1 else f"{len(book.chapters)} chapters"
    return f"{clean.line(named)}: {count} {'student' if count == 1 else 'students'}{mean}"


def _key() -> str:
    items = "".join(f'<li class="{kind}-mark">{verdict.value}</li>' for verdict, (kind, _) in KINDS.items())
    return f'<ul class="key" aria-label="What the colours mean">{items}</ul>'


def _spread(book: Book, column: Column) -> str:
    """Return the results of a part as a coloured bar and as text."""
    reports = [report_of(book.grade(student, column.chapter), column.check) for student in book.students]
    verdicts = Counter(report.verdict for report in reports if report)
    there = sum(verdicts.values())
    words = ", ".join(f"{verdicts[verdict]} {verdict.value}" for verdict in Verdict if verdicts[verdict])
    mean = sum(report.points for report in reports if report) / max(1, there)
    label = text(f"{column.check}: {words}")
    return (
        f'<div class="spread"><h3>{text(column.check)}</h3>{paragraph(column.goal)}'
        f'<svg class="bar" role="img" aria-label="{label}">{_rects(verdicts, there)}</svg>'
        f'<p class="counts">{text(words)}; {of_points(mean, column.possible)} on average</p></div>'
    )


def _rects(verdicts: Counter[Verdict], there: int) -> str:
    made, start = [], 0.0
    for verdict, (kind, _) in KINDS.items():
        width = 100 * verdicts[verdict] / max(1, there)
        if width:
            shown = max(width - 0.3, 0.3)  # The subtracted 0.3 is the gap between two colours.
            made.append(f'<rect class="{kind}-mark" x="{start:.2f}%" width="{shown:.2f}%" height="100%"/>')
        start += width
    return "".join(made)


def _hints(book: Book) -> str:
    """Return the most frequent hints, and the failed assertions without a hint."""
    counts = Counter(
        hint
        for student in book.students
        for hint in {
            (report.check, clean.line(assertion.hint or f"(no hint) {assertion.text}"))
            for grade in book.of(student)
            for report in grade.reports
            for assertion in report.assertions
            if not assertion.holds
        }
    )
    if not counts:
        return paragraph("There are no hints: all assertions passed.")
    ranked = sorted(counts.items(), key=lambda item: (-item[1], item[0]))[:HINTS]
    rows = [(text(check), text(hint), str(count)) for (check, hint), count in ranked]
    return table("Each student is counted once for each hint.", ["Part", "Hint", "Students"], rows, 1)


def _looks(book: Book) -> str:
    """Return the students whose results the teacher should examine; the most serious cases come first.

    Notes about the remaining students follow, in a list that the reader can unfold.
    """
    found = [(student, attention(book, student)) for student in book.students]
    grave = {student: reasons for student, reasons in found if reasons}
    ranked = sorted(grave, key=lambda student: (-_gravity(book, student), student))
    items = "".join(
        f"<li>{_link(student)}{_listed([*grave[student], *_known(book, student)])}</li>" for student in ranked
    )
    looks = f'<ul class="looks">{items}</ul>' if items else paragraph("No student needs a look.")
    others = [student for student in book.students if student not in grave and _known(book, student)]
    if not others:
        return looks
    items = "".join(f"<li>{_link(student)}{_listed(_known(book, student))}</li>" for student in others)
    count = f"{len(others)} other {'notebook' if len(others) == 1 else 'notebooks'}"
    return f'{looks}<details><summary>Notes about {count}</summary><ul class="looks">{items}</ul></details>'


def _absent(book: Book) -> str:
    """Return the students with missing chapters, in a list that the reader can unfold."""
    found = [(student, sentence) for student in book.students if (sentence := not_handed_in(book, student))]
    if not found:
        return ""
    items = "".join(f"<li>{_link(student)}{_listed([sentence])}</li>" for student, sentence in found)
    count = f"{len(found)} {'student' if len(found) == 1 else 'students'}"
    return f'<details><summary>Missing chapters of {count}</summary><ul class="looks">{items}</ul></details>'


def _reviewed(book: Book) -> str:
    """Return the points and comments of instructors, in a list that the reader can unfold."""
    found = [(student, lines) for student in book.students if (lines := reviews(book, student))]
    if not found:
        return ""
    items = "".join(f"<li>{_link(student)}{_listed(lines)}</li>" for student, lines in found)
    count = sum(len(lines) for _, lines in found)
    parts = "1 part" if count == 1 else f"{count} parts"
    return f'<details><summary>{parts} reviewed by hand</summary><ul class="looks">{items}</ul></details>'


def _gravity(book: Book, student: str) -> int:
    if any(grade.problem for grade in book.of(student)):
        return 2
    return int(
        any(report.verdict is Verdict.UNDECIDED for grade in book.of(student) for report in grade.reports)
    )


def _known(book: Book, student: str) -> list[str]:
    return [note for note in notes(book, student) if note != WITHOUT_SANDBOX]


def _listed(reasons: Sequence[str]) -> str:
    return f"<ul>{''.join(f'<li>{text(reason, 600)}</li>' for reason in reasons)}</ul>"


def _link(student: str) -> str:
    """Return a link to the feedback page.

    The file name of a feedback page contains no HTML characters, so the name is not escaped.
    """
    return f'<a href="feedback/{clean.file_name(student or "nobody")}.html">{text(name_of(student))}</a>'


def _everybody(book: Book) -> str:
    chapters = book.chapters if len(book.chapters) > 1 else ()
    head = ["Student", *(f"Chapter {chapter}" for chapter in chapters), "Points"]
    rows = [_row(book, student, chapters) for student in book.students]
    return table(f"Points, of {points(book.total)}", head, rows, len(chapters) + 1)


def _row(book: Book, student: str, chapters: Sequence[str]) -> list[str]:
    grades = [book.grade(student, chapter) for chapter in chapters]
    cells = [ABSENT if grade is None else points(grade.earned) for grade in grades]
    possible = book.possible_for(student)
    other = f" of {points(possible)}" if possible != book.total else ""
    return [_link(student), *cells, f"{points(book.earned(student))}{other}"]
