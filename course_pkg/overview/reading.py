"""Reads the progress of a student: the record of the checks, the predictions, and the choices."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from course_pkg.checking.parts import chapters as all_chapters
from course_pkg.checking.parts import notebook_of, parts_of, title_of
from course_pkg.checking.record import StudentRecord
from course_pkg.errors import InvalidPredictions
from course_pkg.overview.model import ChapterProgress, LearningPath, PartProgress, Progress
from course_pkg.panels.choices.model import ChoiceRecord, ChoiceStore
from course_pkg.panels.prediction.model import Prediction, PredictionStore
from course_pkg.panels.store import of_chapter
from course_pkg.setup import Places
from course_pkg.setup.edition import released_chapters

PATHS = Path(__file__).parents[1] / "chapters" / "paths.json"


def read_progress(chapters: Sequence[str] = ()) -> Progress:
    """Return the progress in the given chapters, such as ["05"], or in all chapters.

    An unreadable record is left out, and `problems` contains a message about it. Raises UnknownCheck if there
    is no such chapter.
    """
    parts = {number: parts_of(number) for number in chapters or _present()}
    records, message = StudentRecord().read(part.check for each in parts.values() for part in each)
    predictions, choices, problems = _answers()
    found = [
        ChapterProgress(
            number,
            title_of(number),
            notebook_of(number),
            tuple(PartProgress(part.check, part.goal, part.points, records.get(part.check)) for part in each),
            tuple(of_chapter(predictions, number)),
            tuple(of_chapter(choices, number)),
        )
        for number, each in parts.items()
    ]
    return Progress(tuple(found), learning_paths(), tuple(filter(None, (message, *problems))))


def _present() -> Sequence[str]:
    """Return all chapters; in the students' edition, return only the released chapters."""
    released = released_chapters(Places.of().checkout)
    return [number for number in all_chapters() if released is None or number in released]


def learning_paths() -> tuple[LearningPath, ...]:
    """Return the paths through the course.

    A learning path with two possible last chapters is returned twice, once for each last chapter.
    """
    every = tuple(all_chapters())
    text = PATHS.read_text("utf-8")
    return tuple(
        LearningPath(path["name"], (*path["chapters"], *end) or every)
        for path in json.loads(text)
        for end in path["ends"] or [[]]
    )


def _answers() -> tuple[list[Prediction], list[ChoiceRecord], list[str]]:
    """Return the predictions, the choices, and messages about files that cannot be read."""
    predictions: list[Prediction] = []
    choices: list[ChoiceRecord] = []
    problems: list[str] = []
    try:
        predictions = list(PredictionStore().read().values())
    except InvalidPredictions as error:
        problems.append(str(error))
    try:
        choices = list(ChoiceStore().read().values())
    except InvalidPredictions as error:
        problems.append(str(error))
    return predictions, choices, problems
