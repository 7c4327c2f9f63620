"""Finds the cells of a student's notebook that answer an exercise, even if they were moved or copied.

The cell of an exercise is found by its id. A copied cell has a new id, so the course also searches for the
exercise in the metadata of cells. If no cell has the right id or metadata, the course searches for a cell
that defines the right names or writes the right file. If several cells are found, the last non-blank cell is
used. If the student has split the answer into several cells, the cells directly below the found cell also
belong to the answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from course_pkg.grading.intake.reading import StudentCell
from course_pkg.grading.rebuild.defusing import TAGS
from course_pkg.grading.rebuild.wanted import Wanted, defined, lent, used, written_path

LONGEST = 100_000  # An answer may have at most this many characters.
BELOW = 50  # At most this many cells below an exercise can be part of the answer.


@dataclass(frozen=True)
class Match:
    """The answer to an exercise, or the reason why there is no answer."""

    source: str = ""
    missing: str = ""
    notes: tuple[str, ...] = ()
    cells: frozenset[int] = frozenset()  # `cells` contains the indices of the answer's cells in the notebook.


@dataclass(frozen=True)
class _Run:
    """Consecutive cells that form one answer."""

    source: str
    kind: str
    cells: frozenset[int]
    tags: frozenset[str]
    written: int  # `written` is the number of non-empty cells.


class Matching:
    """Compares a student's cells with the exercises of a chapter."""

    def __init__(
        self, cells: Sequence[StudentCell], wanted: Sequence[Wanted], given: Mapping[str, str]
    ) -> None:
        """`given` contains the sources of the solution notebook's cells that are not exercises.

        The keys of `given` are the ids of the cells.
        """
        self._cells = cells
        self._given = given
        self._texts = {source.strip() for source in given.values()}
        ids, parts = {each.cell: each.part for each in wanted}, {each.part for each in wanted}
        self._owners = [
            ids.get(cell.id) or (cell.exercise if cell.exercise in parts else "") for cell in cells
        ]
        self._places: dict[str, list[int]] = {}
        for place, owner in enumerate(self._owners):
            self._places.setdefault(owner, []).append(place)
        self._own = {place for place in self._places.get("", []) if self._is_own(place)}

    def match(self, wanted: Wanted) -> Match:
        """Return the answer to one exercise."""
        runs = list(self._runs(wanted))
        filled = [run for run in runs if run.source.strip() and not wanted.is_blank(run.source)]
        code = [run for run in filled if run.kind == "code"]
        if chosen := code or filled:
            return _matched(chosen)
        if elsewhere := list(self._elsewhere(wanted)):
            note = (
                f"The original cell of the exercise contains no answer. The cell that {_known_by(wanted)} "
                "was used instead."
            )
            match = _matched(elsewhere)
            return Match(match.source, match.missing, (note, *match.notes), match.cells)
        if any(run.source.strip() for run in runs):
            return Match(wanted.blank, cells=frozenset().union(*(run.cells for run in runs)))
        if runs:
            return Match(missing="The exercise's cell is empty.")
        return Match(
            missing=f"The exercise's cell is not in the notebook, and no other cell {_known_by(wanted)}."
        )

    def lent(self, taken: frozenset[int]) -> set[str]:
        """Return the names that the student defined in cells that belong to no answer."""
        names: set[str] = set()
        for place, cell in enumerate(self._cells):
            if place not in taken and cell.kind == "code" and not self._owners[place]:
                names |= lent(cell.source) if self._given.get(cell.id) != cell.source else set()
        for source in self._given.values():
            names -= defined(source)
        return names

    def _is_own(self, place: int) -> bool:
        """Return whether the student added the cell: the course's notebook does not contain this cell."""
        cell = self._cells[place]
        return not (cell.check or cell.id in self._given or cell.source.strip() in self._texts)

    def _runs(self, wanted: Wanted) -> Iterator[_Run]:
        """Yield the possible answers to the exercise.

        A possible answer is one cell, or several consecutive cells if the student split the answer.
        """
        run: list[int] = []
        above = _Above()
        for place in self._places.get(wanted.part, []):
            cell = self._cells[place]
            if run and not (place == run[-1] + 1 and above.goes_on(cell, wanted)):
                yield self._run([*run, *self._rest(run[-1], above, wanted)])
                run, above = [], _Above()
            run.append(place)
            above.add(cell)
        if run:
            yield self._run([*run, *self._rest(run[-1], above, wanted)])

    def _rest(self, last: int, above: _Above, wanted: Wanted) -> list[int]:
        """Return the indices of the cells below the cell `last` that belong to the answer."""
        taken: list[int] = []
        pending: list[int] = []
        for place in range(last + 1, min(last + 1 + BELOW, len(self._cells))):
            cell = self._cells[place]
            if place not in self._own or cell.kind != "code":
                break
            pending.append(place)
            if above.needs(cell.source, wanted):
                above.add(*(self._cells[each] for each in pending))
                taken, pending = [*taken, *pending], []
        return taken

    def _elsewhere(self, wanted: Wanted) -> Iterator[_Run]:
        for place in sorted(self._own):
            cell = self._cells[place]
            if cell.kind == "code" and _answers(cell.source, wanted) and not wanted.is_blank(cell.source):
                yield self._run([place])

    def _run(self, places: Sequence[int]) -> _Run:
        cells = [self._cells[place] for place in places]
        written = [cell.source for cell in cells if cell.source.strip()]
        tags = frozenset(tag for cell in cells for tag in cell.tags)
        return _Run("\n".join(written), cells[0].kind, frozenset(places), tags, len(written))


