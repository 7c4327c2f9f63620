"""Pages put together: what stands around a text, the same on every page."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from course_pkg.provision.stamps import digest
from course_pkg.site.chapters import Chapter
from course_pkg.site.prose import Prose
from course_pkg.site.texts import Heading

HERE = Path(__file__).parent
COURSE = "Who waits for whom?"
# Nothing loads but what carries the page's own mark, and nothing connects anywhere. Attributes may
# hold styles: the panels and their drawings use them.
POLICY = (
    "default-src 'none'; script-src 'nonce-{nonce}'; style-src 'nonce-{nonce}'; "
    "style-src-attr 'unsafe-inline'; img-src data:; font-src data:; "
    "connect-src 'none'; base-uri 'none'; form-action 'none'"
)


class Page(NamedTuple):
    """What differs from page to page; `html` is what stands between header and footer."""

    file: str
    kind: str  # chapter, landing or glossary
    title: str
    description: str
    html: Markup
    contents: Sequence[Heading] = ()
    panels: bool = False
    chapter: Chapter | None = None
    before: Chapter | None = None
    after: Chapter | None = None


class Press:
    """Prints pages, all from the same templates and with the same list of chapters."""

    def __init__(self, chapters: Sequence[Chapter], assets: str, footer: str) -> None:
        self._environment = Environment(
            loader=FileSystemLoader(HERE / "template"),
            autoescape=True,
            undefined=StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
        )
        plain = Prose(lambda code, _language: code)
        self._environment.filters["prose"] = lambda text: _inline(plain(text))
        mark = (HERE / "template" / "mark.svg").read_text("utf-8").strip()
        self._frame = {
            "course": COURSE,
            "chapters": chapters,
            "mark": Markup(mark),  # noqa: S704 -- a file of ours
            "icon": "data:image/svg+xml;base64," + base64.b64encode(mark.encode()).decode(),
            "footer": Markup(footer),  # noqa: S704
        }
        self._assets = assets

    def part(self, template: str, **values: Any) -> Markup:  # noqa: ANN401 -- whatever a template wants
        """Return a template filled in; texts are escaped, Markup is not."""
        return Markup(self._environment.get_template(template).render(**self._frame, **values))  # noqa: S704

    def page(self, page: Page) -> str:
        """Return the whole page."""
        # Nobody who writes an output can know a mark that is made of the very page.
        nonce = digest([self._assets, page.html])
        policy = POLICY.format(nonce=nonce)
        return str(self.part("frame.html.j2", page=page, nonce=nonce, policy=policy))


def _inline(html: str) -> Markup:
    """Take the paragraph off a text of one."""
    one = html.count("<p>") == 1
    return Markup(html.removeprefix("<p>").removesuffix("</p>") if one else html)  # noqa: S704 -- Prose escapes
