"""The report of a check, as data, as text and as HTML.

The report of a failed check shows the assertions that hold, then the failed assertion, and then the goal. The
report of a passed check contains no values, times or random texts, so it is the same in every run.
"""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from enum import Enum
from html import escape

from course_pkg.checking.credit import Goal, total
from course_pkg.checking.plain_values import Value
from course_pkg.ros.protocol.json_channel import Json

WIDTH = 100
RIGHT, NEXT, FIRST = "Right so far:", "Fix this next:", "Fix this first:"
GOALS = "Points for each goal:"


class Verdict(str, Enum):
    """The possible results of a check."""

    PASSED = "passed"
    FAILED = "not yet"
    NOT_ATTEMPTED = "not attempted"
    UNDECIDED = "not examined"


@dataclass(frozen=True)
class Assertion:
    """One assertion that was checked. The last four fields are set only if the assertion does not hold."""

    text: str
    holds: bool
    asked: str = ""
    expected: str = ""
    actual: str = ""
    hint: str = ""

    def details(self) -> list[tuple[str, str]]:
        """Return a pair (label, text) for each line about an assertion that does not hold."""
        return [
            (label, text)
            for label, text in (
                ("asked", self.asked),
                ("expected", self.expected),
                ("saw", self.actual),
                ("hint", self.hint),
            )
            if text and not self.holds
        ]


@dataclass(frozen=True)
class Review:
    """An instructor's decision about an answer after the check."""

    comment: str = ""  # This comment is for the student.
    # These are the points of the check if the instructor has confirmed or changed them. Otherwise, the value
    # is None.
    computed: float | None = None
    outdated: bool = False  # The value is true if the answer has changed since the review.


@dataclass(frozen=True)
class Report:
    """The result of one check."""

    check: str
    verdict: Verdict
    goal: str = ""
    points: float = 0
    possible: float = 0
    assertions: tuple[Assertion, ...] = ()
    # An instruction for the student without a failed assertion, for example if a name is not defined.
    note: str = ""
    printed: str = field(default="", compare=False)  # Student code printed this text during the check.
    # The points are divided among these goals; without goals, a check gives all points or none.
    goals: tuple[Goal, ...] = ()
    # The value is True if the check did not finish; grading counts such a check as failed.
    inconclusive: bool = False
    review: Review | None = None  # The value is set in grading, if an instructor has reviewed the answer.

    def headline(self) -> str:
        """Return the first line of the report with the result."""
        if not self.possible:
            return f"{self.check} {self.verdict.value}"
        return f"{self.check} {self.verdict.value}: {self.points:g} of {self.possible:g} points"

    def about_review(self) -> list[str]:
        """Return sentences for the student: who decided the points, and the instructor's comment."""
        if self.review is None:
            return []
        computed, comment = self.review.computed, self.review.comment
        if computed is None:
            about = ""
        elif computed == self.points:
            about = "The instructor confirmed the points."
        else:
            about = f"The instructor changed the points from {computed:g} to {self.points:g}."
        return [*filter(None, [about, comment and f"The instructor's comment: {comment}"])]

    def credits(self) -> list[str]:
        """Return a line with the points for each goal.

        The list is empty if the check has passed, if no assertion was checked, or if the part has no goals.
        """
        if self.verdict is Verdict.PASSED or not self.assertions or not total(self.goals):
            return []
        return [
            f"{goal.points if goal.fulfilled else 0:g} of {goal.points:g}: {goal.text}" for goal in self.goals
        ]

    def sections(self) -> list[tuple[str, tuple[Assertion, ...]]]:
        """Return the assertions with their headings; the assertions that hold come first.

        A passed check has no headings.
        """
        if self.verdict is Verdict.PASSED:
            return [("", self.assertions)]
        right = tuple(each for each in self.assertions if each.holds)
        wrong = tuple(each for each in self.assertions if not each.holds)
        found = [(RIGHT, right), (NEXT if right else FIRST, wrong)]
        return [(heading, assertions) for heading, assertions in found if assertions]

    def __str__(self) -> str:
        lines = [self.headline()]
        for heading, assertions in self.sections():
            lines += _block("  ", heading)
            for assertion in assertions:
                lines += _block("  ✓ " if assertion.holds else "  ✗ ", assertion.text)
                for label, text in assertion.details():
                    lines += _block(f"      {label:<10}", text)
        lines += _block("  ", self.note)
        if shown := self.credits():
            lines += [f"  {GOALS}", *(line for each in shown for line in _block("    ", each))]
        for sentence in self.about_review():
            lines += _block("  ", sentence)
        if self.verdict is not Verdict.PASSED and self.goal:
            lines += _block("  The goal: ", self.goal)
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html()}

    def html(self) -> str:
        """Return the report as complete HTML; every text in it is escaped."""
        passed = self.verdict is Verdict.PASSED
        sections = "".join(_section_html(*section) for section in self.sections())
        items = "".join(f"<li>{escape(each)}</li>" for each in self.credits())
        divided = f"{_paragraph(GOALS)}<ul>{items}</ul>" if items else ""
        goal = "" if passed or not self.goal else _paragraph(f"The goal: {self.goal}")
        printed = "" if passed else _printed_html(self.printed)
        return (
            f'<section class="course-report" style="{_frame(self.verdict)}">'
            f"<p><strong>{escape(self.headline())}</strong></p>"
            f"{sections}{_paragraph(self.note)}{divided}{goal}{printed}</section>"
        )

    def as_dict(self) -> dict[str, Json]:
        """Return the report as plain data, for the channel and for the student's record."""
        return {**asdict(self), "verdict": self.verdict.value}


