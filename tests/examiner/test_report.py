"""A report reads the same everywhere: as text, as HTML, and after a way through the wire."""

from __future__ import annotations

import json

from course_pkg.examiner.report import Report, Rule, Verdict, report_from

FAILED = Report(
    "05.1",
    Verdict.FAILED,
    "Answer.",
    0,
    2,
    (Rule("it answers", True), Rule("<b>area</b>", False, "f(1)", "2", "<script>", "Multiply, " * 20)),
)


def test_a_pass_tells_no_values() -> None:
    """The text is what nbval compares, so a pass holds nothing that was drawn, even when it is on record."""
    rule = Rule("it answers", True, asked="f(0.123)", expected="1", seen="1", hint="none")
    text = str(Report("05.1", Verdict.PASSED, "Answer.", 2, 2, (rule,), printed="0.123"))
    assert text == "05.1 passed: 2 of 2 points\n  ✓ it answers"


def test_a_failure_tells_what_was_asked_expected_and_seen_and_the_hint() -> None:
    """Everything that helps stands there, in lines that fit."""
    text = str(FAILED)
    for word in (
        "0 of 2 points",
        "✓ it answers",
        "asked     f(1)",
        "expected  2",
        "saw       <script>",
        "hint",
    ):
        assert word in text
    assert max(map(len, text.splitlines())) <= 100


def test_html_is_escaped() -> None:
    """Nothing that a student's code said is markup."""
    html = FAILED.html()
    assert "<script>" not in html
    assert "<b>" not in html
    assert "&lt;script&gt;" in html


def test_a_report_survives_the_wire() -> None:
    """What the judge sends is what the desk shows."""
    assert report_from(json.loads(json.dumps(FAILED.as_dict()))) == FAILED
