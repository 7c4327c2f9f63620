"""The reference notebook with a student's answers in it, and nothing else of the student's."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from course_pkg.authoring.cells import Notebook, exercise_of
from course_pkg.errors import GradingError
from course_pkg.grading.defusing import defuse
from course_pkg.grading.matching import Match, Matching
from course_pkg.grading.reading import StudentCell, read_cells
from course_pkg.grading.wanted import defined, every_wanted, used

NOTES = 40  # more than these say nothing new


@dataclass(frozen=True)
class Rebuilt:
    """What of a notebook is graded; every part of the reference is in `answers` or in `missing`."""

    notebook: Notebook  # no output of an exercise's cell in it, and none is compared
    answers: Mapping[str, str]  # by part; the source that is run, which may be the one that was handed out
    missing: Mapping[str, str] = field(default_factory=dict)  # by part: why it has no answer, for the student
    untouched: frozenset[str] = frozenset()  # parts in `answers` that are as they were handed out
    notes: tuple[str, ...] = ()  # what was out of the ordinary, for the student
    problem: str = ""  # why nothing could be taken from it


def rebuild(reference: Notebook, content: bytes) -> Rebuilt:
    """Return the notebook that is run and graded for a student who handed in `content`.

    `reference` is a solution, as `authoring.shelf.read` reads it.
    """
    return Rebuilder(reference).rebuild(content)


class Rebuilder:
    """One reference, for as many students as there are.

    Where an answer is missing the cell is as it was handed out: no solution is left in the notebook in place
    of an answer. What is rebuilt shares the outputs of the given cells with the reference.
    """

    def __init__(self, reference: Notebook) -> None:
        self._reference = reference
        self._wanted = every_wanted(reference)
        self._blanks = {each.part: each.blank for each in self._wanted}
        self._given = {cell["id"]: cell["source"] for cell in reference["cells"] if not exercise_of(cell)}

    def rebuild(self, content: bytes) -> Rebuilt:
        """Return what is graded of the notebook `content`."""
        try:
            cells = read_cells(content)
        except GradingError as error:
            problem = f"The notebook could not be read: {error}."
            missing = dict.fromkeys(self._blanks, problem)
            return Rebuilt(_placed(self._reference, self._blanks), {}, missing, problem=problem)
        matching = Matching(cells, self._wanted, self._given)
        matches = {each.part: matching.match(each) for each in self._wanted}
        return self._rebuilt(matches, _lent(cells, matching, matches))

    def _rebuilt(self, matches: Mapping[str, Match], elsewhere: set[str]) -> Rebuilt:
        answers, missing, untouched, notes = {}, {}, set(), []
        for each in self._wanted:
            match = matches[each.part]
            about = list(match.notes)
            if match.missing:
                missing[each.part] = match.missing
                about.append(match.missing)
            elif each.is_blank(match.source):
                answers[each.part] = each.blank
                untouched.add(each.part)
            else:
                made = defuse(match.source, each.first_line)
                answers[each.part] = made.source
                about += [*made.notes, *_about_names(made.source, elsewhere)]
            notes += [f"{each.part}: {note}" for note in about]
        notebook = _placed(self._reference, {**self._blanks, **answers})
        return Rebuilt(notebook, answers, missing, frozenset(untouched), tuple(notes[:NOTES]))


def _placed(reference: Notebook, sources: Mapping[str, str]) -> Notebook:
    """Return the reference with these sources; nbval compares no output of a cell that has no number."""
    notebook = copy.copy(reference)
    notebook["cells"] = [copy.copy(cell) for cell in reference["cells"]]
    for cell in notebook["cells"]:
        if part := exercise_of(cell):
            cell.update(source=sources[part], outputs=[], execution_count=None)
    return notebook


def _lent(cells: Sequence[StudentCell], matching: Matching, matches: Mapping[str, Match]) -> set[str]:
    """Return the names that an answer might take from cells that are not graded."""
    taken = frozenset(place for match in matches.values() for place in match.cells)
    names = matching.lent(taken) if len(taken) < len(cells) else set()
    for match in matches.values():
        names -= defined(match.source)
    return names


def _about_names(source: str, elsewhere: set[str]) -> Iterator[str]:
    if names := sorted(used(source) & elsewhere):
        shown = ", ".join(name[:40] for name in names[:3])
        yield (
            f"It names {shown}, which a cell of your own defines. Only the exercise's cell is graded: "
            "what the answer needs has to stand in it."
        )
