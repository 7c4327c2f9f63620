"""Where the shapes go and how the lines run, as graphviz lays them out."""

from __future__ import annotations

import shutil
import subprocess
from dataclasses import dataclass

from course_pkg.errors import DrawingFailed
from course_pkg.panels.graph.picture import Kind, Line, Picture, Shape

CHARACTER = 7.3  # px; names are set in a fixed-width face of 12 px
HEIGHT = 34.0
ELBOW = {Kind.NODE: 40.0, Kind.TOPIC: 24.0, Kind.SERVICE: 44.0}  # px beside the name, by the shape around it
LONGEST = 36
PER_INCH = 72.0

Point = tuple[float, float]


@dataclass(frozen=True)
class Placed:
    """A shape with its centre and size (px)."""

    shape: Shape
    label: str
    centre: Point
    width: float
    height: float


@dataclass(frozen=True)
class Routed:
    """A line as the points of a chain of cubic curves (px): start, then three points for each curve."""

    line: Line
    points: tuple[Point, ...]


@dataclass(frozen=True)
class Layout:
    """A picture with coordinates (px), the origin at the top left."""

    width: float = 0.0
    height: float = 0.0
    shapes: tuple[Placed, ...] = ()
    lines: tuple[Routed, ...] = ()


def laid_out(picture: Picture, *, timeout: float = 5.0) -> Layout:
    """Ask graphviz; raises DrawingFailed when it is missing, fails, or takes longer than `timeout` s."""
    if not picture.shapes:
        return Layout()
    dot = shutil.which("dot")
    if not dot:
        raise DrawingFailed(
            "graphviz is not installed, so the graph is shown as a list. Install it: apt install graphviz"
        )
    try:
        done = subprocess.run(
            [dot, "-Tplain"],
            input=_script(picture),
            capture_output=True,
            text=True,
            timeout=timeout,
            check=True,
        )
    except subprocess.TimeoutExpired as error:
        raise DrawingFailed(f"graphviz took over {timeout:g} s, so the graph is shown as a list.") from error
    except (OSError, subprocess.CalledProcessError) as error:
        detail = getattr(error, "stderr", None) or error
        raise DrawingFailed(f"graphviz failed ({detail}), so the graph is shown as a list.") from error
    return parsed(done.stdout, picture)


def parsed(plain: str, picture: Picture) -> Layout:
    """Return the layout from graphviz' `plain` format: inches from the bottom left."""
    shapes: list[Placed] = []
    lines: list[Routed] = []
    width = height = 0.0
    for row in (text.split() for text in plain.splitlines()):
        if row[0] == "graph":
            width, height = (float(each) * PER_INCH for each in row[2:4])
        elif row[0] == "node":
            shape = picture.shapes[int(row[1])]
            x, y, wide, high = (float(each) * PER_INCH for each in row[2:6])
            shapes.append(Placed(shape, _label(shape.name), (x, height - y), wide, high))
        elif row[0] == "edge":
            ends = (picture.shapes[int(row[1])].key, picture.shapes[int(row[2])].key)
            numbers = [float(each) * PER_INCH for each in row[4 : 4 + 2 * int(row[3])]]
            points = tuple((x, height - y) for x, y in zip(numbers[::2], numbers[1::2], strict=True))
            lines.append(
                Routed(next(each for each in picture.lines if (each.tail, each.head) == ends), points)
            )
    return Layout(width, height, tuple(shapes), tuple(lines))


def _script(picture: Picture) -> str:
    numbers = {shape.key: number for number, shape in enumerate(picture.shapes)}
    rows = [
        "digraph {",
        'rankdir=LR; nodesep=0.22; ranksep=0.55; node [fixedsize=true, label=""]; edge [dir=none]',
    ]
    for shape in picture.shapes:
        kind = "ellipse" if shape.kind is Kind.NODE else "box"
        width = len(_label(shape.name)) * CHARACTER + ELBOW[shape.kind]
        size = f"width={width / PER_INCH:.3f}, height={HEIGHT / PER_INCH:.3f}"
        rows.append(f"{numbers[shape.key]} [shape={kind}, {size}]")
    rows += [f"{numbers[line.tail]} -> {numbers[line.head]}" for line in picture.lines]
    return "\n".join([*rows, "}"])


def _label(name: str) -> str:
    """Return the name, or its two ends where it is too long for a shape."""
    half = LONGEST // 2
    return name if len(name) <= LONGEST else f"{name[: half - 1]}…{name[-half:]}"
