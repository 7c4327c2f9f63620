"""Builds the site: every chapter a page, a landing page, a glossary, and what they load."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple
from urllib.parse import quote

from markupsafe import Markup

from course_pkg.authoring.cells import Notebook
from course_pkg.authoring.shelf import Shelf, read
from course_pkg.errors import AuthoringError
from course_pkg.provision.stamps import digest
from course_pkg.site.book import book, prefix
from course_pkg.site.chapters import Chapter, chapter_of
from course_pkg.site.exporter import Body, Exporter
from course_pkg.site.folder import Folder
from course_pkg.site.front import landing
from course_pkg.site.glossary import Glossary
from course_pkg.site.pages import Page, Press
from course_pkg.site.prose import words
from course_pkg.site.runs import Runs
from course_pkg.site.scripts import panels_script, panels_sheet
from course_pkg.site.settings import Settings
from course_pkg.site.texts import Section, script, sections

ASSETS = Path(__file__).with_name("assets")
FOOTER = (
    "These pages fetch nothing and send nothing. What they load lies beside them, with "
    '<a href="assets/LICENSES.txt">its licences</a>.'
)
NOT_RUN = "Its panels are missing, since the chapter has not run yet."
PANEL = 'class="panel"'


class Manuscript(NamedTuple):
    """One chapter on its way to a page; `trouble` says why it is not shown as it runs now."""

    chapter: Chapter
    source: Path
    notebook: Notebook
    body: Body
    trouble: str


def write_site(settings: Settings, shelf: Shelf | None = None, runs: Runs | None = None) -> list[str]:
    """Write the site, and return which chapters' runs failed: their pages show what was stored."""
    exporter = Exporter()
    books = list(_books(settings, shelf or Shelf(), runs or Runs(), exporter))
    chapters = [each.chapter for each in books]
    glossary = Glossary.of([(each.chapter, each.notebook, each.body.headings) for each in books])
    assets = {path.name: path.read_text("utf-8") for path in sorted(ASSETS.iterdir())}
    assets |= {"panels.js": panels_script(), "panels.css": panels_sheet()}
    press = Press(chapters, digest(assets.values()), FOOTER)
    with Folder(settings.out) as folder:
        for name, text in assets.items():
            folder.write(f"assets/{name}", text)
        folder.write("assets/texts.js", script([*_sections(books), *glossary.sections()]))
        for page in (landing(press, chapters), glossary.page(press), *_pages(press, books, settings)):
            folder.write(page.file, press.page(page))
        if settings.book:
            folder.write("book.html", press.page(book(press, _bodies(books, exporter), glossary)))
        for each in books:
            folder.copy(each.source, f"notebooks/{each.source.name}")
    return [f"{each.chapter.name}: {each.trouble}" for each in books if each.trouble not in ("", NOT_RUN)]


def _books(settings: Settings, shelf: Shelf, runs: Runs, exporter: Exporter) -> Iterator[Manuscript]:
    chosen = shelf.solutions(settings.chapters)
    for solution in shelf.solutions():
        source = shelf.root / "notebooks" / solution.name if settings.student else solution
        notebook, trouble = _shown(source, runs, execute=settings.execute and solution in chosen)
        chapter = chapter_of(source.stem, notebook)
        yield Manuscript(chapter, source, notebook, exporter.body(notebook), trouble)


def _shown(source: Path, runs: Runs, *, execute: bool) -> tuple[Notebook, str]:
    """Return the notebook as it ran, or as it is stored, and what went wrong."""
    trouble = ""
    try:
        if execute:
            return runs.of(source), ""
    except AuthoringError as error:
        trouble = f"The run failed: {error}"
    if notebook := runs.latest(source):
        return notebook, trouble
    return read(source), trouble or NOT_RUN


def _pages(press: Press, books: Sequence[Manuscript], settings: Settings) -> Iterator[Page]:
    for number, each in enumerate(books):
        html = press.part(
            "chapter.html.j2",
            body=Markup(each.body.html),  # noqa: S704 -- the exporter escapes or cleans all of it
            trouble=each.trouble,
            panels=PANEL in each.body.html,
            links=_links(each, settings),
        )
        yield Page(
            each.chapter.page,
            "chapter",
            each.chapter.full_title,
            words(each.chapter.will) or each.chapter.title,
            html,
            contents=[heading for heading in each.body.headings if heading[0] in (2, 3)],
            panels=PANEL in each.body.html,
            chapter=each.chapter,
            before=books[number - 1].chapter if number else None,
            after=books[number + 1].chapter if number + 1 < len(books) else None,
        )


def _links(each: Manuscript, settings: Settings) -> list[tuple[str, str, bool]]:
    """Return the ways into the notebook itself: (label, address, whether it is a file of the site)."""
    links = [("Download this chapter", f"notebooks/{each.source.name}", True)]
    if settings.binder:
        place = quote(f"notebooks/{each.source.name}", safe="")
        links.insert(0, ("Open in Binder", f"{settings.binder}?labpath={place}", False))
    return links


def _sections(books: Sequence[Manuscript]) -> Iterator[Section]:
    for each in books:
        yield from sections(each.chapter.full_title, each.chapter.page, each.notebook, each.body.headings)


def _bodies(books: Sequence[Manuscript], exporter: Exporter) -> list[tuple[Chapter, Body]]:
    """Return the chapters as they stand in the book, with anchors of their own."""
    return [(each.chapter, exporter.body(each.notebook, prefix(each.chapter))) for each in books]
