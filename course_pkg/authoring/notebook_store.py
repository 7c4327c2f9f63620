"""The solutions, which authors write, and the students' notebooks, which are derived from the solutions."""

from __future__ import annotations

import copy
import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import nbformat
from nbformat.v4.rwbase import rejoin_lines

import course_pkg
from course_pkg.authoring.blank import handed_out
from course_pkg.authoring.cells import Notebook, code_cells, exercise_of
from course_pkg.authoring.lint import problems
from course_pkg.authoring.normalise import strip, tidy
from course_pkg.errors import AuthoringError


class NotebookStore:
    """The notebooks of one checkout."""

    def __init__(self, root: Path | None = None) -> None:
        self.root = root or Path(course_pkg.__file__).resolve().parent.parent

    def solutions(self, chapters: Sequence[str] = ()) -> list[Path]:
        """Return the paths of the solutions of the given chapters, such as ["05"], or of all chapters.

        Raises AuthoringError if a chapter has no solution.
        """
        found = sorted((self.root / "solutions").glob("[0-9][0-9]_*.ipynb"))
        unknown = set(chapters) - {path.name[:2] for path in found}
        if unknown:
            raise AuthoringError(f"There is no solution for chapter {', '.join(sorted(unknown))}.")
        return [path for path in found if not chapters or path.name[:2] in chapters]

    def stale(self) -> Iterator[tuple[Path, str]]:
        """Yield each file that is out of date, and the text that it should have."""
        for path in self.solutions():
            solution = read(path)
            tidy(solution)
            yield from _if_different(path, text_of(solution))
            yield from _if_different(self.root / "notebooks" / path.name, text_of(derived(solution)))

    def orphans(self) -> list[Path]:
        """Return the students' notebooks for which there is no solution."""
        names = {path.name for path in self.solutions()}
        derived = sorted((self.root / "notebooks").glob("[0-9][0-9]_*.ipynb"))
        return [path for path in derived if path.name not in names]

    def problems(self) -> list[str]:
        """Return the problems of all solutions; each message contains the notebook's name and the cell."""
        return [text for path in self.solutions() for text in problems(path.stem, read(path))]


def sync(*, check: bool = False, root: Path | None = None) -> int:
    """Normalise the solutions, derive the students' notebooks from the solutions, and return 0.

    If `check` is True, write nothing, and raise AuthoringError with a list of the outdated files. Raises
    AuthoringError with a list of all problems if a solution has problems.
    """
    store = NotebookStore(root)
    stale, orphans = list(store.stale()), store.orphans()
    if check and (stale or orphans):
        names = [str(path.relative_to(store.root)) for path, _ in stale] + [str(path) for path in orphans]
        raise AuthoringError("\n".join(["These files are out of date; type `course sync`:", *names]))
    for path, text in stale:
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, "utf-8")
        sys.stdout.write(f"wrote {path.relative_to(store.root)}\n")
    for path in orphans:
        path.unlink()
        sys.stdout.write(f"removed {path.relative_to(store.root)}, because it has no solution\n")
    if found := store.problems():
        raise AuthoringError("\n".join(["The solutions have problems; correct them:", *found]))
    return 0


def derived(solution: Notebook) -> Notebook:
    """Return the student's notebook, without outputs and with blank exercise cells."""
    notebook = copy.deepcopy(solution)
    strip(notebook)
    for cell in code_cells(notebook):
        if exercise := exercise_of(cell):
            cell["source"] = _blanked(cell["id"], exercise, cell["source"])
    return notebook


def read(path: Path) -> Notebook:
    """Return the notebook at the path `path`; each text in it is one string.

    Raises AuthoringError if the file cannot be read, or is not a notebook of format 4.
    """
    try:
        data = json.loads(path.read_text("utf-8"))
        # nbformat.reads would change an invalid notebook without a message.
        notebook: Notebook = rejoin_lines(nbformat.from_dict(data))
    except (OSError, ValueError, TypeError, AttributeError, KeyError) as error:
        raise AuthoringError(f"{path.name} is not a notebook: {error!r}") from error
    if notebook.get("nbformat") != 4:
        raise AuthoringError(
            f"{path.name} does not have the notebook format 4. Open it in a current JupyterLab, and save it."
        )
    return notebook


def text_of(notebook: Notebook) -> str:
    """Return the content of a notebook's file. Raises AuthoringError if the format is invalid."""
    try:
        nbformat.validate(notebook)
    except nbformat.ValidationError as error:
        raise AuthoringError(f"The format of the notebook is invalid: {error.message}") from error
    return str(nbformat.writes(nbformat.from_dict(notebook))).rstrip("\n") + "\n"


def _if_different(path: Path, text: str) -> Iterator[tuple[Path, str]]:
    if not path.exists() or path.read_bytes() != text.encode():
        yield path, text


def _blanked(cell: str, exercise: str, source: str) -> str:
    try:
        return handed_out(exercise, source)
    except AuthoringError as error:
        raise AuthoringError(f"cell {cell}: {error}") from error
