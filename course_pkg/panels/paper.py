"""Paper for the still picture of a panel: rows from top to bottom, as an SVG that needs no script.

A viewer of notebooks puts the picture into its page, so the picture has no ids and no style sheet, which
another picture of the page could meet. Its colours are those of look.css in the light theme.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias
from xml.etree.ElementTree import Element, SubElement, tostring

# The traits of a panel, by name: JSON, as a page gets them.
State: TypeAlias = Mapping[str, Any]

GROUND, RAISED, WASH = "#ffffff", "#f4f6f8", "#e8f0fb"
TEXT, MUTED, LINE, EDGE, ACCENT = "#1c2127", "#545d68", "#d5dae0", "#838c96", "#1259b5"
GOOD, ERROR, ERROR_WASH = "#18713a", "#ae1f1f", "#fdefee"
SANS = "Arial, Helvetica, 'Liberation Sans', sans-serif"
MONO = "Menlo, Consolas, 'DejaVu Sans Mono', monospace"

WIDTH = 760.0  # px
EDGES = 16.0  # px from the border of the picture to what is in it
SIZE, SMALL = 13.0, 12.0  # px of a letter
LEADING = 1.5  # the height of a line, to the size of its letters
MONO_LETTER = 0.61  # the width of a letter, to its size
# The widths of letters, to their size, in DejaVu Sans, which is the widest of the fonts that may be taken.
WIDTHS = {
    **dict.fromkeys("iljI'|.,:; ", 0.32),
    **dict.fromkeys('frt()[]/`-!"', 0.41),
    **dict.fromkeys("mMW@%—…→", 0.98),
    "w": 0.82,
}
CAPITAL, LETTER, BOLD = 0.7, 0.62, 1.12
NOT_IN_XML = re.compile(r"[^\t\n\r\x20-\uD7FF\uE000-\uFFFD\U00010000-\U0010FFFF]")
MARKED = re.compile(r"`([^`]*)`|\*([^*]+)\*")


@dataclass(frozen=True)
class Style:
    """How a text looks."""

    size: float = SIZE
    bold: bool = False
    mono: bool = False
    colour: str = TEXT

    def width(self, text: str) -> float:
        """Return about how wide a text is (px), in the widest of the fonts that a viewer may take."""
        if self.mono:
            return len(text) * MONO_LETTER * self.size
        letters = sum(WIDTHS.get(each, CAPITAL if each.isupper() else LETTER) for each in text)
        return letters * self.size * (BOLD if self.bold else 1.0)

    @property
    def height(self) -> float:
        """The height of a line (px)."""
        return self.size * LEADING


PLAIN, HEADING, FAINT = Style(), Style(bold=True), Style(SMALL, colour=MUTED)
CODE, FAINT_CODE = Style(SMALL, mono=True), Style(SMALL, mono=True, colour=MUTED)


@dataclass(frozen=True)
class Column:
    """A column of a table: where it begins, how wide its texts may become (px), and how they look."""

    left: float
    width: float
    style: Style = PLAIN


class Paper:
    """A picture that grows downwards; `y` is where the next row begins (px)."""

    def __init__(self, title: str, width: float = WIDTH) -> None:
        self.title = title
        self.width = width
        self.y = 12.0
        self._parts: list[Element] = []

    @property
    def inside(self) -> float:
        """The width between the edges (px)."""
        return self.width - 2 * EDGES

    def write(
        self, text: str, style: Style = PLAIN, *, left: float = EDGES, width: float | None = None
    ) -> None:
        """Write a paragraph, in as many lines as it needs, and go below it."""
        lines = wrapped(text, style, (self.width - EDGES - left) if width is None else width)
        for line in lines:
            self.put(line, left, self.y + style.height / 2, style)
            self.y += style.height

    def put(self, text: str, x: float, middle: float, style: Style = PLAIN, *, anchor: str = "start") -> None:
        """Write one line whose letters have their middle at the height `middle`; `y` stays."""
        attributes = {
            "x": number(x),
            "y": number(middle + 0.35 * style.size),
            "font-family": MONO if style.mono else SANS,
            "font-size": number(style.size),
            "fill": style.colour,
        }
        if style.bold:
            attributes["font-weight"] = "bold"
        if anchor != "start":
            attributes["text-anchor"] = anchor
        self.add("text", **attributes).text = clean(text)

    def label(self, label: str, text: str, *, left: float = 112.0, mono: bool = True) -> None:
        """Write a label, and beside it a text."""
        self.put(label, EDGES, self.y + CODE.height / 2, FAINT)
        self.write(text, CODE if mono else PLAIN, left=EDGES + left)

    def row(self, columns: Sequence[Column], texts: Sequence[str], *, room: float = 4.0) -> None:
        """Write texts side by side, each below the head of its column, and go below the highest."""
        top = low = self.y
        for column, text in zip(columns, texts, strict=True):
            self.y = top
            self.write(text, column.style, left=column.left, width=column.width)
            low = max(low, self.y)
        self.y = low + room

    def input(self, text: str, *, left: float, width: float) -> None:
        """Draw a field to type into, with what is in it; `y` stays."""
        self.box(left, self.y, width, 26, fill=GROUND, edge=EDGE)
        self.put(cut(text, CODE, width - 14), left + 8, self.y + 13, CODE)

    def button(self, text: str, left: float, *, main: bool = False) -> float:
        """Draw a button, and return where the next one can begin; `y` stays."""
        style = Style(colour=GROUND if main else TEXT)
        width = style.width(text) + 24
        self.box(left, self.y, width, 28, fill=ACCENT if main else RAISED, edge=ACCENT if main else EDGE)
        self.put(text, left + width / 2, self.y + 14, style, anchor="middle")
        return left + width + 8

    def radio(self, text: str, left: float, *, chosen: bool = False) -> float:
        """Draw one of several options, and return where the next one can begin; `y` stays."""
        self.add(
            "circle", cx=left + 7, cy=self.y + 10, r=6, fill=GROUND, stroke=ACCENT if chosen else EDGE
        ).set("stroke-width", "1.5")
        if chosen:
            self.add("circle", cx=left + 7, cy=self.y + 10, r=3, fill=ACCENT)
        self.put(text, left + 20, self.y + 10)
        return left + 20 + PLAIN.width(text) + 20

    def options(self, texts: Iterable[str], chosen: str = "", *, left: float = EDGES) -> None:
        """Draw all options of a question, side by side as far as there is room, and go below them."""
        at = left
        for text in texts:
            if at > left and at + 20 + PLAIN.width(text) > self.width - EDGES:
                at, self.y = left, self.y + 24
            at = self.radio(text, at, chosen=text == chosen)
        self.y += 24

    def box(
        self, x: float, y: float, width: float, height: float, *, fill: str, edge: str = "none", rx: float = 4
    ) -> Element:
        """Draw a rectangle and return it."""
        return self.add("rect", x=x, y=y, width=width, height=height, rx=rx, fill=fill, stroke=edge)

    def band(self, text: str, *, bad: bool = False) -> None:
        """Write a paragraph on a coloured ground from edge to edge."""
        lines = wrapped(text, PLAIN, self.inside)
        self.box(1, self.y, self.width - 2, 12 + len(lines) * PLAIN.height, fill=ERROR_WASH if bad else WASH)
        self.y += 6
        self.write(text)
        self.y += 14

    def rule(self, room: float = 8.0) -> None:
        """Draw a line from edge to edge."""
        self.y += room
        self.add("path", d=f"M1 {number(self.y)}H{number(self.width - 1)}", stroke=LINE)
        self.y += room

    def add(self, tag: str, **attributes: float | str) -> Element:
        """Add an element and return it; an underscore in a name of an attribute stands for a hyphen."""
        made = Element(tag)
        for name, value in attributes.items():
            made.set(name.replace("_", "-"), value if isinstance(value, str) else number(value))
        self._parts.append(made)
        return made

    def put_in(self, part: Element) -> None:
        """Add an element that was made elsewhere."""
        self._parts.append(part)

    def svg(self, description: str = "") -> str:
        """Return the picture, an element on each line, so that a change of it can be read."""
        width, height = number(self.width), number(self.y + 12)
        root = Element("svg", {"xmlns": "http://www.w3.org/2000/svg", "viewBox": f"0 0 {width} {height}"})
        root.attrib |= {"width": width, "height": height, "role": "img"}
        SubElement(root, "title").text = clean(self.title)
        if description:
            SubElement(root, "desc").text = clean(description)
        ground = {"x": "0.5", "y": "0.5", "width": number(self.width - 1), "height": number(self.y + 11)}
        SubElement(root, "rect", {**ground, "rx": "6", "fill": GROUND, "stroke": LINE})
        root.extend(self._parts)
        root.text = "\n"
        for child in root:
            child.tail = "\n"
        return tostring(root, encoding="unicode")


def clean(text: str) -> str:
    """Return a text without the characters that XML has no place for."""
    return NOT_IN_XML.sub("\N{REPLACEMENT CHARACTER}", text)


def prose(text: str) -> str:
    """Return a text of the panels without the marks for code and for emphasis."""
    return MARKED.sub(lambda found: found[1] or found[2] or "", text)


def cut(text: str, style: Style, width: float) -> str:
    """Return a text, shortened if it is wider than `width` px."""
    if style.width(text) <= width:
        return text
    while text and style.width(text + "…") > width:
        text = text[:-1]
    return text + "…"


def wrapped(text: str, style: Style, width: float) -> list[str]:
    """Return the lines of a text, none wider than `width` px; the indent of a line stays."""
    lines: list[str] = []
    for paragraph in clean(text).split("\n"):
        indent = paragraph[: len(paragraph) - len(paragraph.lstrip())].replace(" ", "\N{NO-BREAK SPACE}")
        line = indent
        for word in paragraph.split():
            for piece in _pieces(word, style, width - style.width(indent)):
                longer = f"{line} {piece}" if line.strip() else line + piece
                if style.width(longer) > width and line.strip():
                    lines.append(line)
                    longer = indent + piece
                line = longer
        lines.append(line)
    return lines


def _pieces(word: str, style: Style, width: float) -> list[str]:
    """Return a word, in several pieces if it alone is too wide."""
    most = max(1, int(width / style.width("n")))
    if style.width(word) <= width:
        return [word]
    return [word[at : at + most] for at in range(0, len(word), most)]


def number(value: float) -> str:
    """Return a number of px as an SVG has it."""
    return f"{value:.1f}".removesuffix(".0")
