"""`course site`: writes the site, checks it, prints the page with all chapters, and lists the problems."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.errors import SiteError
from course_pkg.setup import Places
from course_pkg.setup.commands import Command

if TYPE_CHECKING:
    from argparse import ArgumentParser


def _site(options: SimpleNamespace) -> int:
    return run_site(
        options.out,
        student=options.student,
        chapters=tuple(options.chapters),
        execute=options.execute,
        check=options.check,
        pdf=options.pdf,
        binder=options.binder,
    )


def _site_arguments(parser: ArgumentParser) -> None:
    parser.add_argument(
        "chapters",
        nargs="*",
        metavar="CHAPTER",
        help=("run only these chapters, and only if they have changed (default: all chapters)"),
    )
    parser.add_argument(
        "--out", metavar="DIR", help=("the folder for the pages (default: a folder in the cache)")
    )
    parser.add_argument("--student", action="store_true", help="show the notebooks without answers")
    parser.add_argument(
        "--check",
        action="store_true",
        help=("after writing the pages, report broken links and missing descriptions"),
    )
    parser.add_argument("--pdf", action="store_true", help="also print all chapters as a book, with Chromium")
    parser.add_argument(
        "--stored", dest="execute", action="store_false", help=("run no notebook; use the stored outputs")
    )
    parser.add_argument("--binder", metavar="URL", help="the address at which Binder opens the repository")


COMMANDS = {
    "site": Command(
        "write the course as pages that need no network and no kernel",
        _site,
        frozenset({"course", "libraries", "solutions"}),
        _site_arguments,
    )
}


# This environment variable contains the address that opens the repository and its branch in Binder.
BINDER = "COURSE_BINDER"


def run_site(
    out: str | None = None,
    *,
    student: bool = False,
    chapters: tuple[str, ...] = (),
    execute: bool = True,
    check: bool = False,
    pdf: bool = False,
    binder: str | None = None,
) -> int:
    """Write the site, print the path of its first page, and return 0.

    Raises SiteError if the run of a chapter failed, or if `check` is true and the check finds a problem.
    """
    folder = Path(out) if out else Places.of().cache / "site" / ("student" if student else "pages")
    address = (os.environ.get(BINDER, "") if binder is None else binder).rstrip("/")
    from course_pkg.site.build import Settings, write_site

    problems = write_site(Settings(folder, student, chapters, execute, address, pdf))
    if check:
        from course_pkg.site.check import faults

        problems += faults(folder)
    if pdf:
        from course_pkg.site.book import print_book

        sys.stdout.write(f"{print_book(folder)}\n")
    sys.stdout.write(f"{(folder / 'index.html').resolve()}\n")
    if problems:
        raise SiteError("\n".join(["The site is written, but it has problems:", *problems]))
    return 0
