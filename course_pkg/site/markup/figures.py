"""Converts the figures in the Markdown of a notebook to HTML.

The HTML contains the data of the figures, because a page must not load image files.

A drawing (SVG) becomes part of the page's HTML, so readers can select and search its text. A drawing uses the
page's colours under two conditions: its text has the colour `currentColor`, and its white background is
`<rect class="ground" …>`. On the page, a rectangle of the class `ground` is transparent. Any other drawing
has a white background, even in dark mode.
"""

from __future__ import annotations

import base64
import re
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree

from course_pkg.errors import SiteError
from course_pkg.site.markup.prose import attribute

NAMESPACE = "{http://www.w3.org/2000/svg}"
SHAPES = ("circle", "ellipse", "line", "path", "polygon", "polyline", "rect", "text", "tspan", "use")
DRAWN = frozenset(
    (*SHAPES, "svg", "g", "defs", "marker", "clipPath", "linearGradient", "radialGradient", "stop")
)
SAID = ("title", "desc")  # The description in the Markdown replaces these elements.
# The pattern matches a reference to another element of the same drawing.
WITHIN = re.compile(r"url\(#([^)]*)\)")
KINDS = {".png": "png", ".jpg": "jpeg", ".jpeg": "jpeg", ".gif": "gif", ".webp": "webp"}
# This is the minimum width of a drawing, divided by the drawing's own width. In a narrower window, the
# drawing gets a scroll bar: smaller text is too small to read.
SMALLEST = 0.75


def figure(folder: Path, url: str, alt: str, prefix: str) -> str:
    """Return the figure `url` of a notebook as HTML; `folder` is the folder of the notebook.

    All ids in a drawing begin with the text `prefix`; two drawings on a page then have different ids. Raises
    SiteError if the file is missing or has another format, or if the description `alt` is empty. Also raises
    SiteError for a drawing with a forbidden element, such as a script.
    """
    if not alt.strip():
        raise SiteError(f"The figure {url} has no description. Write a description: ![description]({url}).")
    path = folder / unquote(url)
    try:
        content = path.read_bytes()
    except (OSError, ValueError) as error:
        raise SiteError(
            f"There is no figure {url} in {folder}. Correct the path in the Markdown cell."
        ) from error
    if path.suffix == ".svg":
        return _drawing(path, content, alt, prefix)
    if path.suffix not in KINDS:
        raise SiteError(
            f"The figure {url} has the wrong format. Use a drawing (.svg) or a picture ({', '.join(KINDS)})."
        )
    data = base64.b64encode(content).decode()
    return f'<img src="data:image/{KINDS[path.suffix]};base64,{data}" alt="{attribute(alt)}">'


def _drawing(path: Path, content: bytes, alt: str, prefix: str) -> str:
    try:
        root = ElementTree.fromstring(content)  # noqa: S314 -- a file of the course, not of a student
    except ElementTree.ParseError as error:
        raise SiteError(f"The figure {path} cannot be read: {error}.") from error
    width = _width(root)
    for parent in root.iter():
        for child in [each for each in parent if each.tag.removeprefix(NAMESPACE) in SAID]:
            parent.remove(child)
        _carried(path, parent, prefix)
    for name in ("id", "aria-labelledby", "aria-describedby"):
        root.attrib.pop(name, None)
    root.attrib.update({"class": "drawing", "role": "img", "aria-label": alt})
    if width:
        root.attrib["style"] = f"min-width: {SMALLEST * width:.0f}px"
    return ElementTree.tostring(root, encoding="unicode")


def _width(root: ElementTree.Element) -> float:
    """Return the width of a drawing in pixels, or 0 if the drawing contains no width."""
    box = re.fullmatch(r"\s*\S+\s+\S+\s+([\d.]+)\s+\S+\s*", root.get("viewBox", ""))
    return float(box[1]) if box else 0.0


def _carried(path: Path, element: ElementTree.Element, prefix: str) -> None:
    """Remove the namespace from an element's tag, and add the prefix to its id and to its references.

    Raises SiteError for a forbidden element such as a script, or if an attribute runs code or loads a file.
    """
    element.tag = element.tag.removeprefix(NAMESPACE)
    if element.tag not in DRAWN:
        raise SiteError(f"The figure {path} has a <{element.tag}>. A page allows only {_listed()}.")
    for name, value in list(element.attrib.items()):
        if name == "id":
            element.set(name, prefix + value)
        elif name.lower().startswith("on") or (name.endswith("href") and not value.startswith("#")):
            raise SiteError(
                f'The figure {path} has {name}="{value}". Remove this attribute, because a figure must not '
                "run or load anything."
            )
        elif name.endswith("href"):
            element.set(name, f"#{prefix}{value[1:]}")
        else:
            element.set(name, WITHIN.sub(rf"url(#{prefix}\1)", value))


def _listed() -> str:
    return ", ".join(f"<{name}>" for name in sorted(DRAWN))
