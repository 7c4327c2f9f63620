"""Converts Markdown to HTML.

The class Prose escapes raw HTML, adds anchors to headings, and changes links into the site's links.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from html import escape, unescape
from typing import Literal

from mistune import HTMLRenderer, create_markdown

from course_pkg.errors import SiteError

PLUGINS = ["strikethrough", "table", "task_lists", "def_list", "math"]
TAG = re.compile(r"<[^>]*>")
NOTEBOOK = re.compile(r"(?P<name>\d\d_\w+)\.ipynb(?P<anchor>#.*)?$")


class Prose:
    """Renders the Markdown of one page, and adds an anchor to each heading.

    The function `highlight` converts code and the name of its language into HTML. The function `figure`
    converts the address and the description of a figure into HTML. All anchors begin with the text `prefix`.
    """

    def __init__(
        self,
        highlight: Callable[[str, str], str],
        prefix: str = "",
        figure: Callable[[str, str], str] | None = None,
    ) -> None:
        # Each tuple contains the level, the anchor and the text of a heading.
        self.headings: list[tuple[int, str, str]] = []
        self.figure = figure or _no_figure
        self._render = create_markdown(renderer=_Renderer(self, highlight), plugins=PLUGINS)
        self._taken: set[str] = set()
        self._prefix = prefix

    def __call__(self, source: str) -> str:
        """Return the Markdown `source` as HTML."""
        return str(self._render(source)).strip()

    def heading(self, html: str, level: int) -> str:
        """Add a heading to the list `headings`, and return its anchor; each anchor of a page is different."""
        text = words(html)
        anchor = self._prefix + _anchor(text)
        anchor = next(name for name in _numbered(anchor) if name not in self._taken)
        self._taken.add(anchor)
        self.headings.append((level, anchor, text))
        return anchor


class _Renderer(HTMLRenderer):
    def __init__(self, page: Prose, highlight: Callable[[str, str], str]) -> None:
        super().__init__(escape=True, allow_harmful_protocols=False)
        self._page, self._highlight = page, highlight

    def heading(self, text: str, level: int, **_attrs: object) -> str:
        return f'<h{level} id="{self._page.heading(text, level)}">{text}</h{level}>\n'

    def block_code(self, code: str, info: str | None = None) -> str:
        return f'<pre class="code">{self._highlight(code, (info or "text").split()[0])}</pre>\n'

    def table(self, text: str) -> str:
        return f'<div class="wide"><table>{text}</table></div>\n'

    def table_cell(self, text: str, align: str | None = None, head: bool = False) -> str:
        # In the header row of a table, an empty cell becomes <td>, not <th>.
        tag = "th" if head and text.strip() else "td"
        style = f' style="text-align:{align}"' if align else ""
        return f"<{tag}{style}>{text}</{tag}>"

    def inline_math(self, text: str) -> str:
        return mathml(text, "inline")

    def block_math(self, text: str) -> str:
        return f'<div class="wide">{mathml(text, "block")}</div>\n'

    def image(self, text: str, url: str, title: str | None = None) -> str:  # noqa: ARG002
        return self._page.figure(url, words(text))

    def paragraph(self, text: str) -> str:
        if text.startswith("<svg") and text.endswith("</svg>"):
            return f'<figure class="wide">{text}</figure>\n'
        return super().paragraph(text)

    def link(self, text: str, url: str, title: str | None = None) -> str:
        return super().link(text, page_of(url), title)


def _no_figure(url: str, _alt: str) -> str:
    raise SiteError(f"The figure {url} cannot be shown in this text. Move the figure to a cell of a chapter.")


def page_of(url: str) -> str:
    """Return the address on the site for a link in a notebook.

    For a link to another chapter, return the address of the chapter's page.
    """
    notebook = NOTEBOOK.fullmatch(url)
    return f"{notebook['name']}.html{notebook['anchor'] or ''}" if notebook else url


def mathml(formula: str, display: Literal["inline", "block"]) -> str:
    """Return a LaTeX formula as MathML, which a browser shows without a script.

    Raises SiteError for an invalid formula.
    """
    from latex2mathml.converter import convert  # The import is here, because few pages have a formula.

    try:
        return str(convert(formula.strip(), display=display))
    except Exception as error:  # The exceptions of latex2mathml have no common base class.
        raise SiteError(f"The formula ${formula}$ cannot be read: {type(error).__name__} {error}") from error


def words(html: str) -> str:
    """Return the text of an HTML fragment, without tags."""
    return unescape(TAG.sub("", html))


def attribute(text: str) -> str:
    """Return the text, escaped for an HTML attribute in quotes."""
    return escape(text, quote=True)


def _anchor(text: str) -> str:
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-") or "section"


def _numbered(name: str) -> Iterator[str]:
    yield name
    number = 2
    while True:
        yield f"{name}-{number}"
        number += 1
