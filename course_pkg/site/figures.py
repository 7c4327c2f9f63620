"""The figures that a notebook's Markdown names, as a page carries them: in itself, as it loads no other file.

A drawing (SVG) becomes a part of the page, so that its text can be selected and found. It follows the page's
colours if it draws its text with `currentColor` and its white ground as `<rect class="ground" …>`, which the
page does not fill. Any other drawing keeps a white ground, also in dark mode.
"""

from __future__ import annotations

import base64
import re
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree

from course_pkg.errors import SiteError
from course_pkg.site.prose import attribute

NAMESPACE = "{http://www.w3.org/2000/svg}"
SHAPES = ("circle", "ellipse", "line", "path", "polygon", "polyline", "rect", "text", "tspan", "use")
DRAWN = frozenset(
    (*SHAPES, "svg", "g", "defs", "marker", "clipPath", "linearGradient", "radialGradient", "stop")
)
SAID = ("title", "desc")  # the description beside the drawing's name in Markdown replaces them
WITHIN = re.compile(r"url\(#([^)]*)\)")  # a reference to another element of the drawing
KINDS = {".png": "png", ".jpg": "jpeg", ".jpeg": "jpeg", ".gif": "gif", ".webp": "webp"}
SMALLEST = 0.75  # of a drawing's own width; in a narrower window it is scrolled, or its text is too small


def figure(folder: Path, url: str, alt: str, prefix: str) -> str:
    """Return the figure `url` of a notebook in `folder` as HTML.

    The ids in a drawing begin with `prefix`, which tells a page's drawings apart. Raises
    SiteError if a page cannot carry it: its file is missing, or it has no description.
    """
    if not alt.strip():
        raise SiteError(f"The figure {url} has no description. Write one: ![description]({url}).")
    path = folder / unquote(url)
    try:
        content = path.read_bytes()
    except (OSError, ValueError) as error:
        raise SiteError(f"There is no figure {url}, as seen from {folder}.") from error
    if path.suffix == ".svg":
        return _drawing(path, content, alt, prefix)
    if path.suffix not in KINDS:
        raise SiteError(f"The figure {url} is neither a drawing (.svg) nor a picture ({', '.join(KINDS)}).")
    data = base64.b64encode(content).decode()
    return f'<img src="data:image/{KINDS[path.suffix]};base64,{data}" alt="{attribute(alt)}">'


def _drawing(path: Path, content: bytes, alt: str, prefix: str) -> str:
    try:
        root = ElementTree.fromstring(content)  # noqa: S314 -- a file of the course, and not a student's
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
    """Return a drawing's own width in pixels; 0 if it has none."""
    box = re.fullmatch(r"\s*\S+\s+\S+\s+([\d.]+)\s+\S+\s*", root.get("viewBox", ""))
    return float(box[1]) if box else 0.0


def _carried(path: Path, element: ElementTree.Element, prefix: str) -> None:
    """Name an element as HTML does, and make its id the page's only one. Raises SiteError for a script."""
    element.tag = element.tag.removeprefix(NAMESPACE)
    if element.tag not in DRAWN:
        raise SiteError(f"The figure {path} has a <{element.tag}>. A page carries only {_listed()}.")
    for name, value in list(element.attrib.items()):
        if name == "id":
            element.set(name, prefix + value)
        elif name.lower().startswith("on") or (name.endswith("href") and not value.startswith("#")):
            raise SiteError(f'The figure {path} has {name}="{value}". A page runs and loads nothing from it.')
        elif name.endswith("href"):
            element.set(name, f"#{prefix}{value[1:]}")
        else:
            element.set(name, WITHIN.sub(rf"url(#{prefix}\1)", value))


def _listed() -> str:
    return ", ".join(f"<{name}>" for name in sorted(DRAWN))
