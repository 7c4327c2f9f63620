"""The progress as CSV: a row for each part, each prediction and each set of choices."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from io import StringIO

from course_pkg.overview.model import ChapterProgress, Progress
from course_pkg.panels.prediction.model import Prediction

HEAD = (
    *("chapter", "title", "kind", "id", "text", "state", "points", "possible"),
    *("checks", "last_result", "last_time", "first_passed"),
)
# A spreadsheet program would run a cell that begins with one of these characters as a formula.
FORMULA = ("=", "+", "-", "@")


def table(progress: Progress) -> str:
    """Return the table as CSV text. Times are ISO 8601 in UTC.

    A cell is empty if its column does not apply to the row.
    """
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEAD)
    for chapter in progress.chapters:
        for row in _rows(chapter):
            writer.writerow([_cell(value) for value in (chapter.number, chapter.title, *row)])
    return text.getvalue()


def _rows(chapter: ChapterProgress) -> Iterator[tuple[str | float, ...]]:
    for part in chapter.parts:
        record = part.record
        details = (
            (record.checks, record.verdict, record.checked, record.passed) if record else (0, "", "", "")
        )
        yield ("part", part.check, part.goal, part.state, part.earned, part.possible, *details)
    for each in chapter.predictions:
        time = each.compared or each.answered
        yield ("prediction", each.key, each.question, _state(each), "", "", "", "", time, "")
    for choice in chapter.choices:
        state = f"{choice.fit} of {len(choice.first)} right" if choice.compared else "open"
        yield ("choices", choice.key, choice.question, state, "", "", "", "", choice.compared, "")


def _state(prediction: Prediction) -> str:
    if not prediction.compared:
        return "open"
    if not prediction.first:
        return "not predicted"
    return "right" if prediction.right else "wrong"


def _cell(value: str | float) -> str | float:
    """Return the value without line breaks.

    If a spreadsheet could read the text as a formula, add a quote before it.
    """
    if isinstance(value, (int, float)):
        return value
    line = " ".join(value.split())
    return f"'{line}" if line.startswith(FORMULA) else line
