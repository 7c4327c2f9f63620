"""The whole course as one document; Chromium prints it to a PDF file."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

from markupsafe import Markup

from course_pkg.errors import SiteError
from course_pkg.site.chapters import Chapter, hours
from course_pkg.site.exporter import Body
from course_pkg.site.glossary import Glossary
from course_pkg.site.pages import COURSE, Page, Renderer, drawing

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
TIMEOUT = 180  # The time is in s.
OPTIONS = (
    "--headless",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--no-pdf-header-footer",
    "--generate-pdf-document-outline",
    # Chromium's virtual clock runs for up to this time in ms before Chromium prints the page. This time is
    # long enough to draw all panels.
    "--virtual-time-budget=20000",
)
LINK = re.compile(r'href="(?P<number>\d\d)_\w+\.html(?:#(?P<anchor>[^"]*))?"')


def prefix(chapter: Chapter) -> str:
    """Return the text with which all anchors (HTML ids) of a chapter begin.

    All chapters of the book are on one page. Their anchors therefore need different prefixes.
    """
    return f"c{chapter.number}-"


def book(renderer: Renderer, bodies: Sequence[tuple[Chapter, Body]], glossary: Glossary) -> Page:
    """Return the page that contains all chapters.

    In `bodies`, the anchors of each chapter begin with the chapter's `prefix`.
    """
    first = {chapter.number: body.headings[0][1] for chapter, body in bodies if body.headings}
    html = renderer.part(
        "book.html.j2",
        bodies=[(chapter, body.headings, Markup(body.html)) for chapter, body in bodies],  # noqa: S704 -- cleaned
        hours=hours([chapter for chapter, _ in bodies]),
        drawing=drawing(),
        glossary=glossary.text(renderer),
    )
    linked = LINK.sub(lambda link: f'href="#{_place(link, first)}"', html)
    return Page("book.html", "book", COURSE, "The whole course.", Markup(linked), panels=True)  # noqa: S704


def print_book(folder: Path) -> Path:
    """Print `book.html` to `book.pdf` in the same folder, and return the path of the PDF file.

    Raises SiteError if this machine has no Chromium, or if Chromium prints no file within TIMEOUT.
    """
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if not browser:
        raise SiteError("This machine has no Chromium. Open book.html in any browser, and print it there.")
    target = folder.resolve() / "book.pdf"
    target.unlink(missing_ok=True)
    with tempfile.TemporaryDirectory(prefix="course-book-") as profile:
        command = [browser, *OPTIONS, f"--user-data-dir={profile}", f"--print-to-pdf={target}"]
        if os.geteuid() == 0:
            command.append("--no-sandbox")  # The root user cannot start Chromium with a sandbox.
        printed = _run([*command, (folder / "book.html").resolve().as_uri()])
    if not target.exists():
        raise SiteError(f"Chromium did not print the book. Its output was:\n{printed[-2000:]}")
    return target


def _run(command: Sequence[str]) -> str:
    try:
        result = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT, check=False)
    except subprocess.TimeoutExpired as error:
        raise SiteError(f"Chromium did not print the book within {TIMEOUT} s.") from error
    return result.stderr


def _place(link: re.Match[str], first: dict[str, str]) -> str:
    number, anchor = link["number"], link["anchor"]
    return f"c{number}-{anchor}" if anchor else first.get(number, "")
