"""Checks that the files for grading exist: the solution and the fixtures of each chapter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from course_pkg.authoring.notebook_store import NotebookStore
from course_pkg.checking.parts import chapters, folder_of, notebook_of
from course_pkg.errors import GradingError

SHOWN = 3  # SHOWN is the maximum number of names in the message.


def require_references(asked: Sequence[str] = (), root: Path | None = None) -> None:
    """Raise GradingError if the solution or the fixtures of a chapter in `asked` are missing.

    By default, the files of all chapters are checked. Grading compares a submission with all solutions to
    find its chapter. Without the solution of a chapter, submissions for this chapter would therefore get no
    points. `root` is the checkout.
    """
    missing = list(_missing(asked or chapters(), NotebookStore(root).root))
    if missing:
        more = f" and {len(missing) - SHOWN} more" if len(missing) > SHOWN else ""
        raise GradingError(
            "Nothing was graded, because these files are missing: "
            f"{', '.join(missing[:SHOWN])}{more}. Without these files, students would get 0 points. "
            "Get the files from the course's repository, or grade other chapters with --chapters."
        )


def _missing(wanted: Sequence[str], root: Path) -> Iterator[str]:
    for chapter in sorted(set(wanted) & set(chapters())):  # Another function reports unknown chapters.
        fixtures = Path("course_pkg", "chapters", folder_of(chapter).name, "fixtures.py")
        for path in (Path("solutions", notebook_of(chapter)), fixtures):
            if not (root / path).is_file():
                yield str(path)