def report_from(data: Mapping[str, Value]) -> Report:
    """Return the report from `data`, the result of `as_dict`."""
    assertions = tuple(Assertion(**each) for each in data["assertions"])
    goals = tuple(Goal(**each) for each in data.get("goals", ()))
    review = Review(**data["review"]) if data.get("review") else None
    known = {"assertions": assertions, "goals": goals, "review": review, "verdict": Verdict(data["verdict"])}
    return Report(**{**data, **known})


def _block(label: str, text: str) -> list[str]:
    """Return the text as lines of at most `WIDTH` characters; the first line begins with the label."""
    space = " " * len(label)
    lines = [
        part
        for line in text.splitlines()
        for part in textwrap.wrap(line, WIDTH - len(label), break_on_hyphens=False, break_long_words=False)
        or [""]
    ]
    return [f"{space if number else label}{line}".rstrip() for number, line in enumerate(lines)]


def _frame(verdict: Verdict) -> str:
    colours = {Verdict.PASSED: "#2e7d32", Verdict.FAILED: "#b3261e"}
    return f"border-left:4px solid {colours.get(verdict, '#767676')};padding:0.2em 1em"


def _paragraph(text: str) -> str:
    return f"<p>{escape(text)}</p>" if text else ""


def _section_html(heading: str, assertions: tuple[Assertion, ...]) -> str:
    items = "".join(map(_assertion_html, assertions))
    return f'{_paragraph(heading)}<ul style="list-style:none;padding-left:0">{items}</ul>'


def _assertion_html(assertion: Assertion) -> str:
    mark, word = ("✓", "holds") if assertion.holds else ("✗", "does not hold")
    details = "".join(
        f'<div style="display:flex;gap:1em;padding-left:1.5em">'
        f'<span style="min-width:5em">{label}</span>'
        f'<span style="white-space:pre-wrap">{escape(text) if label == "hint" else _code(text)}</span></div>'
        for label, text in assertion.details()
    )
    return f'<li><span role="img" aria-label="{word}">{mark}</span> {escape(assertion.text)}{details}</li>'


def _code(text: str) -> str:
    return f"<code>{escape(text)}</code>"


def _printed_html(text: str) -> str:
    if not text:
        return ""
    return f"<details><summary>printed meanwhile</summary><pre>{escape(text)}</pre></details>"
