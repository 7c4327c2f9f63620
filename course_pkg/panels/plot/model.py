"""Measured data made ready for drawing: checked, thinned, and as a table; no page, no kernel."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Iterable, Mapping
from itertools import accumulate, groupby
from typing import Any, TypeAlias

from course_pkg.errors import NotASeries
from course_pkg.panels.plot.thinning import COLUMNS, MANY, thinned

Point: TypeAlias = tuple[float, float]
Series: TypeAlias = "Mapping[str, Iterable[Iterable[float]]] | Mapping[str, float]"

KINDS = ("line", "dots", "bars")
ROWS = 100  # of each series in the table; a page with more of them is slow to open and nobody reads them
_FORM = {
    "line": "{'label': [(x, y), …]}",
    "dots": "{'label': [(x, y), …]}",
    "bars": "{'label': number}",
}


def drawing(
    series: Series, *, x: str = "", y: str = "", kind: str = "line", title: str = "", log: bool = False
) -> dict[str, Any]:
    """Return all that a page needs, as data that JSON can carry. Raises NotASeries.

    `x` and `y` name the axes, with units in parentheses. What cannot be drawn (NaN, infinite, and on a
    logarithmic axis what is not above 0) is left out and counted in `notes`.
    """
    if kind not in KINDS:
        raise NotASeries(f"Plot: there is no kind {kind!r}. Give one of {', '.join(map(repr, KINDS))}.")
    if not isinstance(series, Mapping):
        raise NotASeries(f"Plot: {_shortened(series)} is no dict of series. Give {_FORM[kind]}.")
    prepare = _bars if kind == "bars" else _curves
    about = {"title": title, "x": x, "y": y, "kind": kind, "log": log}
    return about | prepare(series, kind, log, x, y)


def _bars(series: Mapping[str, Any], kind: str, log: bool, x: str, y: str) -> dict[str, Any]:
    values = {str(label): _number(value, label, kind) for label, value in series.items()}
    kept = {label: value for label, value in values.items() if _fits(value, log)}
    table = {"head": [x, y or "value"], "rows": [[label, f"{value:g}"] for label, value in values.items()]}
    notes = [
        f"{label!r} is left out: {value:g} is {_why(value)}."
        for label, value in values.items()
        if label not in kept
    ]
    shown = [{"label": label, "value": value} for label, value in kept.items()]
    return {"bars": shown, "series": [], "notes": notes, "tables": [table] if values else []}


def _curves(series: Mapping[str, Any], kind: str, log: bool, x: str, y: str) -> dict[str, Any]:
    points = {str(label): _points(given, label, kind) for label, given in series.items()}
    runs = {label: _runs(every, kind, log) for label, every in points.items()}
    kept = {label: [point for run in every for point in run] for label, every in runs.items()}
    shown = [_curve(label, runs[label], kind, log) | {"given": len(points[label])} for label in points]
    notes = [note for label in points for note in _notes(label, points[label], kept[label], kind)]
    tables = [_spread(kept, y), _values(points, x, y)] if any(points.values()) else []
    return {"bars": [], "series": shown, "notes": notes, "tables": tables}


def _curve(label: str, runs: list[list[Point]], kind: str, log: bool) -> dict[str, Any]:
    """Return the points to draw; at each of `breaks`, indices of points, a new stroke begins."""
    points = [point for run in runs for point in run]
    rounded = [_rounder([point[axis] for point in points]) for axis in (0, 1)]
    strokes = [thinned(run, kind, log) for run in runs]
    drawn = [[rounded[0](across), rounded[1](up)] for stroke in strokes for across, up in stroke]
    breaks = list(accumulate(map(len, strokes)))[:-1]
    return {"label": label, "points": drawn, "breaks": breaks, "count": len(points)}


def _runs(points: list[Point], kind: str, log: bool) -> list[list[Point]]:
    """Return what can be drawn; of a line what stands between two gaps, so that none is bridged."""
    groups = groupby(points, lambda point: _drawable(point, log))
    runs = [list(group) for drawable, group in groups if drawable]
    return runs if kind == "line" else [[point for run in runs for point in run]]


def _notes(label: str, points: list[Point], kept: list[Point], kind: str) -> list[str]:
    notes = []
    lost = [point for point in points if not all(map(math.isfinite, point))]
    low = len(points) - len(kept) - len(lost)
    if lost:
        notes.append(f"{_left_out(len(lost), label)} {_why(math.nan)}.")
    if low:
        notes.append(f"{_left_out(low, label)} {_why(0.0)}.")
    if kind == "line" and len(kept) > MANY:
        notes.append(
            f"Of the {len(kept):,} points of {label!r}, the first, last, smallest and largest in each of "
            f"{COLUMNS} columns are drawn: the picture is the same."
        )
    return notes


def _spread(kept: Mapping[str, list[Point]], y: str) -> dict[str, Any]:
    rows = []
    for label, points in kept.items():
        values = [point[1] for point in points]
        figures = [min(values), statistics.median(values), max(values)] if values else []
        rows.append(
            [label, str(len(values)), *(f"{each:.6g}" for each in figures), *["-"] * (3 - len(figures))]
        )
    unit = f", {y}" if y else ""
    return {"head": ["Series", "points", f"smallest{unit}", "median", "largest"], "rows": rows}


def _values(points: Mapping[str, list[Point]], x: str, y: str) -> dict[str, Any]:
    rows = [
        [label, f"{across:.9g}", f"{up:.9g}"]
        for label, every in points.items()
        for across, up in every[:ROWS]
    ]
    cut = [
        f"Here are the first {ROWS} of the {len(every):,} points of {label!r}."
        for label, every in points.items()
        if len(every) > ROWS
    ]
    return {"head": ["Series", x or "x", y or "y"], "rows": rows, "note": " ".join(cut)}


def _points(given: Any, label: object, kind: str) -> list[Point]:  # noqa: ANN401 - whatever a cell holds
    try:
        pairs = [tuple(pair) for pair in given]
    except TypeError:
        raise _wrong(label, given, kind) from None
    for pair in pairs:
        if len(pair) != 2:
            raise _wrong(label, pair, kind)
    return [(_number(across, label, kind), _number(up, label, kind)) for across, up in pairs]


def _number(value: Any, label: object, kind: str) -> float:  # noqa: ANN401 - whatever a cell holds
    if not isinstance(value, str):
        try:
            return float(value)
        except (TypeError, ValueError, OverflowError):
            pass
    raise _wrong(label, value, kind)


def _wrong(label: object, value: object, kind: str) -> NotASeries:
    other = " For one number each, say kind='bars'." if kind != "bars" else ""
    return NotASeries(f"Plot: {_shortened(value)} in {label!r} cannot be drawn. Give {_FORM[kind]}.{other}")


def _shortened(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:59]}…"


def _drawable(point: Point, log: bool) -> bool:
    return math.isfinite(point[0]) and _fits(point[1], log)


def _fits(value: float, log: bool) -> bool:
    return math.isfinite(value) and (value > 0 or not log)


def _why(value: float) -> str:
    return (
        "not above 0, which a logarithmic axis cannot show" if math.isfinite(value) else "not a finite number"
    )


def _left_out(number: int, label: str) -> str:
    return (
        f"1 point of {label!r} is left out:"
        if number == 1
        else f"{number:,} points of {label!r} are left out:"
    )


def _rounder(values: list[float]) -> Callable[[float], float]:
    """Return what rounds to a millionth of the range, or of the value where that is finer."""
    span = max(values) - min(values) if values else 0.0
    digits = 6 - math.floor(math.log10(span)) if span > 0 and math.isfinite(span) else 12

    def rounded(value: float) -> float:
        own = 5 - math.floor(math.log10(abs(value))) if value else 0
        return round(value, max(digits, own))

    return rounded
