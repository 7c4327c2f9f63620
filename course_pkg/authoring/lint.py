"""Finds the problems of a solution notebook; each message contains the names of the notebook and the cell."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from course_pkg.authoring.blank import handed_out
from course_pkg.authoring.cells import Notebook, check_of, code_cells, exercise_of, may_raise, points_of
from course_pkg.checking.parts import Part, chapters, parts_of
from course_pkg.errors import AuthoringError


def problems(name: str, notebook: Notebook) -> list[str]:
    """Return every problem of the solution `name`, such as "05_write_a_server"."""
    chapter = name.partition("_")[0]
    parts = {part.check: part for part in parts_of(chapter)} if chapter in chapters() else {}
    found = [*_pairs(notebook), *_exercises(notebook, parts), *_errors(notebook)]
    missing = sorted(parts.keys() - {exercise_of(cell) for cell in code_cells(notebook)})
    found += [("", f"part {part} is declared in the checks, but it has no exercise cell") for part in missing]
    return [f"{name}, cell {cell}: {text}" if cell else f"{name}: {text}" for cell, text in found]


def _pairs(notebook: Notebook) -> Iterator[tuple[str, str]]:
    """Yield an error for each exercise cell without a check cell, and for each id that is used twice."""
    exercises: list[str] = []
    checks: list[str] = []
    for cell in notebook["cells"]:
        exercise, check = exercise_of(cell), check_of(cell)
        if (exercise or check) and cell["cell_type"] != "code":
            yield cell["id"], "only a code cell can be an exercise or a check"
        if exercise in exercises or check in checks:
            yield (
                cell["id"],
                (f"an earlier cell already has the id {exercise or check}; each id must be unique"),
            )
        if check and check not in exercises:
            yield cell["id"], f"check {check} has no exercise cell above it"
        if check and f'check("{check}")' not in cell["source"]:
            yield cell["id"], f'the cell does not call check("{check}")'
        exercises += [exercise] if exercise else []
        checks += [check] if check else []
    for exercise in sorted(set(exercises) - set(checks)):
        yield f"exercise-{exercise.replace('.', '-')}", f"exercise {exercise} has no check cell"


def _exercises(notebook: Notebook, parts: Mapping[str, Part]) -> Iterator[tuple[str, str]]:
    """Yield an error for each exercise without points, without a check, or without an answer."""
    for cell in code_cells(notebook):
        if not (exercise := exercise_of(cell)):
            continue
        points = points_of(cell)
        if points is None:
            example = f'{{"exercise": "{exercise}", "points": 2}}'
            yield cell["id"], f"exercise {exercise} has no points; write {example} into the cell's metadata"
        if exercise not in parts:
            yield cell["id"], f"no check is declared for {exercise}"
        elif points is not None and points != parts[exercise].points:
            yield (
                cell["id"],
                f"the cell has {points} points and its check has {parts[exercise].points}; make them equal",
            )
        try:
            given = handed_out(exercise, cell["source"])
            if given.strip() == cell["source"].strip():
                yield cell["id"], "this exercise contains no answer that can be removed"
            elif given.startswith("%%") and _first(given) != _first(cell["source"]):
                yield (
                    cell["id"],
                    (f"the check gives students a cell that begins with a different line: {_first(given)}"),
                )
        except AuthoringError as error:
            yield cell["id"], str(error)


def _first(source: str) -> str:
    return source.partition("\n")[0]


def _errors(notebook: Notebook) -> Iterator[tuple[str, str]]:
    """Yield an error for each cell that shows an error but has no tag `raises-exception`."""
    for cell in code_cells(notebook):
        for output in cell["outputs"]:
            if output["output_type"] == "error" and not may_raise(cell):
                words = f"{output['ename']}: {output['evalue']}"
                yield (
                    cell["id"],
                    (
                        f"the cell raises {words}; if the cell should raise this error, add the tag "
                        "raises-exception"
                    ),
                )
