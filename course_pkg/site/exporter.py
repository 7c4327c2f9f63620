"""Converts a notebook to the body of a page; nbconvert renders it with the course's template."""

from __future__ import annotations

import base64
import html
import json
import re
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import count
from pathlib import Path
from typing import ClassVar, NamedTuple

import nbformat
from bleach import Cleaner
from bleach.css_sanitizer import CSSSanitizer
from nbconvert.exporters.html import HTMLExporter
from nbconvert.filters import ansi2html
from traitlets.config import Config

from course_pkg.authoring.cells import Notebook, Output, exercise_of
from course_pkg.site.markup.code import Highlighter
from course_pkg.site.markup.figures import figure
from course_pkg.site.markup.prose import Prose, attribute
from course_pkg.site.recordings import PANEL
from course_pkg.types.fields import Plain

TAGS = frozenset(
    (
        *(
            "abbr",
            "b",
            "code",
            "del",
            "em",
            "i",
            "ins",
            "kbd",
            "q",
            "s",
            "samp",
            "small",
            "span",
            "strong",
            "sub",
        ),
        *("sup", "u", "var", "a", "br", "img"),
        *("blockquote", "details", "div", "figcaption", "figure", "h3", "h4", "h5", "h6", "hr", "p", "pre"),
        *("section", "summary", "dd", "dl", "dt", "li", "ol", "ul"),
        *("caption", "table", "tbody", "td", "tfoot", "th", "thead", "tr"),
    )
)
ANYWHERE = frozenset({"class", "title", "role", "lang", "dir", "aria-label", "aria-hidden"})
SOMEWHERE = {
    "a": {"href"},
    "img": {"src", "alt", "width", "height"},
    "details": {"open"},
    "ol": {"start"},
    "td": {"colspan", "rowspan"},
    "th": {"colspan", "rowspan", "scope"},
}
VERDICT = ["border-left"]  # With this CSS property, a report shows whether the check has passed.
PLAIN = re.compile(r"[-\w\s:;#.%]*")  # The pattern matches a style without a CSS function such as url().
PICTURE = re.compile(r"data:image/(png|jpeg|gif|webp);base64,[A-Za-z0-9+/=\s]*")
HERE = Path(__file__).parent
PARTS = {"include_code": True, "include_input": True, "include_output": True, "include_markdown": True}
SHOWN = [PANEL, "text/html", "image/svg+xml", "image/png", "image/jpeg", "text/plain"]
TITLE = re.compile(r"\s*<svg\b[^>]*>\s*<title>([^<]+)</title>")
TEXT = re.compile(r"<text\b[^>]*>([^<]+)</text>")
NUMBER = re.compile(r"[-\u2212+]?[\d.]+(e[-+]?\d+)?")  # The pattern matches a number at an axis of a plot.
CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-LN-Za-ln-z]|\x1b\][^\x07]*\x07|[\x00-\x08\x0b\x0c\x0e-\x1a\x1c-\x1f]")


class Body(NamedTuple):
    """The body of a page, and its headings as tuples (level, anchor, text)."""

    html: str
    headings: list[tuple[int, str, str]]


class Exporter(HTMLExporter):
    """Exports only the cells of a notebook, and cleans every output. `frame.html.j2` adds the page frame."""

    template_data: ClassVar[Path] = HERE / "template"

    def __init__(self) -> None:
        settings = Config({"TemplateExporter": {"extra_template_basedirs": [str(self.template_data)]}})
        super().__init__(config=settings, template_name="course")  # type: ignore[no-untyped-call]
        self.highlight = Highlighter()
        self._prose = Prose(self.highlight.block)

    def default_filters(self) -> Iterator[tuple[str, Callable[..., object]]]:
        """Yield nbconvert's filters, and then the filters that the course's template adds."""
        yield from super().default_filters()  # type: ignore[no-untyped-call]
        yield "clean", Sanitizer()
        yield "code", self.highlight.cell
        yield "exercise", exercise_of
        yield "packed", packed
        yield "picture", picture
        yield "prose", lambda source: self._prose(source)
        yield "terminal", terminal

    @property
    def default_config(self) -> Config:
        """The settings of nbconvert.

        They list the MIME types that a page may show, in order of preference.
        """
        own = Config({"NbConvertBase": {"display_data_priority": SHOWN}})
        inherited: Config = super().default_config.copy()
        inherited.merge(own)
        return inherited

    def body(self, notebook: Notebook, prefix: str = "", folder: Path = Path()) -> Body:
        """Return the cells of the notebook `notebook` as HTML; all anchors begin with the text `prefix`.

        `folder` is the folder of the notebook. The paths of the notebook's figures are relative to this
        folder. Raises SiteError if a figure is missing.
        """
        numbers = count(1)

        def shown(url: str, alt: str) -> str:
            return figure(folder, url, alt, f"{prefix}f{next(numbers)}-")

        self._prose = Prose(self.highlight.block, prefix, shown)
        resources = {"global_content_filter": PARTS, "prefix": prefix, "states": []}
        # For its preprocessors, nbconvert's from_notebook_node would copy the notebook three times, and parse
        # the page again. Rendering the template directly avoids this work.
        text = self.template.render(nb=_showable(notebook), resources=resources)
        return Body(text.strip(), self._prose.headings)


