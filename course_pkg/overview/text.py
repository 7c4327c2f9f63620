"""The progress as text, for a terminal or a notebook without HTML."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence

from course_pkg.overview.model import NO_GRADE, ChapterProgress, Progress
from course_pkg.overview.steps import Step, next_steps

WIDTH = 100
LEGEND = "✓ passed   ✗ checked, not passed yet   · not checked"


def headline(progress: Progress, chapter: str = "") -> str:
    """Return one line with the totals of all chapters, or of the chapter `chapter`."""
    counted = f"{of(progress.passed)} parts passed, {of(progress.points)} points"
    answered = ((progress.right, "predictions right"), (progress.chosen, "choices right"))
    counted += "".join(f", {of(pair)} {what}" for pair, what in answered if pair[1])
    whose = f"Chapter {chapter}, {progress.chapters[0].title}" if chapter else "Your progress"
    return f"{whose}: {counted}"


def overview_text(progress: Progress) -> str:
    """Return a text with one line for each chapter, and the next steps."""
    rows = [["", "Chapter", "", "Parts", "Points", "Predictions"], *map(_row, progress.chapters)]
    steps = next_steps(progress)
    lines = [headline(progress), "", *_columns(rows), "", LEGEND, *_steps(steps), *_end(progress)]
    return "\n".join(lines)


def chapter_text(progress: Progress, steps: Sequence[Step]) -> str:
    """Return a text with one line for each part of a chapter, and the next steps."""
    chapter = progress.chapters[0]
    rows = [
        line
        for part in chapter.parts
        for line in _wrapped(
            f"  {part.mark} {part.check:<6}{part.state:<15}{part.earned:g} of {part.possible}  ", part.goal
        )
    ]
    lines = [headline(progress, chapter.number), *rows, *_steps(steps), *_end(progress)]
    return "\n".join(lines)


def of(pair: tuple[float, float]) -> str:
    """Return a pair of numbers as text; (3, 5) becomes "3 of 5"."""
    return f"{pair[0]:g} of {pair[1]:g}"


def answers(chapter: ChapterProgress) -> str:
    """Return the numbers of correct predictions and choices of a chapter as text.

    Return "" if the student has compared no predictions and no choices.
    """
    predicted = of(chapter.right) if chapter.right[1] else ""
    chosen = f"{of(chapter.chosen)} choices" if chapter.chosen[1] else ""
    return ", ".join(filter(None, (predicted, chosen)))


def _row(chapter: ChapterProgress) -> list[str]:
    marks = "".join(part.mark for part in chapter.parts)
    parts = f"{chapter.passed} of {len(chapter.parts)}"
    return [chapter.number, chapter.title, marks, parts, of(chapter.points), answers(chapter)]


def _columns(rows: list[list[str]]) -> Iterator[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=True)]
        yield ("  " + "  ".join(cells)).rstrip()


def _steps(steps: Sequence[Step]) -> Iterator[str]:
    yield ""
    for number, step in enumerate(steps):
        label = "Next: " if number == 0 else "or:   "
        yield from _wrapped(label, step.text)
        if step.notebook:
            yield f"      in {step.notebook}"


def _end(progress: Progress) -> Iterator[str]:
    for problem in progress.problems:
        yield from ("", *_wrapped("Problem: ", problem))
    yield NO_GRADE


def _wrapped(label: str, text: str) -> list[str]:
    """Return the label and the text in lines of at most `WIDTH` characters.

    All lines after the first line are indented.
    """
    space = " " * len(label)
    return textwrap.wrap(
        text, WIDTH, initial_indent=label, subsequent_indent=space, break_on_hyphens=False
    ) or [label.rstrip()]
