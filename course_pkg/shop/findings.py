"""What came of one trial of a design: who was greeted how late, what it cost, how old its knowledge got."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import mean, median

from course_pkg.shop.counter import Visit

Points = list[tuple[float, float]]
PROMPT = 0.1  # s within which a greeting counts as prompt
MUCH = 5.0  # times the processor time of the cheapest design


@dataclass(frozen=True)
class Findings:
    """One design, tried on one day's customers; times are in s from the beginning of the trial."""

    design: str
    customers: tuple[Visit, ...]
    greeted: Mapping[int, float]  # when, by the customer's number
    asked: int  # calls made
    heard: int  # messages received
    lasted: float  # s
    effort: Mapping[str, float]  # s of processor time, by process

    @property
    def delays(self) -> dict[int, float]:
        """How long each customer waited for a greeting, in s; those who got none in time are left out."""
        waits = {visit.number: (self.greeted.get(visit.number), visit) for visit in self.customers}
        return {
            number: when - visit.comes
            for number, (when, visit) in waits.items()
            if when is not None and when < visit.goes
        }

    @property
    def mean_delay(self) -> float:
        """The mean of the delays, in s; not a number where nobody was greeted."""
        return mean(self.delays.values()) if self.delays else float("nan")

    @property
    def median_delay(self) -> float:
        """The median of the delays, in s; not a number where nobody was greeted."""
        return median(self.delays.values()) if self.delays else float("nan")

    @property
    def lost(self) -> int:
        """How many customers left before they were greeted."""
        return len(self.customers) - len(self.delays)

    @property
    def cpu(self) -> dict[str, float]:
        """The share of one processor core that each process took, in percent."""
        return {name: 100 * seconds / self.lasted for name, seconds in self.effort.items()}

    @property
    def delay_points(self) -> Points:
        """For a plot: when each greeted customer came (s), and how long they waited (ms)."""
        comes = {visit.number: visit.comes for visit in self.customers}
        return [(comes[number], 1000 * delay) for number, delay in self.delays.items()]

    def __repr__(self) -> str:
        return f"<{self.design}: {len(self.customers)} customers>"


def age_points(news: Sequence[float], lasted: float) -> Points:
    """Return for a plot how old knowledge was at each time (s, s), where there was news at the times `news`.

    From 0 to `lasted` s, and fresh at 0; news before or after that does not count.
    """
    times = [0.0, *(time for time in news if 0 < time < lasted), lasted]
    teeth = [[(now, now - before), (now, 0.0)] for before, now in pairwise(times)]
    return [(0.0, 0.0), *(point for tooth in teeth for point in tooth)][:-1]


def side_by_side(trials: Sequence[Findings]) -> str:
    """Return a table of what the trials show beyond doubt, in words; a plot has the numbers."""
    least = min((sum(trial.effort.values()) / trial.lasted for trial in trials), default=0.0)
    head = ("design", "greets", "lost", "calls", "processor")
    rows = [head, *(_row(trial, least) for trial in trials)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(line.rstrip() for line in lines)


def _row(trial: Findings, least: float) -> tuple[str, ...]:
    much = sum(trial.effort.values()) / trial.lasted > MUCH * least
    return (
        trial.design,
        "within 0.1 s" if trial.median_delay < PROMPT else "later",
        "some" if trial.lost else "nobody",
        "none" if not trial.asked else "hundreds" if trial.asked >= 100 else "a few",
        "much" if much else "little",
    )
