"""Partial credit: how the points of a part are divided among its goals.

The points of a goal have at most two decimals. The points of all goals add up to exactly the points of the
part.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction


@dataclass(frozen=True)
class Goal:
    """One goal of a part, its points, and whether the student's work fulfils it."""

    text: str
    points: float
    fulfilled: bool = False


def goals_of(check: str, points: int, given: Sequence[str] | Mapping[str, float]) -> tuple[Goal, ...]:
    """Return the goals that an author declares for the part `check`.

    If `given` is a sequence, the points are divided equally; a mapping contains the weight of each goal.
    Raises ValueError if there is only one goal, if two goals are equal, or if a weight is not positive.
    """
    weights = dict(given) if isinstance(given, Mapping) else dict.fromkeys(given, 1.0)
    if given and (len(weights) < 2 or len(weights) < len(given) or min(weights.values()) <= 0):
        raise ValueError(f"{check}: give at least two different goals with positive weights, or none")
    shares = divided(points, list(weights.values()))
    return tuple(Goal(text, share) for text, share in zip(weights, shares, strict=True))


def divided(points: float, weights: Sequence[float]) -> list[float]:
    """Divide the points in proportion to the weights; at least one weight has to be positive.

    The shares have two decimals, and their sum is exactly `points`. For example, three goals with 2 points in
    total get 0.67, 0.67 and 0.66 points.
    """
    cents, total = round(points * 100), sum(map(Fraction, weights))
    exact = [cents * Fraction(weight) / total for weight in weights]
    shares = [int(share) for share in exact]
    by_rest = sorted(range(len(exact)), key=lambda place: shares[place] - exact[place])
    for place in by_rest[: cents - sum(shares)]:
        shares[place] += 1
    return [share / 100 for share in shares]


def total(goals: Iterable[Goal]) -> float:
    """Return the sum of the goals' points."""
    return round(sum(goal.points for goal in goals), 2)


def earned(goals: Iterable[Goal]) -> float:
    """Return the points of the goals that are fulfilled."""
    return total(goal for goal in goals if goal.fulfilled)


def with_fulfilled(goals: Iterable[Goal], fulfilled: Iterable[str]) -> tuple[Goal, ...]:
    """Return copies of the goals; a goal is fulfilled if its text is in `fulfilled`."""
    texts = set(fulfilled)
    return tuple(replace(goal, fulfilled=goal.text in texts) for goal in goals)
