"""Draws the whole recording of a timeline as a still picture; timeline.js draws it in the browser."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from course_pkg.panels.paper import (
    EDGES,
    ERROR,
    FAINT,
    GROUND,
    LINE,
    MUTED,
    RAISED,
    SIZE,
    TEXT,
    Paper,
    State,
    Style,
)
from course_pkg.panels.timeline.bands import Band, bands_of
from course_pkg.panels.timeline.scene import BLOCKED, Event, Scene
from course_pkg.panels.timeline.waits import sentences

# The colours of timeline.css in the light theme.
HANDLER, HANDLER_EDGE = "#f7dfb4", "#a5660a"
WAIT, WAIT_EDGE = "#fbe6e4", "#b0342c"
CALLBACK, CALLBACK_EDGE = "#cfe0f7", "#3a6fb5"
WORD, NAME = Style(11.0), Style(12.0, bold=True)
NAMES = {"lookup": "look-up", "connect": "connect", "request": "request", "publish": "publish"}
MARK = 14.0  # An event that is narrower than this (px) can be a small symbol instead of a bar.
# This is the minimum distance in px between two arrows of messages (True) or of calls (False). Arrows that
# are closer to each other are not drawn.
APART = {True: 8.0, False: 3.0}
TICKS = 8  # maximum number of marks on the time axis
HEAD = 7.0  # length of an arrowhead in px
LEGEND = (
    ("bar", WAIT, WAIT_EDGE, "waits"),
    ("bar", HANDLER, HANDLER_EDGE, "handler"),
    ("bar", CALLBACK, CALLBACK_EDGE, "callback"),
    ("line", "", HANDLER_EDGE, "request"),
    ("dashes", "", HANDLER_EDGE, "response"),
    ("line", "", CALLBACK_EDGE, "message"),
)


def still(state: State) -> str:
    """Draw the whole recording; below it, write which node waited for which node."""
    recorded = state["recorded"]
    said = sentences(recorded["waits"])
    paper = Paper(f"A timeline of {', '.join(lane['node'] for lane in recorded['lanes']) or 'no node'}")
    if recorded["lanes"]:
        _Diagram(paper, Scene(recorded, paper.inside)).draw()
        _draw_legend(paper)
    for each in (*said, *recorded["notes"], *(f"{node}: {why}" for node, why in recorded["unrecorded"])):
        paper.write(each, FAINT)
    return paper.svg(" ".join(said))


@dataclass
class _Diagram:
    paper: Paper
    scene: Scene

    def draw(self) -> None:
        """Draw the axis, the arrows, the events and the names of the nodes."""
        top = self._draw_axis()
        self.paper.y = top
        crowded = bands_of(self.scene)
        left_out = {number for band in crowded for number in band.events}
        self._draw_arrows(top)
        for band in crowded:
            self._draw_band(band, top)
        for event in self.scene.events:
            if event.number not in left_out:
                self._draw_event(event, top)
        for lane, y in zip(self.scene.lanes, self.scene.tops, strict=True):
            self.paper.box(EDGES, top + y, NAME.width(lane) + 8, 18, fill=GROUND)
            self.paper.put(lane, EDGES + 4, top + y + 9, NAME)
        self.paper.y = top + self.scene.height + 6

    def _draw_axis(self) -> float:
        paper, scene = self.paper, self.scene
        unit, name = (1e6, "s") if scene.length > 4e6 else (1e3, "ms")
        top = paper.y + 24
        ends = [EDGES + scene.x(time) for time in (0, scene.length)]
        for left, right in ((EDGES, ends[0]), (ends[1], paper.width - EDGES)):
            paper.box(left, top, right - left, scene.height, fill=RAISED, rx=0)
        for value, text in ticks(scene.length / unit):
            x = EDGES + scene.x(value * unit)
            paper.add("path", d=f"M{x:.1f} {top - 5:.1f}v{scene.height + 5:.1f}", stroke=LINE)
            word = f"{text} {name}"
            half = WORD.width(word) / 2
            at = min(max(x, EDGES + half), paper.width - EDGES - half)
            paper.put(word, at, paper.y + 8, Style(11.0, colour=MUTED), anchor="middle")
        for y in scene.tops[1:]:
            paper.add("path", d=f"M{EDGES:.1f} {top + y - 6:.1f}h{paper.inside:.1f}", stroke=LINE)
        return top

    def _draw_arrows(self, top: float) -> None:
        last: dict[tuple[int, int, str], float] = {}
        for source, target in self.scene.arrows:
            message, answer = source.kind == "publish", source.kind == "handler"
            x1, x2 = source.right if answer else source.left, target.left
            pair = (source.lane, target.lane, source.kind)
            if abs(x2 - last.get(pair, -math.inf)) < APART[message]:
                continue
            last[pair] = x2
            down = source.top < target.top
            y1 = top + source.top + (source.height if down else 0)
            y2 = top + target.top + (0 if down else target.height)
            self._draw_arrow((EDGES + x1, y1), (EDGES + x2, y2), message=message, dashed=answer)

    def _draw_arrow(
        self, start: tuple[float, float], tip: tuple[float, float], *, message: bool, dashed: bool
    ) -> None:
        colour = CALLBACK_EDGE if message else HANDLER_EDGE
        path = f"M{start[0]:.1f} {start[1]:.1f}L{tip[0]:.1f} {tip[1]:.1f}"
        line = self.paper.add("path", d=path, stroke=colour, stroke_width=1 if message else 1.5)
        if dashed:
            line.set("stroke-dasharray", "5 3")
        angle = math.atan2(tip[1] - start[1], tip[0] - start[0])
        sides = [
            (tip[0] + HEAD * math.cos(angle + turn), tip[1] + HEAD * math.sin(angle + turn))
            for turn in (2.72, -2.72)
        ]
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in (tip, *sides))
        self.paper.add("polygon", points=points, fill=colour)

    def _draw_band(self, band: Band, top: float) -> None:
        """Draw several close events as one bar with the number of events."""
        fill, edge = _colours("wait" if band.what == "calls" else band.kind)
        x, y, wide = EDGES + band.left, top + band.top + band.height / 4, band.right - band.left
        bar = self.paper.box(x, y, wide, band.height / 2, fill=fill, edge=edge, rx=0)
        bar.set("stroke-dasharray", "2 2")
        word, middle = f"{band.count} {band.what}", top + band.top + band.height / 2
        room = WORD.width(word) + 8
        if room <= wide and band.height >= 11:
            self.paper.box(x + wide / 2 - room / 2, middle - 7, room, 14, fill=GROUND, rx=0)
            self.paper.put(word, x + wide / 2, middle, WORD, anchor="middle")

    def _draw_event(self, event: Event, top: float) -> None:
        x, y = EDGES + event.left, top + event.top
        wide, middle = event.right - event.left, y + event.height / 2
        edge = _colours(event.kind)[1]
        if event.kind == "error":
            path = f"M{x - 4:.1f} {middle - 4:.1f}l8 8m0 -8l-8 8"
            self.paper.add("path", d=path, stroke=ERROR, stroke_width=2.5)
        elif event.kind in ("handler", "callback", "wait") or (wide >= MARK and event.kind != "response"):
            self._draw_bar(event, x, y, max(wide, 2))
        elif event.kind == "lookup":
            path = f"M{x + wide / 2:.1f} {y:.1f}l4 4l-4 4l-4 -4z"
            self.paper.add("path", d=path, fill=GROUND, stroke=edge, stroke_width=1.5)
        elif event.kind == "connect":
            low = y + event.height - 4
            self.paper.add("circle", cx=x + wide / 2, cy=low, r=3, fill=GROUND, stroke=edge)
        else:
            self.paper.box(x - 1, y, 2, event.height, fill=edge, rx=0)
            if event.kind == "publish":
                self.paper.add("circle", cx=x, cy=y + 2.5, r=2.5, fill=edge)

    def _draw_bar(self, event: Event, x: float, y: float, wide: float) -> None:
        fill, edge = _colours(event.kind)
        bar = self.paper.box(x, y, wide, event.height, fill=edge if wide <= 3 else fill, rx=0)
        if wide > 3:
            bar.set("stroke", edge)
        if event.open:
            bar.set("stroke-dasharray", "4 3")  # The event was not finished when the recording ended.
        for word in _words(event):
            if event.height >= 11 and WORD.width(word) <= wide - 10:
                self.paper.put(word, x + 5, y + event.height / 2, WORD)
                return


def _words(event: Event) -> Iterator[str]:
    """Yield the possible texts of a bar, the longest text first."""
    if event.kind == "wait":
        waits = "still waits" if event.open else "waits"
        yield from ((f"{waits} for {event.peer}", waits) if event.peer else (waits,))
    else:
        yield NAMES.get(event.kind, event.name)


def _colours(kind: str) -> tuple[str, str]:
    if kind in BLOCKED:
        return WAIT, WAIT_EDGE
    return (CALLBACK, CALLBACK_EDGE) if kind in ("callback", "publish") else (HANDLER, HANDLER_EDGE)


def _draw_legend(paper: Paper) -> None:
    at, middle = EDGES, paper.y + SIZE / 2
    for shape, fill, edge, text in LEGEND:
        if shape == "bar":
            paper.box(at, middle - 6, 26, 12, fill=fill, edge=edge, rx=0)
        else:
            line = paper.add("path", d=f"M{at:.1f} {middle:.1f}h26", stroke=edge, stroke_width=2)
            if shape == "dashes":
                line.set("stroke-dasharray", "5 3")
        paper.put(text, at + 34, middle, Style(12.0, colour=TEXT))
        at += 34 + FAINT.width(text) + 22
    paper.y += 24


def ticks(length: float, most: int = TICKS) -> Sequence[tuple[float, str]]:
    """Return the positions and the texts of the marks on an axis that begins at 0 and ends at `length`."""
    if length <= 0:
        return [(0.0, "0")]
    ten = 10.0 ** math.floor(math.log10(length / most))
    step = next(factor * ten for factor in (1, 2, 5, 10) if length / (factor * ten) <= most)
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    count = math.floor(length / step + 1e-9)
    return [(each * step, f"{each * step:.{decimals}f}" if each else "0") for each in range(count + 1)]
