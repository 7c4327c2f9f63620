"""Tests that the text and the HTML of a report have the same content."""

from __future__ import annotations

import json

from course_pkg.checking.report import Assertion, Report, Verdict, report_from

FAILED = Report(
    "05.1",
    Verdict.FAILED,
    "Answer.",
    0,
    2,
    (
        Assertion("it answers", True),
        Assertion("<b>area</b>", False, "f(1)", "2", "<script>", "Multiply, " * 20),
    ),
)


def test_pass_contains_no_values() -> None:
    """The report on a passed check contains no random values."""
    assertion = Assertion("it answers", True, asked="f(0.123)", expected="1", actual="1", hint="none")
    text = str(Report("05.1", Verdict.PASSED, "Answer.", 2, 2, (assertion,), printed="0.123"))
    assert text == "05.1 passed: 2 of 2 points\n  ✓ it answers"


def test_failure_contains_call_expected_and_actual_value_and_hint() -> None:
    """The report on a failed check shows the call, the expected value, the actual value and the hint."""
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


def test_a_failure_starts_with_what_is_right_and_then_names_one_thing_to_fix() -> None:
    """The report on a failure shows the assertions that passed, then what to correct, and then the goal."""
    lines = str(FAILED).splitlines()
    assert lines[:4] == [
        "05.1 not yet: 0 of 2 points",
        "  Right so far:",
        "  ✓ it answers",
        "  Fix this next:",
    ]
    assert lines[4] == "  ✗ <b>area</b>"
    assert lines[-1] == "  The goal: Answer."
    words = ("not yet", "Right so far:", "it answers", "Fix this next:", "area", "Multiply", "The goal:")
    places = [FAILED.html().index(word) for word in words]
    assert places == sorted(places)


def test_a_failure_at_once_has_one_thing_to_fix_first() -> None:
    """If the first assertion fails, the report has no section "Right so far"."""
    report = Report("05.1", Verdict.FAILED, "Answer.", 0, 2, FAILED.assertions[1:])
    assert str(report).splitlines()[1:3] == ["  Fix this first:", "  ✗ <b>area</b>"]
    assert "Right so far" not in report.html()


def test_a_part_that_is_not_attempted_has_one_thing_to_do() -> None:
    """If a part is not attempted, the report first says what to do, and then shows the goal."""
    report = Report("05.1", Verdict.NOT_ATTEMPTED, "Answer.", 0, 2, note="Replace the ... in f.")
    assert str(report).splitlines()[1:] == ["  Replace the ... in f.", "  The goal: Answer."]
    assert "<ul" not in report.html()


def test_the_html_of_a_pass_has_no_heading() -> None:
    """The report on a pass has the same HTML as in the stored solutions, without a heading."""
    report = Report("05.1", Verdict.PASSED, "Answer.", 2, 2, FAILED.assertions[:1])
    assert report.html() == (
        '<section class="course-report" style="border-left:4px solid #2e7d32;padding:0.2em 1em">'
        "<p><strong>05.1 passed: 2 of 2 points</strong></p>"
        '<ul style="list-style:none;padding-left:0">'
        '<li><span role="img" aria-label="holds">✓</span> it answers</li></ul></section>'
    )


def test_html_is_escaped() -> None:
    """HTML characters in a student's text are escaped."""
    html = FAILED.html()
    assert "<script>" not in html
    assert "<b>" not in html
    assert "&lt;script&gt;" in html


def test_report_does_not_change_in_the_channel() -> None:
    """The client prints the same report that the check runner has sent."""
    assert report_from(json.loads(json.dumps(FAILED.as_dict()))) == FAILED
