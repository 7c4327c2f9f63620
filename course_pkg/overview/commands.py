"""The command `course progress`: prints the progress, or writes it to files."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.errors import ExportFailed
from course_pkg.setup.commands import Command

if TYPE_CHECKING:
    from argparse import ArgumentParser


def _progress(options: SimpleNamespace) -> int:
    """Print the progress, or write it to the files that the options name."""
    from course_pkg.overview.notebook import progress
    from course_pkg.overview.page import page
    from course_pkg.overview.table import table

    overview = progress(options.chapter or "")
    for name, content in ((options.csv, table), (options.html, page)):
        if name:
            _write(Path(name), content(overview.progress))
    if not options.csv and not options.html:
        sys.stdout.write(f"{overview}\n")
    return 0


def _write(path: Path, content: str) -> None:
    from course_pkg.files import write_atomically

    try:
        write_atomically(path, content)
    except OSError as error:
        raise ExportFailed(
            f"{path} cannot be written ({error.strerror}). Choose a file in a folder that you can write to."
        ) from error
    sys.stdout.write(f"{path.resolve()}\n")


def _arguments(parser: ArgumentParser) -> None:
    parser.add_argument("chapter", nargs="?", metavar="CHAPTER", help="show only this chapter, such as 05")
    parser.add_argument("--csv", metavar="FILE", help="write a table of parts and predictions to FILE")
    parser.add_argument(
        "--html", metavar="FILE", help=("write a web page to FILE; the page needs no other files")
    )


COMMANDS = {
    "progress": Command(
        "show which parts you have passed, and what is next; this is not a grade",
        _progress,
        frozenset({"course", "libraries"}),
        _arguments,
    )
}
