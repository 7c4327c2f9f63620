"""From what a cashier reports to what a plot and a table show."""

from __future__ import annotations

import math

import pytest

from course_pkg.shop import Findings, Visit, side_by_side
from course_pkg.shop.findings import age_points


def trial(
    design: str = "poll",
    greeted: dict[int, float] | None = None,
    asked: int = 0,
    effort: float = 0.1,
) -> Findings:
    """Return a trial of 10 s with four customers, who come at 1, 2, 3 and 4 s and stay for a second each."""
    visits = tuple(Visit(number, float(number), number + 1.0) for number in (1, 2, 3, 4))
    return Findings(design, visits, greeted or {}, asked, 0, 10.0, {"cashier": effort, "detector": effort})


def test_delays_count_from_the_moment_of_coming() -> None:
    """Those who were not greeted, or only after they had gone, are lost and have no delay."""
    found = trial(greeted={1: 1.25, 2: 3.5, 4: 4.75})
    assert found.delays == {1: 0.25, 4: 0.75}
    assert (found.lost, found.mean_delay, found.median_delay) == (2, 0.5, 0.5)
    assert found.delay_points == [(1.0, 250.0), (4.0, 750.0)]


def test_a_day_on_which_nobody_was_greeted() -> None:
    """It is no error: all are lost, and there is no delay to speak of."""
    found = trial()
    assert (found.lost, found.delays) == (4, {})
    assert math.isnan(found.mean_delay)
    assert math.isnan(found.median_delay)


def test_knowledge_ages_until_there_is_news() -> None:
    """The age grows by a second each second, and falls to nothing with each news within the trial."""
    points = [(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (5.0, 3.0), (5.0, 0.0), (10.0, 5.0)]
    assert age_points([-1.0, 2.0, 5.0, 11.0], 10.0) == points
    assert age_points([], 10.0) == [(0.0, 0.0), (10.0, 10.0)]


def test_effort_is_a_share_of_a_core() -> None:
    """0.1 s in 10 s is one percent."""
    assert trial().cpu == pytest.approx({"cashier": 1.0, "detector": 1.0})


def test_a_table_of_what_is_certain() -> None:
    """It speaks in words, which are the same in each run, and measures effort by the cheapest design."""
    prompt = {number: number + 0.01 for number in (1, 2, 3, 4)}
    table = side_by_side(
        [
            trial("rarely", {1: 1.9}, asked=5),
            trial("often", prompt, asked=400, effort=1.0),
            trial("topic", {number: prompt[number] for number in (1, 2, 3)}),
        ]
    )
    assert table.splitlines() == [
        "design  greets        lost    calls     processor",
        "rarely  later         some    a few     little",
        "often   within 0.1 s  nobody  hundreds  much",
        "topic   within 0.1 s  some    none      little",
    ]


def test_a_table_of_nothing() -> None:
    """It has its head."""
    assert side_by_side([]).split() == ["design", "greets", "lost", "calls", "processor"]
