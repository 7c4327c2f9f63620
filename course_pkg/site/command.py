"""`course site`: writes the site, checks it, makes a book of it, and says what came of that."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from course_pkg.errors import SiteError
from course_pkg.provision import Places
from course_pkg.site.settings import Settings

BINDER = "COURSE_BINDER"  # the address that opens the repository, up to the branch
SLOW = "rfc3987_syntax"


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
    """Write the site and say where; return 1 if a chapter did not run, or `check` finds something wrong."""
    folder = Path(out) if out else Places.of().cache / "site" / ("student" if student else "pages")
    address = (os.environ.get(BINDER, "") if binder is None else binder).rstrip("/")
    with without_slow_import():
        from course_pkg.site.build import write_site

        problems = write_site(Settings(folder, student, chapters, execute, address, pdf))
    if check:
        from course_pkg.site.check import faults

        problems += faults(folder)
    if pdf:
        from course_pkg.site.book import print_book

        sys.stdout.write(f"{print_book(folder)}\n")
    sys.stdout.write(f"{(folder / 'index.html').resolve()}\n")
    if problems:
        raise SiteError("\n".join(["the site is written, and not all is well:", *problems]))
    return 0


@contextmanager
def without_slow_import() -> Iterator[None]:
    """Have one module not be found meanwhile, unless it is imported already.

    jsonschema, which nbconvert brings along, looks for it and can do without. It compiles a grammar, which
    takes as long as a site.
    """
    given = SLOW in sys.modules
    if not given:
        sys.modules[SLOW] = None  # type: ignore[assignment]
    try:
        yield
    finally:
        if not given:
            del sys.modules[SLOW]
