"""The points of a part are divided among its goals."""

from __future__ import annotations

import pytest

from course_pkg.checking.assertions import AssertionFailed, Results
from course_pkg.checking.credit import divided, earned, goals_of, total, with_fulfilled
from course_pkg.checking.parts import every_part
from course_pkg.checking.report import Assertion, Report, Verdict, report_from


@pytest.mark.parametrize(
    ("points", "weights", "shares"),
    [
        (2, [1, 1], [1, 1]),
        (2, [1, 1, 1], [0.67, 0.67, 0.66]),
        (1, [1, 1, 1], [0.34, 0.33, 0.33]),
        (3, [2, 1, 1], [1.5, 0.75, 0.75]),
        (0, [1, 1], [0, 0]),
    ],
)
def test_shares_have_two_decimals_and_add_up(
    points: float, weights: list[float], shares: list[float]
) -> None:
    """The goals' points have at most two decimals, and their sum is the points of the part."""
    assert divided(points, weights) == shares
    assert round(sum(shares), 2) == points


@pytest.mark.parametrize("given", [["one"], ["a", "a"], {"a": 1, "b": 0}, {"a": 1, "b": -1}])
def test_a_wrong_declaration_is_refused(given: list[str] | dict[str, float]) -> None:
    """A part needs at least two different goals with positive weights."""
    with pytest.raises(ValueError, match=r"05\.1: give at least two different goals"):
        goals_of("05.1", 2, given)


def test_the_goals_of_each_part_have_its_points() -> None:
    """The points of the goals add up to the points of the part."""
    for part in every_part():
        assert not part.goals or total(part.goals) == part.points, part.check
        assert all(goal.points > 0 for goal in part.goals), part.check


def test_a_mark_counts_after_a_failure_and_a_separate_goal_does_not() -> None:
    """After a check has stopped early, only marked goals without a failed assertion count.

    If a check runs completely, all goals without a failed assertion count.
    """
    results = Results()
    results.marked.add("first")
    results.goal_ended("separate", fulfilled=True)
    results.goal_ended("failed", fulfilled=False)
    results.goal_ended("failed", fulfilled=True)
    results.marked.add("failed")
    assert results.kept_goals == {"first"}
    assert results.fulfilled_goals == {"first", "separate"}
    assert results.failed_goals == {"failed"}


def test_a_report_shows_the_first_failure_of_an_assertion() -> None:
    """If an assertion fails several times in a loop, the report shows the first failure."""
    results = Results()
    for actual in ("1", "2"):
        with pytest.raises(AssertionFailed):
            results.fails("it is 0", expected="0", actual=actual)
    assert [each.actual for each in results.assertions] == ["1"]


def test_a_report_lists_the_points_of_each_goal() -> None:
    """The report lists the points of each goal if the part did not pass."""
    goals = with_fulfilled(goals_of("05.1", 2, {"Measure a box.": 3, "Refuse a box.": 1}), ["Measure a box."])
    failed = Report("05.1", Verdict.FAILED, "", earned(goals), 2, (Assertion("x", False),), goals=goals)
    text = str(failed)
    assert text.startswith("05.1 not yet: 1.5 of 2 points")
    assert text.endswith("1.5 of 1.5: Measure a box.\n    0 of 0.5: Refuse a box.")
    assert "<li>1.5 of 1.5: Measure a box.</li>" in failed.html()
    assert report_from(failed.as_dict()) == failed
    assert "Points for each goal" not in str(Report("05.1", Verdict.PASSED, "", 2, 2, goals=goals))
