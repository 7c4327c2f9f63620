"""Draws the still picture of a panel as an SVG without scripts, row by row from top to bottom.

A program that displays a notebook puts several pictures into one page. Ids and style sheets of different
pictures could conflict, so a picture contains no ids and no style sheet. The colours are the colours of the
light theme in look.css.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias
from xml.etree.ElementTree import Element, SubElement, tostring

# In a State, the keys are the names of a panel's traits, and the values are JSON data.
State: TypeAlias = Mapping[str, Any]

GROUND, RAISED, WASH = "#ffffff", "#f4f6f8", "#e8f0fb"
TEXT, MUTED, LINE, EDGE, ACCENT = "#1c2127", "#545d68", "#d5dae0", "#838c96", "#1259b5"
GOOD, ERROR, ERROR_WASH = "#18713a", "#ae1f1f", "#fdefee"
SANS = "Arial, Helvetica, 'Liberation Sans', sans-serif"
MONO = "Menlo, Consolas, 'DejaVu Sans Mono', monospace"

WIDTH = 760.0  # The width is in px.
EDGES = 16.0  # distance in px between the border of the picture and its content
SIZE, SMALL = 13.0, 12.0  # font sizes in px
LEADING = 1.5  # height of a line divided by the font size
MONO_LETTER = 0.61  # width of a letter of the monospaced font divided by the font size
# This dict contains the widths of letters, divided by the font size. The font is DejaVu Sans. A viewer of the
# picture may use this font, and the other possible fonts are narrower.
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
    """The font and the colour of a text."""

    size: float = SIZE
    bold: bool = False
    mono: bool = False
    colour: str = TEXT

    def width(self, text: str) -> float:
        """Return the approximate width of a text in px, for the widest font that a viewer may use."""
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
    """A column of a table: its left edge (px), the maximum width of its texts (px), and their style."""

    left: float
    width: float
    style: Style = PLAIN


class Paper:
    """A picture to which rows are added at the bottom; `y` is the top of the next row in px."""

    def __init__(self, title: str, width: float = WIDTH) -> None:
        self.title = title
        self.width = width
        self.y = 12.0
        self._parts: list[Element] = []

    @property
    def inside(self) -> float:
        """The width of the picture without the left and right margins (px)."""
        return self.width - 2 * EDGES

    def write(
        self, text: str, style: Style = PLAIN, *, left: float = EDGES, width: float | None = None
    ) -> None:
        """Write a paragraph in one or more lines, and move `y` below the paragraph."""
        lines = wrapped(text, style, (self.width - EDGES - left) if width is None else width)
        for line in lines:
            self.put(line, left, self.y + style.height / 2, style)
            self.y += style.height

    def put(self, text: str, x: float, middle: float, style: Style = PLAIN, *, anchor: str = "start") -> None:
        """Write one line. `middle` is the y coordinate of the middle of the letters. `y` does not change."""
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
        """Write a label, and write a text to the right of the label."""
        self.put(label, EDGES, self.y + CODE.height / 2, FAINT)
        self.write(text, CODE if mono else PLAIN, left=EDGES + left)

    def row(self, columns: Sequence[Column], texts: Sequence[str], *, room: float = 4.0) -> None:
        """Write one text into each column of a table, and move `y` below the tallest text."""
        top = low = self.y
        for column, text in zip(columns, texts, strict=True):
            self.y = top
            self.write(text, column.style, left=column.left, width=column.width)
            low = max(low, self.y)
        self.y = low + room

    def input(self, text: str, *, left: float, width: float) -> None:
        """Draw an input field and the text in it; `y` does not change."""
        self.box(left, self.y, width, 26, fill=GROUND, edge=EDGE)
        self.put(cut(text, CODE, width - 14), left + 8, self.y + 13, CODE)

    def button(self, text: str, left: float, *, main: bool = False) -> float:
        """Draw a button, and return the left edge of the next button; `y` does not change."""
        style = Style(colour=GROUND if main else TEXT)
        width = style.width(text) + 24
        self.box(left, self.y, width, 28, fill=ACCENT if main else RAISED, edge=ACCENT if main else EDGE)
        self.put(text, left + width / 2, self.y + 14, style, anchor="middle")
        return left + width + 8

    def radio(self, text: str, left: float, *, chosen: bool = False) -> float:
        """Draw one option of a question, and return the x coordinate for the next option.

        `y` does not change.
        """
        self.add(
            "circle", cx=left + 7, cy=self.y + 10, r=6, fill=GROUND, stroke=ACCENT if chosen else EDGE
        ).set("stroke-width", "1.5")
        if chosen:
            self.add("circle", cx=left + 7, cy=self.y + 10, r=3, fill=ACCENT)
        self.put(text, left + 20, self.y + 10)
        return left + 20 + PLAIN.width(text) + 20

    def options(self, texts: Iterable[str], chosen: str = "", *, left: float = EDGES) -> None:
        """Draw the options of a question in one or more rows, and move `y` below the options."""
        at = left
        for text in texts:
            if at > left and at + 20 + PLAIN.width(text) > self.width - EDGES:
                at, self.y = left, self.y + 24
            at = self.radio(text, at, chosen=text == chosen)
        self.y += 24

    def box(
        self, x: float, y: float, width: float, height: float, *, fill: str, edge: str = "none", rx: float = 4
    ) -> Element:
        """Draw a rectangle, and return its SVG element."""
        return self.add("rect", x=x, y=y, width=width, height=height, rx=rx, fill=fill, stroke=edge)

    def band(self, text: str, *, bad: bool = False) -> None:
        """Write a paragraph on a coloured background that is as wide as the picture."""
        lines = wrapped(text, PLAIN, self.inside)
        self.box(1, self.y, self.width - 2, 12 + len(lines) * PLAIN.height, fill=ERROR_WASH if bad else WASH)
        self.y += 6
        self.write(text)
        self.y += 14

    def rule(self, room: float = 8.0) -> None:
        """Draw a horizontal line across the whole picture."""
        self.y += room
        self.add("path", d=f"M1 {number(self.y)}H{number(self.width - 1)}", stroke=LINE)
        self.y += room

    def add(self, tag: str, **attributes: float | str) -> Element:
        """Add an SVG element, and return it. In the names of attributes, each underscore becomes a hyphen."""
        made = Element(tag)
        for name, value in attributes.items():
            made.set(name.replace("_", "-"), value if isinstance(value, str) else number(value))
        self._parts.append(made)
        return made

    def put_in(self, part: Element) -> None:
        """Add an element that the caller has created."""
        self._parts.append(part)

    def svg(self, description: str = "") -> str:
        """Return the picture as an SVG with one element per line; diffs are then readable."""
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
    """Replace the characters that XML does not allow."""
    return NOT_IN_XML.sub("\N{REPLACEMENT CHARACTER}", text)


def prose(text: str) -> str:
    """Remove the Markdown characters for code and emphasis from a text."""
    return MARKED.sub(lambda found: found[1] or found[2] or "", text)


def cut(text: str, style: Style, width: float) -> str:
    """Return the text; if it is wider than `width` (px), shorten it and end it with an ellipsis."""
    if style.width(text) <= width:
        return text
    while text and style.width(text + "…") > width:
        text = text[:-1]
    return text + "…"


def wrapped(text: str, style: Style, width: float) -> list[str]:
    """Split a text into lines; `width` is the maximum width of a line in px.

    Each line has the same indentation as the paragraph in `text` to which the line belongs.
    """
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
    most = max(1, int(width / style.width("n")))
    if style.width(word) <= width:
        return [word]
    return [word[at : at + most] for at in range(0, len(word), most)]


def number(value: float) -> str:
    """Return a number of px as text with at most one decimal place."""
    return f"{value:.1f}".removesuffix(".0")
