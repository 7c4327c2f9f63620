"""Plots: what is drawn of measured data, what is left out, and what the table says."""

from __future__ import annotations

import gc
import json
import math
import random
from typing import Any

import pytest

from course_pkg.errors import NotASeries
from course_pkg.panels.plot.model import ROWS, drawing
from course_pkg.panels.plot.thinning import COLUMNS, MANY, thinned
from course_pkg.panels.plot.view import Plot

DELAYS = {"topic": [(0.0, 3.0), (1.0, 4.5)], "service": [(0.0, 1.5), (1.0, 0.5), (2.0, 1.0)]}


def test_every_point_of_a_short_series_is_drawn() -> None:
    """A page gets the points as they were measured, and how many there are."""
    curves = drawing(DELAYS, x="time (s)", y="delay (ms)")["series"]
    assert [curve["label"] for curve in curves] == ["topic", "service"]
    assert curves[0]["points"] == [[0.0, 3.0], [1.0, 4.5]]
    assert [curve["count"] for curve in curves] == [2, 3]


def test_the_table_says_the_same() -> None:
    """First how the values of each series are spread, then every point in words."""
    spread, values = drawing(DELAYS, x="time (s)", y="delay (ms)")["tables"]
    assert spread["rows"] == [["topic", "2", "3", "3.75", "4.5"], ["service", "3", "0.5", "1", "1.5"]]
    assert values["head"] == ["Series", "time (s)", "delay (ms)"]
    assert values["rows"][1] == ["topic", "1", "4.5"]
    assert len(values["rows"]) == 5


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("kind", ["line", "dots"])
def test_what_is_no_number_is_left_out_and_said_so(bad: float, kind: str) -> None:
    """NaN and infinity have no place on an axis; the reader learns that they were measured."""
    made = drawing({"topic": [(0, 1), (1, bad), (bad, 2), (3, 4)]}, kind=kind)
    assert made["series"][0]["points"] == [[0.0, 1.0], [3.0, 4.0]]
    assert made["notes"] == ["2 points of 'topic' are left out: not a finite number."]


def test_a_gap_in_a_line_is_not_bridged() -> None:
    """Where a value could not be drawn, a new stroke begins; dots need none."""
    points = [(0, 1), (1, 2), (2, math.nan), (3, 3), (4, math.inf), (5, 4), (6, 5)]
    curve = drawing({"topic": points})["series"][0]
    assert [point[0] for point in curve["points"]] == [0.0, 1.0, 3.0, 5.0, 6.0]
    assert curve["breaks"] == [2, 3]
    assert drawing({"topic": points}, kind="dots")["series"][0]["breaks"] == []


def test_a_logarithmic_axis_leaves_out_what_is_not_above_zero() -> None:
    """Zero and below cannot be shown there; without `log` they are."""
    points = {"topic": [(0, 0.0), (1, -2.0), (2, 3.0)]}
    assert drawing(points, log=True)["series"][0]["points"] == [[2.0, 3.0]]
    assert "not above 0" in drawing(points, log=True)["notes"][0]
    assert len(drawing(points)["series"][0]["points"]) == 3


def test_bars_take_a_number_each() -> None:
    """A bar has a label and a number; what cannot be drawn is in the table and in a note."""
    made = drawing({"polling": 12, "topic": 0.5, "lost": math.nan}, y="delay (ms)", kind="bars")
    assert made["bars"] == [{"label": "polling", "value": 12.0}, {"label": "topic", "value": 0.5}]
    assert made["notes"] == ["'lost' is left out: nan is not a finite number."]
    assert made["tables"][0]["rows"][2] == ["lost", "nan"]


@pytest.mark.parametrize(
    ("series", "kind", "stretch"),
    [
        ({"topic": [1.0, 2.0]}, "line", "[1.0, 2.0] in 'topic'"),
        ({"topic": 3.0}, "line", "kind='bars'"),
        ({"topic": [(1, 2, 3)]}, "dots", "(1, 2, 3)"),
        ({"topic": [(1, "fast")]}, "dots", "'fast'"),
        ({"topic": [(1, 2)]}, "bars", "{'label': number}"),
        ([(1, 2)], "line", "no dict of series"),
        ({"topic": [(0, 1)]}, "pie", "'line', 'dots', 'bars'"),
    ],
)
def test_what_cannot_be_drawn_is_refused_with_the_form_that_can(series: Any, kind: str, stretch: str) -> None:  # noqa: ANN401
    """The message names the value and says what to give."""
    with pytest.raises(NotASeries) as caught:
        drawing(series, kind=kind)
    assert stretch in str(caught.value)
    assert "Give" in str(caught.value)


