"""Flags in the instructor's reports: a section of class.html, and a column of grades.csv."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from course_pkg.grading import clean
from course_pkg.grading.flags.finding import title_of
from course_pkg.grading.grade import Flag
from course_pkg.grading.reports.gradebook import Book, name_of
from course_pkg.grading.reports.page import paragraph, text

OTHERS = 10  # A report lists at most this many other students for one flag.
ABOUT = (
    "A flag is a reason to look at an answer yourself. A flag does not change points, and the "
    "feedback for students contains no flags."
)
Flagged = tuple[str, str, Flag]  # The tuple contains the student, the chapter and the flag.


def flag_sections(book: Book) -> Iterator[str]:
    """Yield the section about flags, with a list of students for each kind of flag.

    Without flags, yield nothing.
    """
    found = list(_flagged(book))
    if not found:
        return
    yield "<h2>Flags</h2>"
    yield paragraph(ABOUT)
    for kind in sorted({flag.kind for _, _, flag in found}):
        ours = [each for each in found if each[2].kind == kind]
        students = sorted({student for student, _, _ in ours})
        yield f"<h3>{text(title_of(kind))}</h3>"
        items = "".join(_student(kind, student, ours) for student in students)
        yield f'<ul class="looks">{items}</ul>'


def flag_words(book: Book, student: str) -> str:
    """Return the flags of a student as one text: the part, the line and the reason of each flag."""
    return " | ".join(_line(chapter, flag) for owner, chapter, flag in _flagged(book) if owner == student)


def _flagged(book: Book) -> Iterator[Flagged]:
    for grade in book.grades:
        for flag in grade.flags:
            yield grade.student, grade.chapter, flag


def _line(chapter: str, flag: Flag) -> str:
    others = (
        f" (similar: {', '.join(map(name_of, flag.others[:OTHERS]))}{_more(flag.others)})"
        if flag.others
        else ""
    )
    line = f", line {flag.line}" if flag.line else ""
    return clean.line(f"{_place(chapter, flag)}{line}: {flag.words}{others}", 600)


def _place(chapter: str, flag: Flag) -> str:
    return flag.where if flag.where.startswith(chapter) else f"{chapter} {flag.where}"


def _student(kind: str, student: str, found: Sequence[Flagged]) -> str:
    items = "".join(_item(kind, chapter, flag) for owner, chapter, flag in found if owner == student)
    link = f'<a href="feedback/{_file(student)}.html">{text(name_of(student))}</a>'
    return f'<li id="{_anchor(kind, student)}">{link}<ul>{items}</ul></li>'


def _item(kind: str, chapter: str, flag: Flag) -> str:
    line = f", line {flag.line}" if flag.line else ""
    code = f" <code>{text(flag.evidence, 200)}</code>" if flag.evidence else ""
    links = ", ".join(
        f'<a href="#{_anchor(kind, other)}">{text(name_of(other))}</a>' for other in flag.others[:OTHERS]
    )
    also = f" Similar: {links}{_more(flag.others)}." if links else ""
    return f"<li>{text(_place(chapter, flag))}{line}: {text(flag.words, 600)}{also}{code}</li>"


def _more(others: Sequence[str]) -> str:
    return f" and {len(others) - OTHERS} more" if len(others) > OTHERS else ""


def _anchor(kind: str, student: str) -> str:
    return f"{clean.file_name(kind)}-{_file(student)}"


def _file(student: str) -> str:
    return clean.file_name(student or "nobody")
