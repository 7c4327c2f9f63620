"""A notebook as the body of a page, by nbconvert's exporter and a template of our own."""

from __future__ import annotations

import base64
import json
import re
import zlib
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import nbformat
from nbconvert.exporters.html import HTMLExporter
from nbconvert.filters import ansi2html
from traitlets.config import Config

from course_pkg.authoring.cells import Notebook, code_cells, exercise_of
from course_pkg.site.clean import Purifier
from course_pkg.site.code import Highlighter
from course_pkg.site.exhibits import EXHIBIT
from course_pkg.site.prose import Prose, attribute

HERE = Path(__file__).parent
PARTS = {"include_code": True, "include_input": True, "include_output": True, "include_markdown": True}
SHOWN = [EXHIBIT, "text/html", "image/svg+xml", "image/png", "image/jpeg", "text/plain"]
CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-LN-Za-ln-z]|\x1b\][^\x07]*\x07|[\x00-\x08\x0b\x0c\x0e-\x1a\x1c-\x1f]")


class Body(NamedTuple):
    """The body of a page, and its headings: (level, anchor, text)."""

    html: str
    headings: list[tuple[int, str, str]]


class Exporter(HTMLExporter):
    """Exports the cells alone; `frame.html` puts a page around them. Cleans every output."""

    template_data: ClassVar[Path] = HERE / "template"

    def __init__(self) -> None:
        settings = Config({"TemplateExporter": {"extra_template_basedirs": [str(self.template_data)]}})
        super().__init__(config=settings, template_name="course")  # type: ignore[no-untyped-call]
        self.highlight = Highlighter()
        self._prose = Prose(self.highlight.block)

    def default_filters(self) -> Iterator[tuple[str, Callable[..., Any]]]:
        """Yield nbconvert's filters and what our template needs besides."""
        yield from super().default_filters()  # type: ignore[no-untyped-call]
        yield "clean", Purifier()
        yield "code", self.highlight.cell
        yield "exercise", exercise_of
        yield "packed", packed
        yield "picture", picture
        yield "prose", lambda source: self._prose(source)
        yield "terminal", terminal

    @property
    def default_config(self) -> Config:
        """Say which kinds of output a page can show, the best first; scripts are none of them."""
        own = Config({"NbConvertBase": {"display_data_priority": SHOWN}})
        inherited: Config = super().default_config.copy()
        inherited.merge(own)
        return inherited

    def body(self, notebook: Notebook, prefix: str = "") -> Body:
        """Return the cells of `notebook` as HTML; anchors begin with `prefix`."""
        self._prose = Prose(self.highlight.block, prefix)
        resources = {"global_content_filter": PARTS, "prefix": prefix, "states": []}
        # from_notebook_node copies a notebook three times, for preprocessors, and parses the page once more.
        html = self.template.render(nb=_showable(notebook), resources=resources)
        return Body(html.strip(), self._prose.headings)


def _showable(notebook: Notebook) -> nbformat.NotebookNode:
    """Return a copy of `notebook` without the outputs that no page can show; nbconvert would warn of them."""
    copy: nbformat.NotebookNode = nbformat.from_dict(notebook)
    for cell in code_cells(copy):
        cell["outputs"] = [each for each in cell["outputs"] if _has_a_form(each)]
    return copy


def _has_a_form(output: dict[str, Any]) -> bool:
    return "data" not in output or not set(SHOWN).isdisjoint(output["data"])


def packed(states: Sequence[dict[str, Any]]) -> str:
    """Return the states of a page's panels, in their order, as JSON in zlib's format in base64."""
    text = json.dumps(states, ensure_ascii=False, separators=(",", ":"))
    return base64.b64encode(zlib.compress(text.encode(), 9)).decode()


def picture(data: str, kind: str, metadata: dict[str, Any]) -> str:
    """Return a picture that the page carries in itself; as <img>, no script in an SVG can run."""
    code = base64.b64encode(data.encode()).decode() if kind == "image/svg+xml" else data.replace("\n", "")
    about = metadata.get(kind, {})
    size = "".join(f' {name}="{int(about[name])}"' for name in ("width", "height") if name in about)
    alt = f' alt="{attribute(about["alt"])}"' if about.get("alt") else ""
    return f'<img src="data:{kind};base64,{code}"{alt}{size}>'


def terminal(text: str) -> str:
    """Return what a terminal printed: its colours kept, its other controls carried out or dropped."""
    lines = (line.rpartition("\r")[2] for line in text.replace("\r\n", "\n").split("\n"))
    return str(ansi2html(CONTROL.sub("", "\n".join(lines)))).strip("\n")