class _Above:
    """The cells that are already part of an answer, and the names, words and lines in these cells."""

    def __init__(self) -> None:
        self._last = StudentCell("", "", "")
        self._names: set[str] = set()
        self._words: set[str] = set()
        self._lines: set[str] = set()

    def add(self, *cells: StudentCell) -> None:
        """Add cells to the answer."""
        for cell in cells:
            self._last = cell
            self._names |= defined(cell.source)
            self._words |= used(cell.source)
            self._lines |= {line.strip() for line in cell.source.splitlines()}

    def goes_on(self, cell: StudentCell, wanted: Wanted) -> bool:
        """Return whether a cell of the same exercise continues this answer.

        A cell that only repeats the answer is not a continuation.
        """
        if cell.kind != self._last.kind or cell.source == self._last.source or wanted.is_blank(cell.source):
            return False
        anew = defined(cell.source) & self._names & wanted.names
        return not (anew or cell.source.lstrip().startswith("%%"))

    def needs(self, source: str, wanted: Wanted) -> bool:
        """Return whether a cell that the student added belongs to this answer."""
        lines = [line for line in source.splitlines() if line.strip()]
        if not lines or source.lstrip().startswith(("%%", "!")):
            return False
        if any(line.strip() in wanted.wiring - self._lines for line in lines):
            return True
        if wanted.path:
            return False
        missing = (self._words - self._names) & lent(source)
        return bool(lines[0][0].isspace() or defined(source) & wanted.names or missing)


def _matched(runs: Sequence[_Run]) -> Match:
    """Return the last of the possible answers to an exercise, with notes for the student."""
    chosen = runs[-1]
    notes = []
    if len({run.source.strip() for run in runs}) > 1:
        notes.append(f"{len(runs)} cells answer this exercise. Only the last of these cells was used.")
    if chosen.written > 1:
        notes.append(f"The answer was in {chosen.written} cells. These cells were joined.")
    if chosen.kind != "code":
        notes.append("The exercise's cell is not a code cell, but its text was used as code.")
    if len(chosen.source) > LONGEST:
        return Match(
            missing=f"The exercise's cell contains more than {LONGEST} characters.", notes=tuple(notes)
        )
    return Match(chosen.source, "", (*notes, *_about_tags(chosen.tags)), chosen.cells)


def _about_tags(tags: frozenset[str]) -> list[str]:
    found = sorted(tags & set(TAGS))
    return [f"The tag {', '.join(found)} on the exercise's cell does not change the grade."] if found else []


def _answers(source: str, wanted: Wanted) -> bool:
    if wanted.path:
        return written_path(source) == wanted.path
    return bool(wanted.names) and wanted.names <= defined(source)


def _known_by(wanted: Wanted) -> str:
    return f"writes {wanted.path}" if wanted.path else f"defines {' and '.join(sorted(wanted.names))}"
