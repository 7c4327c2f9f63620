"""Draws a layout of the graph (see layout.py) as SVG."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, tostring

from course_pkg.panels.assets import sheet
from course_pkg.panels.graph.layout import Framed, Layout, Placed, Point, Routed
from course_pkg.panels.graph.picture import Kind

MARGIN = 12.0
ARROW = 9.0  # An arrowhead is this many px long.
CORNER = 12.0  # Each of the two pointed ends of a service's shape is this many px wide.
CARD = 4.0  # A folded namespace is drawn as two rectangles with this offset (px).
# ABOVE is the distance (px) from the middle of a shape to its name. BELOW is the distance to the note below
# the name.
ABOVE, BELOW = -7.0, 10.0
TITLE = 13.0  # The middle of a frame's name is this many px below the top of the frame.


def svg(
    layout: Layout,
    *,
    title: str = "The ROS graph",
    description: str = "",
    notes: Mapping[str, str] | None = None,
    still: bool = False,
) -> str:
    """Return the drawing as SVG; `notes` contains the text below the name of each topic.

    In a page, each shape is a button with an accessible name; the attribute `data-key` of the button is the
    key of the shape. If `still` is True, the result is a complete file with a style sheet and a text
    alternative.
    """
    return _Drawing(notes or {}, still).of(layout, title, description)


class _Drawing:
    def __init__(self, notes: Mapping[str, str], still: bool) -> None:
        self._notes = notes
        self._still = still

    def of(self, layout: Layout, title: str, description: str) -> str:
        width, height = (_number(side + 2 * MARGIN) for side in (layout.width, layout.height))
        root = Element(
            "svg",
            {
                "xmlns": "http://www.w3.org/2000/svg",
                "class": "ros-graph-drawing ros-still" if self._still else "ros-graph-drawing",
                "viewBox": f"0 0 {width} {height}",
                "width": width,
                "height": height,
                "role": "img" if self._still else "group",
                "aria-label": title,
            },
        )
        SubElement(root, "title").text = title
        SubElement(root, "desc").text = description
        if self._still:
            SubElement(root, "style").text = _style()
        canvas = SubElement(root, "g", {"transform": f"translate({_number(MARGIN)} {_number(MARGIN)})"})
        for frame in layout.frames:
            self._frame(canvas, frame)
        for line in layout.lines:
            _line(canvas, line)
        SubElement(canvas, "g", {"class": "ros-calls", "aria-hidden": "true"})
        for placed in layout.shapes:
            self._shape(canvas, placed)
        return tostring(root, encoding="unicode")

    def _frame(self, canvas: Element, framed: Framed) -> None:
        (x, y), name = framed.corner, framed.frame.name
        size = {"width": framed.width, "height": framed.height}
        SubElement(canvas, "rect", {"class": "ros-frame", **_numbers(x=x, y=y, rx=6, **size)})
        said = f"{_named('namespace', framed.label, name)}, unfolded"
        group = self._button(canvas, "ros-title", framed.frame.key, said, expanded=True)
        label = f"▾ {framed.label}"
        SubElement(group, "rect", _numbers(x=x + 4, y=y + 3, width=7.3 * len(label) + 8, height=20, rx=3))
        SubElement(group, "text", _numbers(x=x + 8, y=y + TITLE)).text = label

    def _shape(self, canvas: Element, placed: Placed) -> None:
        shape = placed.shape
        classes = f"ros-shape ros-{shape.kind.value}" + ("" if shape.reachable else " ros-lost")
        said = _named(shape.kind.value, placed.label, shape.name)
        said += f" {placed.note}, folded" if shape.kind is Kind.SPACE else ""
        said += "" if shape.reachable else ", does not answer"
        folded = False if shape.kind is Kind.SPACE else None
        group = self._button(canvas, classes, shape.key, said, expanded=folded)
        _outline(group, placed)
        (x, y), low = placed.centre, shape.kind in (Kind.TOPIC, Kind.SPACE)
        mark = "▸ " if shape.kind is Kind.SPACE else ""
        name = SubElement(group, "text", _numbers(x=x, y=y + (ABOVE if low else 0)))
        name.text = mark + placed.label
        # Without a space after the name, a screen reader joins the name's last word and the note's first
        # word.
        name.tail = " "
        if low:
            under = SubElement(group, "text", {"class": "ros-note", **_numbers(x=x, y=y + BELOW)})
            under.text = placed.note or self._notes.get(shape.key, "")

    def _button(
        self, canvas: Element, classes: str, key: str, said: str, *, expanded: bool | None
    ) -> Element:
        attributes = {"class": classes, "data-key": key}
        if not self._still:
            attributes |= {"role": "button", "tabindex": "0", "aria-label": said}
            attributes |= {} if expanded is None else {"aria-expanded": str(expanded).lower()}
        group = SubElement(canvas, "g", attributes)
        SubElement(group, "title").text = said
        return group


def _named(kind: str, label: str, name: str) -> str:
    """Return the accessible name of a button.

    The accessible name contains the visible label, because a user of speech input says this label.
    """
    return f"{kind} {name}" if label == name else f"{kind} {name}: {label}"


def _outline(group: Element, placed: Placed) -> None:
    (x, y), wide, high = placed.centre, placed.width / 2, placed.height / 2
    box = {"x": x - wide, "y": y - high, "width": 2 * wide, "height": 2 * high, "rx": 3.0}
    if placed.shape.kind is Kind.NODE:
        SubElement(group, "ellipse", _numbers(cx=x, cy=y, rx=wide, ry=high))
    elif placed.shape.kind is Kind.SERVICE:
        SubElement(group, "polygon", {"points": _hexagon(x, y, wide, high)})
    elif placed.shape.kind is Kind.TOPIC:
        SubElement(group, "rect", _numbers(**box))
    else:
        smaller = {"width": box["width"] - CARD, "height": box["height"] - CARD}
        SubElement(group, "rect", _numbers(**{**box, **smaller, "x": box["x"] + CARD}))
        SubElement(group, "rect", _numbers(**{**box, **smaller, "y": box["y"] + CARD}))


def _line(canvas: Element, routed: Routed) -> None:
    start, *rest = routed.points
    kind = "ros-call" if routed.line.both else "ros-stream"
    attributes = {"class": f"ros-edge {kind}", "data-tail": routed.line.tail, "data-head": routed.line.head}
    group = SubElement(canvas, "g", {**attributes, "aria-hidden": "true"})
    SubElement(group, "path", {"d": f"M{_point(start)} C{' '.join(_point(each) for each in rest)}"})
    SubElement(group, "polygon", {"points": _arrow(routed.points[-2], routed.points[-1])})
    if routed.line.both:
        SubElement(group, "polygon", {"points": _arrow(routed.points[1], routed.points[0])})


def _style() -> str:
    return sheet(Path(__file__).with_name("drawing.css"))


def _hexagon(x: float, y: float, wide: float, high: float) -> str:
    inner = wide - CORNER
    corners = ((-wide, 0), (-inner, -high), (inner, -high), (wide, 0), (inner, high), (-inner, high))
    return " ".join(_point((x + dx, y + dy)) for dx, dy in corners)


def _arrow(before: Point, tip: Point) -> str:
    """Return the corners of an arrowhead at `tip`; `before` is the previous point of the line."""
    angle = math.atan2(tip[1] - before[1], tip[0] - before[0])
    sides = [angle + math.pi - 0.42, angle + math.pi + 0.42]
    corners: Sequence[Point] = [
        tip,
        *((tip[0] + ARROW * math.cos(s), tip[1] + ARROW * math.sin(s)) for s in sides),
    ]
    return " ".join(_point(corner) for corner in corners)


def _point(point: Point) -> str:
    return f"{_number(point[0])},{_number(point[1])}"


def _numbers(**values: float) -> dict[str, str]:
    return {name: _number(value) for name, value in values.items()}


def _number(value: float) -> str:
    return f"{value:.1f}".removesuffix(".0")
