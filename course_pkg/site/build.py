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
NOT_RUN = "Its panels are missing: `course site` has not run it with this package."
PANEL = 'class="panel"'


class Book(NamedTuple):
    """One chapter on its way to a page; `trouble` says why it is not shown as it runs now."""

    chapter: Chapter
    source: Path
    notebook: Notebook
    body: Body
    trouble: str


def write_site(settings: Settings, shelf: Shelf | None = None, runs: Runs | None = None) -> list[str]:
    """Write the site, and return what went wrong with single chapters, whose pages show what was stored."""
    books = list(_books(settings, shelf or Shelf(), runs or Runs()))
    chapters = [book.chapter for book in books]
    glossary = Glossary.of([(book.chapter, book.notebook, book.body.headings) for book in books])
    assets = {path.name: path.read_text("utf-8") for path in sorted(ASSETS.iterdir())}
    assets |= {"panels.js": panels_script(), "panels.css": panels_sheet()}
    press = Press(chapters, digest(assets.values()), FOOTER)
    with Folder(settings.out) as folder:
        for name, text in assets.items():
            folder.write(f"assets/{name}", text)
        folder.write("assets/texts.js", script([*_sections(books), *glossary.sections()]))
        for page in (landing(press, chapters), glossary.page(press), *_pages(press, books, settings)):
            folder.write(page.file, press.page(page))
        for book in books:
            folder.copy(book.source, f"notebooks/{book.source.name}")
    return [f"{book.chapter.name}: {book.trouble}" for book in books if book.trouble]


def _books(settings: Settings, shelf: Shelf, runs: Runs) -> Iterator[Book]:
    exporter = Exporter()
    chosen = shelf.solutions(settings.chapters)
    for solution in shelf.solutions():
        source = shelf.root / "notebooks" / solution.name if settings.student else solution
        notebook, trouble = _shown(source, runs, execute=settings.execute and solution in chosen)
        chapter = chapter_of(source.stem, notebook)
        yield Book(chapter, source, notebook, exporter.body(notebook), trouble)


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


def _pages(press: Press, books: Sequence[Book], settings: Settings) -> Iterator[Page]:
    for number, book in enumerate(books):
        html = press.part(
            "chapter.html.j2",
            body=Markup(book.body.html),  # noqa: S704 -- the exporter escapes or cleans all of it
            trouble=book.trouble,
            links=_links(book, settings),
        )
        yield Page(
            book.chapter.page,
            "chapter",
            book.chapter.full_title,
            words(book.chapter.will) or book.chapter.title,
            html,
            contents=[heading for heading in book.body.headings if heading[0] in (2, 3)],
            panels=PANEL in book.body.html,
            chapter=book.chapter,
            before=books[number - 1].chapter if number else None,
            after=books[number + 1].chapter if number + 1 < len(books) else None,
        )


def _links(book: Book, settings: Settings) -> list[tuple[str, str, bool]]:
    """Return the ways into the notebook itself: (label, address, whether it is a file of the site)."""
    links = [("Download this chapter", f"notebooks/{book.source.name}", True)]
    if settings.binder:
        place = quote(f"notebooks/{book.source.name}", safe="")
        links.insert(0, ("Open in Binder", f"{settings.binder}?labpath={place}", False))
    return links


def _sections(books: Sequence[Book]) -> Iterator[Section]:
    for book in books:
        yield from sections(book.chapter.full_title, book.chapter.page, book.notebook, book.body.headings)