def test_a_plot_that_was_refused_leaves_no_trace() -> None:
    """The half-made widget is thrown away without a word: the error in the cell is enough."""
    with pytest.raises(NotASeries):
        Plot({"topic": [1.0]})
    gc.collect()


def noise(count: int) -> list[tuple[float, float]]:
    """Make points from left to right."""
    draw = random.Random(7)  # noqa: S311 - noise, no secret
    return [(index + 0.9 * draw.random(), draw.gauss(0, 1)) for index in range(count)]


def test_a_long_line_keeps_what_can_be_seen_of_it() -> None:
    """The first and last point, and the highest and lowest of every pixel column, are drawn."""
    points = noise(10_000)
    kept = thinned(points, "line")
    assert len(kept) <= 4 * COLUMNS
    assert kept == sorted(set(kept), key=points.index)
    assert (kept[0], kept[-1]) == (points[0], points[-1])
    start, width = points[0][0], (points[-1][0] - points[0][0]) / COLUMNS
    for column in range(COLUMNS - 1):
        low, high = start + column * width, start + (column + 1) * width
        before = [y for x, y in points if low <= x < high]
        after = [y for x, y in kept if low <= x < high]
        assert (min(before), max(before)) == (min(after), max(after))


def test_a_spike_is_never_thinned_away() -> None:
    """One late message among ten thousand is what the plot is for."""
    points = [(float(index), 1.0) for index in range(10_000)]
    points[4321] = (4321.0, 80.0)
    assert (4321.0, 80.0) in thinned(points, "line")
    assert [4321.0, 80.0] in drawing({"delay": points})["series"][0]["points"]


def test_a_page_is_told_of_thinning() -> None:
    """The count is that of the measured points, and the table is cut and says so."""
    made = drawing({"delay": noise(10_000)})
    assert made["series"][0]["count"] == 10_000
    assert "10,000 points of 'delay'" in made["notes"][0]
    assert len(made["tables"][1]["rows"]) == ROWS
    assert made["tables"][1]["note"] == f"Here are the first {ROWS} of the 10,000 points of 'delay'."
    assert len(json.dumps(made)) < 200_000


@pytest.mark.parametrize("kind", ["line", "dots"])
def test_dots_and_loops_lose_only_what_lies_on_the_same_pixel(kind: str) -> None:
    """A line that turns back is no function of x: where it goes, it still goes."""
    loop = [(math.cos(turn / 500), math.sin(turn / 500)) for turn in range(5 * MANY)]
    kept = thinned(loop, kind)
    assert len(kept) < len(loop)
    for x, y in loop[:: len(loop) // 97]:
        assert min(math.hypot(x - one, y - other) for one, other in kept) < 0.01


def test_numbers_of_any_size_survive() -> None:
    """Times since 1970 keep their milliseconds, and the widest range does not overflow."""
    made = drawing({"a": [(1.7e9 + 0.001, 1e-9), (1.7e9 + 5.002, 2e-9)]})
    assert made["series"][0]["points"] == [[1700000000.001, 1e-9], [1700000005.002, 2e-9]]
    wide = [(float(index), (-1) ** index * 1.7e308) for index in range(3 * MANY)]
    assert len(drawing({"a": wide})["series"][0]["points"]) > 2


def test_nothing_measured_is_no_error() -> None:
    """An empty plot has nothing to show and nothing to explain."""
    for series, kind in (({}, "line"), ({"topic": []}, "dots"), ({}, "bars")):
        made = drawing(series, kind=kind)
        assert made["notes"] == made["tables"] == []


def test_the_text_is_the_title() -> None:
    """text/plain does not depend on what was measured."""
    assert repr(Plot(DELAYS, title="How late?")) == "Plot('How late?')"
    assert repr(Plot({"a": 1.5}, kind="bars")) == "Plot()"
    assert Plot(DELAYS)._repr_mimebundle_()[0]["text/plain"] == "Plot()"
