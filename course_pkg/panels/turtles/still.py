"""Draws a still picture of the turtles: their trails, and the turtles at their final positions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any
from xml.etree.ElementTree import Element, SubElement

from course_pkg.panels.paper import EDGES, FAINT, Paper, State, Style, number

SIDE = 500.0  # width and height in px of the simulator's window
WORLD = 11088.889  # width and height in mm of the area in which the turtles move
PEN = "3"  # the default width of a pen in px; no topic contains the width
# The head, feet and tail, which the panel draws under the shell of a turtle: centres and half axes (px).
LIMBS = (
    (19, 0, 7, 5),
    (11, 13, 6, 4),
    (11, -13, 6, 4),
    (-11, 13, 6, 4),
    (-11, -13, 6, 4),
    (-19, 0, 5, 2),
)
SHELLS = ("#2e7d32", "#1565c0", "#6a1b9a", "#ad5300", "#00695c", "#b71c1c")
GREEN, WHITE, DARK = "#9ccc65", "#ffffff", "#10182b"

Row = Sequence[Any]  # The docstring of recording.py describes the rows.


def still(state: State) -> str:
    """Return a picture of the last state in which the simulator was running."""
    recorded = state["recorded"]
    # Leave out the turtles of a check; their names contain "/", because a check uses a random namespace.
    own = {turtle for turtle, name in enumerate(recorded["names"]) if "/" not in name}
    rows = [list(row) for row in recorded["rows"] if not own or row[1] < 0 or row[1] in own]
    trails, here = _played(rows)
    if not here:
        while rows and rows[-1][2] in ("gone", "cleared"):
            rows.pop()
        trails, here = _played(rows)
    names = [recorded["names"][turtle] for turtle in sorted(here)]
    paper = Paper(f"The window of turtlesim with {_counted(names)}", SIDE + 2 * EDGES)
    red, green, blue = recorded["background"]
    dark = 0.3 * red + 0.6 * green + 0.1 * blue < 128
    group = Element("g", {"transform": f"translate({number(EDGES)} {number(paper.y)})"})
    side = {"width": number(SIDE), "height": number(SIDE)}
    SubElement(group, "rect", {**side, "fill": _colour(recorded["background"])})
    for colour, points in trails:
        line = {"stroke": _colour(recorded["palette"][colour]), "stroke-width": PEN, "fill": "none"}
        at = " ".join(f"{number(x)},{number(y)}" for x, y in points)
        SubElement(group, "polyline", {**line, "points": at, "stroke-linecap": "round"})
    for turtle, row in sorted(here.items()):
        _draw_turtle(group, row, turtle)
    for turtle, row in sorted(here.items()):
        _draw_name(group, row, recorded["names"][turtle], WHITE if dark else DARK)
    for child in group:
        child.tail = "\n"
    paper.put_in(group)
    paper.y += SIDE + 6
    paper.write(
        _counted(names) if names else "No turtle yet. Start a simulator; its turtles appear here.", FAINT
    )
    return paper.svg()


def _counted(names: Sequence[str]) -> str:
    if not names:
        return "no turtle"
    return f"{len(names)} {'turtle' if len(names) == 1 else 'turtles'}: {', '.join(names)}"


def _played(rows: list[list[Any]]) -> tuple[list[tuple[int, list[tuple[float, float]]]], dict[int, Row]]:
    """Return the trails and the last row of each turtle.

    A trail consists of a colour and a list of points (px).
    """
    for index, row in enumerate(rows):
        if row[2] == "undrawn":  # The pen has been up since the time row[3].
            for earlier in rows[:index]:
                if earlier[1] == row[1] and not isinstance(earlier[2], str) and earlier[0] > row[3]:
                    earlier[5] = -1
    trails: list[tuple[int, list[tuple[float, float]]]] = []
    going: dict[int, tuple[int, list[tuple[float, float]]]] = {}
    here: dict[int, Row] = {}
    for row in rows:
        turtle, what = row[1], row[2]
        if what == "cleared":
            trails, going = [], {}
        elif what == "gone":
            here.pop(turtle, None)
            going.pop(turtle, None)
        elif not isinstance(what, str):
            colour, point = row[5], _pixel(row)
            if colour >= 0 and turtle in here:
                trail = going.get(turtle)
                if trail is None or trail[0] != colour:
                    trail = going[turtle] = (colour, [_pixel(here[turtle])])
                    trails.append(trail)
                _extend(trail[1], point)
            else:
                going.pop(turtle, None)
            here[turtle] = row
    return trails, here


def _extend(points: list[tuple[float, float]], point: tuple[float, float]) -> None:
    """Add a point to a trail. A new point that continues a straight line replaces the last point."""
    if len(points) > 1:
        (x1, y1), (x2, y2), (x3, y3) = points[-2], points[-1], point
        if (
            abs((x2 - x1) * (y3 - y1) - (x3 - x1) * (y2 - y1)) < 0.5
            and (x2 - x1) * (x3 - x2) + (y2 - y1) * (y3 - y2) >= 0
        ):
            points.pop()
    points.append(point)


def _pixel(row: Row) -> tuple[float, float]:
    return row[2] / WORLD * (SIDE - 1), (1 - row[3] / WORLD) * (SIDE - 1)


def _draw_turtle(group: Element, row: Row, turtle: int) -> None:
    (x, y), degrees = _pixel(row), -row[4] / 1000 * 57.29578
    move = f"translate({number(x)} {number(y)}) rotate({number(degrees)})"
    body = SubElement(group, "g", {"transform": move, "stroke": WHITE, "stroke-width": "1.5"})
    shell = SHELLS[turtle % len(SHELLS)]
    for cx, cy, rx, ry, fill in (*((*limb, GREEN) for limb in LIMBS), (0, 0, 16, 13, shell)):
        SubElement(
            body, "ellipse", {"cx": str(cx), "cy": str(cy), "rx": str(rx), "ry": str(ry), "fill": fill}
        )


def _draw_name(group: Element, row: Row, name: str, colour: str) -> None:
    style = Style(12.0, mono=True)
    x, y = _pixel(row)
    reach = style.width(name) / 2 + 4
    at = {"x": number(min(max(x, reach), SIDE - reach)), "y": number(y + (-22 if y > SIDE - 40 else 34))}
    look = {"fill": colour, "font-family": "Menlo, Consolas, monospace", "font-size": "12"}
    SubElement(group, "text", {**at, **look, "text-anchor": "middle"}).text = name


def _colour(rgb: Sequence[int]) -> str:
    return "#" + "".join(f"{each:02x}" for each in rgb)
