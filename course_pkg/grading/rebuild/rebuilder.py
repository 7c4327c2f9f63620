"""Builds the notebook that is graded.

The graded notebook is the course's solution notebook (the reference) with a student's answers in the exercise
cells. The student's other cells are left out.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from course_pkg.authoring.cells import Notebook, exercise_of
from course_pkg.errors import GradingError
from course_pkg.grading.intake.reading import StudentCell, read_cells
from course_pkg.grading.rebuild.defusing import defuse
from course_pkg.grading.rebuild.matching import Match, Matching
from course_pkg.grading.rebuild.wanted import defined, every_wanted, used

NOTES = 40  # At most this many notes are given to a student.


@dataclass(frozen=True)
class Rebuilt:
    """The notebook that is graded; each exercise is either in `answers` or in `missing`."""

    notebook: Notebook  # The exercise cells have no outputs, so nbval does not compare their outputs.
    # `answers` contains the source that runs for each exercise; it can be the unchanged exercise cell.
    answers: Mapping[str, str]
    # `missing` contains the exercises without an answer; each value is the reason that the student sees.
    missing: Mapping[str, str] = field(default_factory=dict)
    untouched: frozenset[str] = frozenset()  # The student did not change the cells of these exercises.
    notes: tuple[str, ...] = ()  # Each note tells the student about something unusual in the notebook.
    problem: str = ""  # `problem` is the reason why the notebook could not be used.


def rebuild(reference: Notebook, content: bytes) -> Rebuilt:
    """Convert the submitted notebook `content` into the notebook that is graded, and return it.

    `reference` is a solution, as `authoring.notebook_store.read` returns it.
    """
    return Rebuilder(reference).rebuild(content)


class Rebuilder:
    """Puts students' answers into the solution notebook of a chapter; one object is used for all students.

    If an answer is missing, the graded notebook contains the unchanged exercise cell, never the solution. The
    other cells share their output objects with the solution notebook.
    """

    def __init__(self, reference: Notebook) -> None:
        self._reference = reference
        self._wanted = every_wanted(reference)
        self._blanks = {each.part: each.blank for each in self._wanted}
        self._given = {cell["id"]: cell["source"] for cell in reference["cells"] if not exercise_of(cell)}

    def rebuild(self, content: bytes) -> Rebuilt:
        """Convert the submitted notebook `content` into the notebook that is graded, and return it."""
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
    """Return a copy of the solution notebook `reference` in which the exercise cells contain `sources`.

    The exercise cells have no execution count, so nbval does not compare their outputs.
    """
    notebook = copy.copy(reference)
    notebook["cells"] = [copy.copy(cell) for cell in reference["cells"]]
    for cell in notebook["cells"]:
        if part := exercise_of(cell):
            cell["source"], cell["outputs"], cell["execution_count"] = sources[part], [], None
    return notebook


def _lent(cells: Sequence[StudentCell], matching: Matching, matches: Mapping[str, Match]) -> set[str]:
    """Return the names that the student defined only in cells that are not graded."""
    taken = frozenset(place for match in matches.values() for place in match.cells)
    names = matching.lent(taken) if len(taken) < len(cells) else set()
    for match in matches.values():
        names -= defined(match.source)
    return names


def _about_names(source: str, elsewhere: set[str]) -> Iterator[str]:
    if names := sorted(used(source) & elsewhere):
        shown = ", ".join(name[:40] for name in names[:3])
        yield (
            f"This cell uses {shown}, which you define in a different cell. Only the exercise's "
            "cell is graded, so write all the code of the answer into this cell."
        )