def _showable(notebook: Notebook) -> nbformat.NotebookNode:
    """Return a copy of the notebook `notebook` without the outputs that a page cannot show.

    For such an output, nbconvert would print a warning.
    """
    node: nbformat.NotebookNode = nbformat.from_dict(notebook)
    for cell in (cell for cell in node["cells"] if cell["cell_type"] == "code"):
        cell["outputs"] = [each for each in cell["outputs"] if _has_a_form(each)]
    return node


def _has_a_form(output: Output) -> bool:
    return "data" not in output or not set(SHOWN).isdisjoint(output["data"])


def packed(states: Sequence[Mapping[str, Plain]]) -> str:
    """Return the states of a page's panels, in the order of the panels.

    The result is JSON, compressed with zlib, in base64.
    """
    text = json.dumps(states, ensure_ascii=False, separators=(",", ":"))
    return base64.b64encode(zlib.compress(text.encode(), 9)).decode()


def picture(data: str, kind: str, metadata: Mapping[str, Mapping[str, str]]) -> str:
    """Return a picture as an <img> element that contains the picture's data.

    A script in an SVG cannot run inside an <img> element.
    """
    code = base64.b64encode(data.encode()).decode() if kind == "image/svg+xml" else data.replace("\n", "")
    about = metadata.get(kind, {})
    size = "".join(f' {name}="{int(about[name])}"' for name in ("width", "height") if name in about)
    words = about.get("alt") or (description(data) if kind == "image/svg+xml" else "")
    alt = f' alt="{attribute(words)}"' if words else ""
    return f'<img src="data:{kind};base64,{code}"{alt}{size}>'


def description(svg: str) -> str:
    """Return the title of a panel's picture, or the labels of a plot, as a text for screen readers.

    The labels of a plot are its title and the labels of its axes and legend, but not the numbers at its axes.
    """
    if title := TITLE.match(svg):
        return html.unescape(title[1]).strip()
    texts = [html.unescape(each).strip() for each in TEXT.findall(svg)]
    labels = [each for each in texts if not NUMBER.fullmatch(each)]
    return f"Figure: {', '.join(labels)}" if labels else ""


def terminal(text: str) -> str:
    """Return the output of a terminal as HTML.

    The HTML shows the colours of the output. A carriage return overwrites the line, as in a terminal. All
    other control codes are removed.
    """
    lines = (line.rpartition("\r")[2] for line in text.replace("\r\n", "\n").split("\n"))
    return str(ansi2html(CONTROL.sub("", "\n".join(lines)))).strip("\n")


class Sanitizer:
    """Removes everything from HTML except text and its structure, links, and pictures with embedded data."""

    def __init__(self) -> None:
        self._cleaner = Cleaner(
            tags=TAGS,
            attributes=_may_have,
            protocols=["http", "https", "mailto", "data"],
            css_sanitizer=CSSSanitizer(allowed_css_properties=VERDICT),
            strip=True,
            strip_comments=True,
        )

    def __call__(self, html: str) -> str:
        """Return the HTML without elements that could run code, load a file, or look like the site's page."""
        return str(self._cleaner.clean(html))


def _may_have(tag: str, name: str, value: str) -> bool:
    if name == "src":
        return tag == "img" and bool(PICTURE.fullmatch(value))
    if name == "style":
        return tag == "section" and bool(PLAIN.fullmatch(value))
    if name == "href":
        return tag == "a" and not value.strip().lower().startswith("data:")
    return name in ANYWHERE or name in SOMEWHERE.get(tag, ())
