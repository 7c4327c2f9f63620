"""What a check found, as data, as text and as HTML.

The text of a pass holds no value, no time and no chance, so it is the same in every run.
"""

from __future__ import annotations

import textwrap
from dataclasses import asdict, dataclass, field
from enum import Enum
from html import escape
from typing import Any

WIDTH = 100


class Verdict(str, Enum):
    """How a check ended."""

    PASSED = "passed"
    FAILED = "not yet"
    NOT_ATTEMPTED = "not attempted"
    UNDECIDED = "not examined"


@dataclass(frozen=True)
class Rule:
    """One rule that was looked at; the last four fields are filled in when it does not hold."""

    text: str
    holds: bool
    asked: str = ""
    expected: str = ""
    seen: str = ""
    hint: str = ""

    def details(self) -> list[tuple[str, str]]:
        """Return what there is to say about a rule that does not hold: (label, text)."""
        return [
            (label, text)
            for label, text in (
                ("asked", self.asked),
                ("expected", self.expected),
                ("saw", self.seen),
                ("hint", self.hint),
            )
            if text and not self.holds
        ]


@dataclass(frozen=True)
class Report:
    """The outcome of one check."""

    check: str
    verdict: Verdict
    goal: str = ""
    points: int = 0
    possible: int = 0
    rules: tuple[Rule, ...] = ()
    note: str = ""  # what to do next, when no rule says it
    printed: str = field(default="", compare=False)  # what student code printed meanwhile

    def headline(self) -> str:
        """Return the one line that says how it went."""
        if not self.possible:
            return f"{self.check} {self.verdict.value}"
        return f"{self.check} {self.verdict.value}: {self.points} of {self.possible} points"

    def __str__(self) -> str:
        lines = [self.headline()]
        if self.verdict is not Verdict.PASSED and self.goal:
            lines += _block("  goal      ", self.goal)
        for rule in self.rules:
            lines += _block("  ✓ " if rule.holds else "  ✗ ", rule.text)
            for label, text in rule.details():
                lines += _block(f"      {label:<10}", text)
        return "\n".join(lines + _block("  ", self.note))

    __repr__ = __str__

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html()}

    def html(self) -> str:
        """Return the report as HTML that stands alone; every text in it is escaped."""
        rules = "".join(_rule_html(rule) for rule in self.rules)
        goal = "" if self.verdict is Verdict.PASSED else _paragraph(self.goal)
        printed = _printed_html(self.printed) if self.verdict is not Verdict.PASSED else ""
        rules = f'<ul style="list-style:none;padding-left:0">{rules}</ul>'
        return (
            f'<section class="course-report" style="{_frame(self.verdict)}">'
            f"<p><strong>{escape(self.headline())}</strong></p>"
            f"{goal}{rules}{_paragraph(self.note)}{printed}</section>"
        )

    def as_dict(self) -> dict[str, Any]:
        """Return the report as plain data, for the wire and for the record."""
        return {**asdict(self), "verdict": self.verdict.value}


def report_from(data: dict[str, Any]) -> Report:
    """Return the report that `data`, made by `as_dict`, describes."""
    rules = tuple(Rule(**rule) for rule in data["rules"])
    return Report(**{**data, "rules": rules, "verdict": Verdict(data["verdict"])})


def _block(label: str, text: str) -> list[str]:
    """Return `text` as lines of at most WIDTH, the first after `label`, the others below it."""
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


def _rule_html(rule: Rule) -> str:
    mark, word = ("✓", "holds") if rule.holds else ("✗", "does not hold")
    details = "".join(
        f'<div style="display:flex;gap:1em;padding-left:1.5em">'
        f'<span style="min-width:5em">{label}</span>'
        f'<span style="white-space:pre-wrap">{escape(text) if label == "hint" else _code(text)}</span></div>'
        for label, text in rule.details()
    )
    return f'<li><span role="img" aria-label="{word}">{mark}</span> {escape(rule.text)}{details}</li>'


def _code(text: str) -> str:
    return f"<code>{escape(text)}</code>"


def _printed_html(text: str) -> str:
    if not text:
        return ""
    return f"<details><summary>printed meanwhile</summary><pre>{escape(text)}</pre></details>"
