"""Builds the site: a page for each chapter, a landing page, a glossary, and all files that pages load."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import TracebackType
from typing import NamedTuple
from urllib.parse import quote

from markupsafe import Markup

from course_pkg.authoring.cells import Notebook
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.errors import SiteError
from course_pkg.setup.stamps import digest
from course_pkg.site.book import book, prefix
from course_pkg.site.chapters import Chapter, chapter_of
from course_pkg.site.exporter import Body, Exporter
from course_pkg.site.glossary import Glossary
from course_pkg.site.markup.prose import words
from course_pkg.site.pages import Page, Renderer, landing
from course_pkg.site.runs import Runs
from course_pkg.site.scripts import panels_script, panels_sheet
from course_pkg.site.search_index import Section, script, sections

LIST = ".course-site"  # This file in the site's folder lists all files of the site.
ASSETS = Path(__file__).with_name("assets")
FOOTER = (
    "These pages use no network: all files that they load are in the same folder. "
    '<a href="assets/LICENSES.txt">Licences of these files</a>.'
)
NOT_RUN = "The panels are missing, because the chapter has not been run yet."
PANEL_CLASS = 'class="panel"'


class PageSource(NamedTuple):
    """A chapter for which the site has a page.

    `trouble` is the reason why the page does not show the latest run; otherwise, it is "".
    """

    chapter: Chapter
    source: Path
    notebook: Notebook
    body: Body
    trouble: str


def write_site(settings: Settings, store: NotebookStore | None = None, runs: Runs | None = None) -> list[str]:
    """Write the site, and return a message for each chapter with a failed run.

    If the run of a chapter has failed, its page shows the stored outputs.
    """
    exporter = Exporter()
    books = list(_books(settings, store or NotebookStore(), runs or Runs(), exporter))
    chapters = [each.chapter for each in books]
    glossary = Glossary.of([(each.chapter, each.notebook, each.body.headings) for each in books])
    assets = {path.name: path.read_text("utf-8") for path in sorted(ASSETS.iterdir())}
    assets |= {"panels.js": panels_script(), "panels.css": panels_sheet()}
    renderer = Renderer(chapters, digest(assets.values()), FOOTER)
    with Folder(settings.out) as folder:
        for name, text in assets.items():
            folder.write(f"assets/{name}", text)
        folder.write("assets/texts.js", script([*_sections(books), *glossary.sections()]))
        pages = landing(renderer, chapters), glossary.page(renderer), *_pages(renderer, books, settings)
        for page in pages:
            folder.write(page.file, renderer.page(page))
        if settings.book:
            folder.write("book.html", renderer.page(book(renderer, _bodies(books, exporter), glossary)))
        for each in books:
            folder.copy(each.source, f"notebooks/{each.source.name}")
    return [f"{each.chapter.name}: {each.trouble}" for each in books if each.trouble not in ("", NOT_RUN)]


def _books(settings: Settings, store: NotebookStore, runs: Runs, exporter: Exporter) -> Iterator[PageSource]:
    solutions, chosen = store.solutions(), store.solutions(settings.chapters)
    folder = store.root / ("notebooks" if settings.student else "solutions")
    errors = runs.update([folder / path.name for path in chosen]) if settings.execute else {}
    for source in (folder / path.name for path in solutions):
        trouble = f"The run failed: {errors[source]}" if source in errors else ""
        notebook = runs.latest(source)
        if notebook is None:
            notebook, trouble = read(source), trouble or NOT_RUN
        chapter = chapter_of(source.stem, notebook)
        yield PageSource(chapter, source, notebook, exporter.body(notebook, folder=folder), trouble)


def _pages(renderer: Renderer, books: Sequence[PageSource], settings: Settings) -> Iterator[Page]:
    for number, each in enumerate(books):
        html = renderer.part(
            "chapter.html.j2",
            body=Markup(each.body.html),  # noqa: S704 -- the exporter escapes or cleans all of it
            trouble=each.trouble,
            panels=PANEL_CLASS in each.body.html,
            links=_links(each, settings),
        )
        yield Page(
            each.chapter.page,
            "chapter",
            each.chapter.full_title,
            words(each.chapter.will) or each.chapter.title,
            html,
            contents=[heading for heading in each.body.headings if heading[0] in (2, 3)],
            panels=PANEL_CLASS in each.body.html,
            chapter=each.chapter,
            before=books[number - 1].chapter if number else None,
            after=books[number + 1].chapter if number + 1 < len(books) else None,
        )


def _links(each: PageSource, settings: Settings) -> list[tuple[str, str, bool]]:
    """Return the links to the notebook as tuples (label, address, whether the file belongs to the site)."""
    links = [("Download this chapter", f"notebooks/{each.source.name}", True)]
    if settings.binder:
        place = quote(f"notebooks/{each.source.name}", safe="")
        links.insert(0, ("Open in Binder", f"{settings.binder}?labpath={place}", False))
    return links


def _sections(books: Sequence[PageSource]) -> Iterator[Section]:
    for each in books:
        yield from sections(each.chapter.full_title, each.chapter.page, each.notebook, each.body.headings)


def _bodies(books: Sequence[PageSource], exporter: Exporter) -> list[tuple[Chapter, Body]]:
    """Return the chapters for the page with all chapters; each chapter has a different anchor prefix."""
    return [
        (each.chapter, exporter.body(each.notebook, prefix(each.chapter), each.source.parent))
        for each in books
    ]


class Settings(NamedTuple):
    """The options of `course site`.

    `out` is the output folder. If `student` is True, the pages show the students' notebooks; otherwise, they
    show the solutions. `chapters` lists the chapters that may run again; they run only if they have changed.
    For all other chapters, the site shows the outputs of the last run. If `execute` is False, no chapter runs
    again. `binder` is the address that opens the repository in Binder, without the query. If `book` is True,
    the site also has a page with all chapters.
    """

    out: Path
    student: bool = False
    chapters: tuple[str, ...] = ()
    execute: bool = True
    binder: str = ""
    book: bool = False


class Folder:
    """The folder of a site during writing; it is a context manager.

    If the `with` block raises no exception, the files of an earlier site that were not written again are
    removed.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._list = path / LIST
        self._written: set[str] = set()

    def __enter__(self) -> Folder:
        """Prepare the folder.

        Raises SiteError if the folder cannot be used, or if it contains files that are not part of a site.
        """
        try:
            self._path.mkdir(parents=True, exist_ok=True)
            foreign = not self._list.exists() and any(self._path.iterdir())
        except OSError as error:
            raise SiteError(
                f"The folder {self._path} cannot be used: {error.strerror}. Give another folder with --out."
            ) from error
        if foreign:
            raise SiteError(
                f"{self._path} contains files that do not belong to a site. Give an empty or a new "
                "folder with --out."
            )
        self._list.touch()
        self._before = set(self._list.read_text("utf-8").split("\n"))
        return self

    def __exit__(
        self, kind: type[BaseException] | None, _error: object, _trace: TracebackType | None
    ) -> None:
        gone = set() if kind else self._before - self._written
        for name in filter(None, gone):
            (self._path / name).unlink(missing_ok=True)
        self._list.write_text("\n".join(sorted((self._before | self._written) - gone)), "utf-8")

    def write(self, name: str, text: str) -> None:
        """Write a file of the site."""
        self._place(name).write_text(text, "utf-8")

    def copy(self, source: Path, name: str) -> None:
        """Copy a file into the site."""
        shutil.copyfile(source, self._place(name))

    def _place(self, name: str) -> Path:
        self._written.add(name)
        place = self._path / name
        place.parent.mkdir(exist_ok=True)
        return place
