"""Computes the positions of the shapes and the routes of the lines with graphviz."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypedDict

from course_pkg.errors import DrawingFailed
from course_pkg.panels.graph.picture import Frame, Kind, Line, Picture, Shape

CHARACTER = 7.3  # A letter of the fixed-width font (12 px) is this many px wide.
# The height (px) of each kind of shape; a topic and a namespace have two lines of text.
HEIGHT = {Kind.NODE: 34.0, Kind.TOPIC: 42.0, Kind.SERVICE: 34.0, Kind.SPACE: 46.0}
# ELBOW is the number of px by which each kind of shape is wider than its name.
ELBOW = {Kind.NODE: 32.0, Kind.TOPIC: 18.0, Kind.SERVICE: 34.0, Kind.SPACE: 34.0}
NOTE = 11 / 12  # The font size of the second line, divided by the font size of the name.
ROOM = 12  # A topic's shape has space for at least this many letters below the name.
LONGEST = 36
PER_INCH = 72.0
WIDE, TALL = 1000.0, 1400.0  # A page has this width and this height (px).

Point = tuple[float, float]


class _Object(TypedDict, total=False):
    """A shape, a line (with `pos`) or a frame (with `bb`) in the JSON output of graphviz."""

    name: str
    id: str
    pos: str
    bb: str


class _Drawn(TypedDict, total=False):
    bb: str
    objects: list[_Object]
    edges: list[_Object]


@dataclass(frozen=True)
class Placed:
    """A shape with its centre and size (px), its shortened name, and an optional second line of text."""

    shape: Shape
    label: str
    centre: Point
    width: float
    height: float
    note: str = ""


@dataclass(frozen=True)
class Routed:
    """A line as a chain of cubic Bézier curves (px): the start point, then three points for each curve."""

    line: Line
    points: tuple[Point, ...]


@dataclass(frozen=True)
class Framed:
    """A frame with its top left corner and size (px)."""

    frame: Frame
    label: str
    corner: Point
    width: float
    height: float


@dataclass(frozen=True)
class Layout:
    """A picture with coordinates (px); the origin is at the top left."""

    width: float = 0.0
    height: float = 0.0
    shapes: tuple[Placed, ...] = ()
    lines: tuple[Routed, ...] = ()
    frames: tuple[Framed, ...] = ()


def laid_out(picture: Picture, *, timeout: float = 5.0) -> Layout:
    """Return the layout that graphviz computes for a picture.

    The arrows point from left to right. If this layout is too wide for a page, the function also computes a
    layout from top to bottom. The second layout is returned only if its letters on the page are more than 1.1
    times as large as in the first layout. Raises DrawingFailed if graphviz is missing, fails, or takes longer
    than `timeout` s.
    """
    if not picture.shapes:
        return Layout()
    lying = _drawn(picture, "LR", timeout)
    if lying.width <= WIDE:
        return lying
    standing = _drawn(picture, "TB", timeout)
    return standing if _scale(standing) > 1.1 * _scale(lying) else lying


def _scale(layout: Layout) -> float:
    """Return the factor that scales a layout down to the size of a page."""
    return min(1.0, WIDE / layout.width, TALL / layout.height)


def _drawn(picture: Picture, direction: str, timeout: float) -> Layout:
    dot = shutil.which("dot")
    if not dot:
        raise DrawingFailed(
            "graphviz is not installed, so the graph is shown as a list. To install graphviz, "
            "type: apt install graphviz"
        )
    try:
        done = subprocess.run(
            [dot, "-Tjson0"],
            input=_script(picture, direction),
            capture_output=True,
            text=True,
            timeout=timeout,
            check=True,
        )
        return _parsed(json.loads(done.stdout), picture)
    except subprocess.TimeoutExpired as error:
        raise DrawingFailed(
            f"graphviz took longer than {timeout:g} s, so the graph is shown as a list."
        ) from error
    except (OSError, subprocess.CalledProcessError, ValueError, LookupError) as error:
        detail = getattr(error, "stderr", None) or error
        raise DrawingFailed(f"graphviz failed ({detail}), so the graph is shown as a list.") from error


def _parsed(drawn: _Drawn, picture: Picture) -> Layout:
    """Return the layout from the JSON output of graphviz.

    Graphviz measures in points (1/72 inch) from the bottom left corner. One point becomes one px.
    """
    _, _, width, height = _numbers(drawn["bb"])
    shapes: list[Placed] = []
    frames: list[Framed] = []
    for each in drawn.get("objects", ()):
        if "pos" in each:
            shape = picture.shapes[int(each["name"])]
            (x, y), (wide, high) = _numbers(each["pos"]), _size(shape)
            shapes.append(Placed(shape, _label(shape.name), (x, height - y), wide, high, _note(shape)))
        elif "bb" in each:
            frame = picture.frames[int(each["name"].removeprefix("cluster_"))]
            left, bottom, right, top = _numbers(each["bb"])
            corner = (left, height - top)
            frames.append(Framed(frame, _label(frame.name), corner, right - left, top - bottom))
    lines = [
        Routed(picture.lines[int(each["id"])], _points(each["pos"], height))
        for each in drawn.get("edges", ())
    ]
    return Layout(width, height, tuple(shapes), tuple(lines), tuple(frames))


def _points(text: str, height: float) -> tuple[Point, ...]:
    pairs = (_numbers(each) for each in text.split())
    return tuple((x, height - y) for x, y in pairs)


def _numbers(text: str) -> list[float]:
    return [float(each) for each in text.split(",")]


def _script(picture: Picture, direction: str) -> str:
    numbers = {shape.key: number for number, shape in enumerate(picture.shapes)}
    apart = "nodesep=0.22; ranksep=0.5" if direction == "LR" else "nodesep=0.16; ranksep=0.35"
    rows = [
        "digraph {",
        f'rankdir={direction}; {apart}; node [fixedsize=true, label=""]; edge [dir=none]',
        "fontname=monospace; fontsize=12; labeljust=l",
    ]
    for shape in picture.shapes:
        kind = "ellipse" if shape.kind is Kind.NODE else "box"
        width, height = (each / PER_INCH for each in _size(shape))
        rows.append(f"{numbers[shape.key]} [shape={kind}, width={width:.3f}, height={height:.3f}]")
    rows += [*_clusters(picture.frames, numbers)]
    rows += [
        f"{numbers[line.tail]} -> {numbers[line.head]} [id={number}]"
        for number, line in enumerate(picture.lines)
    ]
    return "\n".join([*rows, "}"])


def _clusters(frames: Sequence[Frame], numbers: Mapping[str, int]) -> Iterator[str]:
    """Yield the frames as nested clusters in the language of graphviz.

    The frames are sorted by name, so an outer frame comes before its inner frames.
    """
    around: list[str] = []
    for number, frame in enumerate(frames):
        while around and not frame.name.startswith(around[-1]):
            yield "}" * bool(around.pop())
        around.append(frame.name)
        label = "x" * len(_label(frame.name))
        members = " ".join(str(numbers[key]) for key in sorted(frame.members))
        yield f'subgraph cluster_{number} {{ label="{label}"; {members}'
    yield "}" * len(around)


def _size(shape: Shape) -> tuple[float, float]:
    """Return the width and height (px) of a shape; the size depends on the texts in it."""
    note = ROOM if shape.kind is Kind.TOPIC else len(_note(shape))
    letters = max(len(_label(shape.name)), note * NOTE)
    return letters * CHARACTER + ELBOW[shape.kind], HEIGHT[shape.kind]


def _note(shape: Shape) -> str:
    """Return the second line of text in a shape.

    For a folded namespace, this line states the number of its nodes, topics and services. For any other
    shape, the line is empty.
    """
    return dict(shape.facts).get("holds", "") if shape.kind is Kind.SPACE else ""


def _label(name: str) -> str:
    """Return the name; shorten a long name to its beginning and its end, with "…" between them."""
    half = LONGEST // 2
    return name if len(name) <= LONGEST else f"{name[: half - 1]}…{name[-half:]}"
