"""What a site is asked to be."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple


class Settings(NamedTuple):
    """What `course site` was told.

    `out` is the folder to write to. With `student`, the pages show the notebooks that students get, otherwise
    the solutions. `chapters` are those to be run if need be; the others are shown as they ran last, and so
    are all with `execute` off. `binder` is the address that opens the repository, without the query. With
    `book`, all chapters stand in one page, too.
    """

    out: Path
    student: bool = False
    chapters: tuple[str, ...] = ()
    execute: bool = True
    binder: str = ""
    book: bool = False
