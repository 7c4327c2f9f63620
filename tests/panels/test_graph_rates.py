"""Rates from counts: as many digits as they can tell, and a number that stands still."""

from __future__ import annotations

import random

import pytest

from course_pkg.graph import Activity, Carried
from course_pkg.panels.graph.rates import LONG, Meter, Rates, plainest, words


def counted(rate: float, seconds: float, *, late: float = 0.0, seed: int = 1) -> Meter:
    """Read a steady rate every 2 s, each time up to `late` s after what was counted."""
    meter, chance = Meter(), random.Random(seed)  # noqa: S311 - a test's own dice
    for turn in range(int(seconds / 2) + 1):
        meter.read(2.0 * turn + chance.uniform(0, late), int(rate * 2 * turn))
    return meter


@pytest.mark.parametrize("rate", [0.2, 0.5, 1, 5, 10, 15, 62, 100, 1000])
def test_a_steady_rate_is_found_and_stands_still(rate: float) -> None:
    """After half a minute the number is the one that the publisher was given, whenever one looks."""
    seen = {counted(rate, seconds, late=0.03).rate for seconds in range(34, 60, 2)}
    assert len(seen) == 1
    assert seen.pop() == pytest.approx(rate, rel=0.06 if rate > 1 else 0.2)


def test_two_counts_are_enough_for_a_first_number() -> None:
    """One count tells nothing; two that are 2 s apart do."""
    assert counted(10, 0).rate is None
    assert counted(10, 2).rate == pytest.approx(10, abs=1)


def test_silence_and_a_new_rate_are_seen_soon() -> None:
    """A publisher that stops is at 0 after two looks; one that goes faster is not averaged with before."""
    meter = counted(10, 30)
    for at in (32.0, 34.0, 36.0):
        meter.read(at, 300)
    assert meter.rate == 0
    for turn in range(1, 4):
        meter.read(36.0 + 2 * turn, 300 + 80 * turn)
    assert meter.rate == pytest.approx(40, rel=0.05)


def test_a_publisher_that_began_anew_is_counted_anew() -> None:
    """A count that goes back is another connection, and never a negative rate."""
    meter = counted(10, 30)
    meter.read(32.0, 4)
    assert meter.rate is not None
    assert meter.rate >= 0
    meter.read(34.0, 24)
    assert meter.rate == pytest.approx(10, abs=1)


def test_the_memory_is_bounded() -> None:
    """Nothing older than half a minute is kept."""
    meter = counted(10, 600)
    assert len(meter._counts) <= LONG / 2 + 1


@pytest.mark.parametrize(
    ("rate", "doubt", "shown"),
    [
        (9.75, 0.25, 10),
        (10.25, 0.25, 10),
        (12.3, 0.05, 12.3),
        (12.3, 0.5, 12),
        (0.033, 0.03, 0.03),
        (0, 1, 0),
    ],
)
def test_no_more_digits_than_the_counts_can_tell(rate: float, doubt: float, shown: float) -> None:
    """The plainest number within the doubt is shown."""
    assert plainest(rate, doubt) == pytest.approx(shown)


@pytest.mark.parametrize(
    ("rate", "shown"),
    [
        (0, "0 Hz"),
        (0.03, "< 0.1 Hz"),
        (0.5, "0.5 Hz"),
        (10.0, "10 Hz"),
        (999.7, "1 kHz"),
        (12300, "12.3 kHz"),
    ],
)
def test_a_rate_in_words(rate: float, shown: str) -> None:
    """It has a unit, and fits below the name of a topic."""
    assert words(rate) == shown
    assert len(shown) <= 12


def test_a_connection_that_is_gone_is_forgotten() -> None:
    """What is no longer counted has no rate."""
    rates, carried = Rates(), Carried("/t", "/a", "/b", 1, 10)
    rates.read(Activity(0.0, (carried,)))
    rates.read(Activity(2.0, (Carried("/t", "/a", "/b", 1, 30),)))
    assert rates.of(carried) == pytest.approx(10, abs=1)
    rates.read(Activity(4.0))
    assert rates.of(carried) is None
