"""Complete pages: all pages have the same frame."""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from course_pkg.setup.stamps import digest
from course_pkg.site.chapters import Chapter, hours
from course_pkg.site.markup.prose import Prose
from course_pkg.site.search_index import Heading

HERE = Path(__file__).parent
PATHS = HERE.parent / "chapters" / "paths.json"
COURSE = "Who waits for whom?"
# A page loads only scripts and style sheets with its nonce, and it opens no connections. The panels and their
# drawings need styles in attributes, so these are allowed.
POLICY = (
    "default-src 'none'; script-src 'nonce-{nonce}'; style-src 'nonce-{nonce}'; "
    "style-src-attr 'unsafe-inline'; img-src data:; font-src data:; "
    "connect-src 'none'; base-uri 'none'; form-action 'none'"
)


class Page(NamedTuple):
    """The parts that differ between pages; `html` is the content between the header and the footer."""

    file: str
    kind: str  # The value is chapter, landing, glossary or book.
    title: str
    description: str
    html: Markup
    contents: Sequence[Heading] = ()
    panels: bool = False
    chapter: Chapter | None = None
    before: Chapter | None = None
    after: Chapter | None = None


class Choice(NamedTuple):
    """The chapters of a learning path in order, and their total time as text."""

    chapters: Sequence[Chapter]
    hours: str


class LearningPath(NamedTuple):
    """A selection of chapters that a reader can understand without any other chapter.

    If a path has two possible last chapters, it has two objects Choice.
    """

    name: str
    about: str
    afterwards: str
    choices: Sequence[Choice]


class Renderer:
    """Renders all pages with the same templates and the same list of chapters."""

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

    def part(self, template: str, **values: object) -> Markup:
        """Return the filled template; all values are escaped, except values of the type Markup."""
        return Markup(self._environment.get_template(template).render(**self._frame, **values))  # noqa: S704

    def page(self, page: Page) -> str:
        """Return the HTML of the complete page."""
        # The nonce depends on the whole page. Therefore, code in a stored output cannot contain the nonce.
        nonce = digest([self._assets, page.html])
        policy = POLICY.format(nonce=nonce)
        return str(self.part("frame.html.j2", page=page, nonce=nonce, policy=policy))


def _inline(html: str) -> Markup:
    """Remove the <p> tags if the text has only one paragraph."""
    one = html.count("<p>") == 1
    return Markup(html.removeprefix("<p>").removesuffix("</p>") if one else html)  # noqa: S704 -- Prose escapes


def landing(renderer: Renderer, chapters: Sequence[Chapter]) -> Page:
    """Return the landing page, which a reader opens first."""
    systems = json.loads((HERE / "systems.json").read_text("utf-8"))
    by_number = {chapter.number: chapter for chapter in chapters}
    for system in systems:
        system["chapters"] = [by_number[number] for number in system["chapters"] if number in by_number]
    html = renderer.part(
        "landing.html.j2",
        systems=[system for system in systems if system["chapters"]],
        paths=learning_paths(chapters),
        hours=hours(chapters),
        exercises=sum(len(chapter.points) for chapter in chapters),
        drawing=drawing(),
    )
    return Page("index.html", "landing", COURSE, "A course on ROS 1 services.", html)


def learning_paths(chapters: Sequence[Chapter]) -> list[LearningPath]:
    """Return the learning paths through the chapters in `chapters`.

    A path without a list of chapters contains all chapters.
    """
    by_number = {chapter.number: chapter for chapter in chapters}
    found = []
    for path in json.loads(PATHS.read_text("utf-8")):
        numbers = [[*path["chapters"], *end] for end in path["ends"] or [[]]]
        choices = [[by_number[one] for one in each or by_number if one in by_number] for each in numbers]
        found.append(
            LearningPath(
                path["name"],
                path["about"],
                path["afterwards"],
                tuple(Choice(each, hours(each)) for each in choices),
            )
        )
    return found


def drawing() -> Markup:
    """Return the landing page's drawing, which compares a topic with a service."""
    return Markup((HERE / "template" / "waiting.svg").read_text("utf-8"))  # noqa: S704 -- a file of ours
