"""A layout as SVG: a pure function, with colours left to the page's style sheet."""

from __future__ import annotations

import math
from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement, tostring

from course_pkg.panels.graph.layout import Layout, Placed, Point, Routed
from course_pkg.panels.graph.picture import Kind

MARGIN = 12.0
ARROW = 9.0  # px, length of an arrowhead
CORNER = 12.0  # px, by which a service's ends are pointed


def svg(layout: Layout, *, title: str = "The ROS graph", description: str = "") -> str:
    """Return the drawing. Each shape is a button and says in words what it is; `data-key` names it."""
    width, height = layout.width + 2 * MARGIN, layout.height + 2 * MARGIN
    root = Element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "class": "ros-graph-drawing",
            "viewBox": f"0 0 {_number(width)} {_number(height)}",
            "width": _number(width),
            "height": _number(height),
            "role": "group",
            "aria-label": title,
        },
    )
    SubElement(root, "title").text = title
    SubElement(root, "desc").text = description
    canvas = SubElement(root, "g", {"transform": f"translate({_number(MARGIN)} {_number(MARGIN)})"})
    for line in layout.lines:
        _draw_line(canvas, line)
    for placed in layout.shapes:
        _draw_shape(canvas, placed)
    return tostring(root, encoding="unicode")


def _draw_line(canvas: Element, routed: Routed) -> None:
    start, *rest = routed.points
    kind = "ros-call" if routed.line.both else "ros-stream"
    attributes = {"class": f"ros-edge {kind}", "data-tail": routed.line.tail, "data-head": routed.line.head}
    group = SubElement(canvas, "g", {**attributes, "aria-hidden": "true"})
    SubElement(group, "path", {"d": f"M{_point(start)} C{' '.join(_point(each) for each in rest)}"})
    SubElement(group, "polygon", {"points": _arrow(routed.points[-2], routed.points[-1])})
    if routed.line.both:
        SubElement(group, "polygon", {"points": _arrow(routed.points[1], routed.points[0])})


def _draw_shape(canvas: Element, placed: Placed) -> None:
    shape = placed.shape
    classes = f"ros-shape ros-{shape.kind.value}" + ("" if shape.reachable else " ros-lost")
    said = f"{shape.kind.value} {shape.name}" + ("" if shape.reachable else ", does not answer")
    attributes = {
        "class": classes,
        "data-key": shape.key,
        "role": "button",
        "tabindex": "0",
        "aria-label": said,
    }
    group = SubElement(canvas, "g", attributes)
    SubElement(group, "title").text = said
    (x, y), wide, high = placed.centre, placed.width / 2, placed.height / 2
    if shape.kind is Kind.NODE:
        SubElement(group, "ellipse", _numbers(cx=x, cy=y, rx=wide, ry=high))
    elif shape.kind is Kind.TOPIC:
        SubElement(group, "rect", _numbers(x=x - wide, y=y - high, width=2 * wide, height=2 * high, rx=3))
    else:
        SubElement(group, "polygon", {"points": _hexagon(x, y, wide, high)})
    SubElement(group, "text", _numbers(x=x, y=y)).text = placed.label


def _hexagon(x: float, y: float, wide: float, high: float) -> str:
    inner = wide - CORNER
    corners = ((-wide, 0), (-inner, -high), (inner, -high), (wide, 0), (inner, high), (-inner, high))
    return " ".join(_point((x + dx, y + dy)) for dx, dy in corners)


def _arrow(before: Point, tip: Point) -> str:
    """Return the corners of an arrowhead that comes from `before` and ends at `tip`."""
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
