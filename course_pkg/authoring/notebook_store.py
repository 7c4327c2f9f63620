"""The solutions, which authors write, and the notebooks, which are derived from them."""

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
        """Return the solutions of `chapters`, such as ["05"], or all of them."""
        found = sorted((self.root / "solutions").glob("[0-9][0-9]_*.ipynb"))
        unknown = set(chapters) - {path.name[:2] for path in found}
        if unknown:
            raise AuthoringError(f"There is no solution for chapter {', '.join(sorted(unknown))}.")
        return [path for path in found if not chapters or path.name[:2] in chapters]

    def stale(self) -> Iterator[tuple[Path, str]]:
        """Yield each file that is not what it has to be, and the text that it has to hold."""
        for path in self.solutions():
            solution = read(path)
            tidy(solution)
            yield from _if_different(path, text_of(solution))
            yield from _if_different(self.root / "notebooks" / path.name, text_of(derived(solution)))

    def orphans(self) -> list[Path]:
        """Return the notebooks whose solution is gone."""
        names = {path.name for path in self.solutions()}
        derived = sorted((self.root / "notebooks").glob("[0-9][0-9]_*.ipynb"))
        return [path for path in derived if path.name not in names]

    def problems(self) -> list[str]:
        """Return what is wrong with the solutions themselves."""
        return [text for path in self.solutions() for text in problems(path.stem, read(path))]


def sync(*, check: bool = False, root: Path | None = None) -> int:
    """Bring solutions and notebooks into step, or with `check` only say what is out of step.

    Return 0 when nothing was out of step and nothing is wrong; raise AuthoringError with the whole list
    otherwise.
    """
    store = NotebookStore(root)
    stale, orphans = list(store.stale()), store.orphans()
    if check and (stale or orphans):
        names = [str(path.relative_to(store.root)) for path, _ in stale] + [str(path) for path in orphans]
        raise AuthoringError("\n".join(["out of step; type `course sync`:", *names]))
    for path, text in stale:
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, "utf-8")
        sys.stdout.write(f"wrote {path.relative_to(store.root)}\n")
    for path in orphans:
        path.unlink()
        sys.stdout.write(f"removed {path.relative_to(store.root)}, which has no solution\n")
    if found := store.problems():
        raise AuthoringError("\n".join(["the solutions need a hand:", *found]))
    return 0


def derived(solution: Notebook) -> Notebook:
    """Return what a student gets: no outputs, and no answers in the exercise cells."""
    notebook = copy.deepcopy(solution)
    strip(notebook)
    for cell in code_cells(notebook):
        if exercise := exercise_of(cell):
            cell["source"] = _blanked(cell["id"], exercise, cell["source"])
    return notebook


def read(path: Path) -> Notebook:
    """Return the notebook at `path`, its texts joined."""
    try:
        data = json.loads(path.read_text("utf-8"))
        notebook: Notebook = rejoin_lines(nbformat.from_dict(data))  # nbformat.reads would repair it unasked
    except (OSError, ValueError, TypeError, AttributeError, KeyError) as error:
        raise AuthoringError(f"{path.name} is not a notebook: {error!r}") from error
    if notebook.get("nbformat") != 4:
        raise AuthoringError(
            f"{path.name} is a notebook of another format: save it with a front end of today."
        )
    return notebook


def text_of(notebook: Notebook) -> str:
    """Return the file that holds `notebook`; raise AuthoringError when no front end would read it."""
    try:
        nbformat.validate(notebook)
    except nbformat.ValidationError as error:
        raise AuthoringError(f"The notebook breaks the format: {error.message}") from error
    return str(nbformat.writes(nbformat.from_dict(notebook))).rstrip("\n") + "\n"


def _if_different(path: Path, text: str) -> Iterator[tuple[Path, str]]:
    if not path.exists() or path.read_bytes() != text.encode():
        yield path, text


def _blanked(cell: str, exercise: str, source: str) -> str:
    try:
        return handed_out(exercise, source)
    except AuthoringError as error:
        raise AuthoringError(f"cell {cell}: {error}") from error
