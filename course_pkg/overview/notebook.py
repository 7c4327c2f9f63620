"""The functions that notebooks call: `progress()`, and `predictions("05")` at the end of a chapter."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.errors import UnknownCheck
from course_pkg.overview.markup import chapter_output, overview_output
from course_pkg.overview.model import Progress
from course_pkg.overview.reading import read_progress
from course_pkg.overview.steps import Step, next_steps
from course_pkg.overview.text import chapter_text, headline, overview_text
from course_pkg.panels.prediction.view import ChapterRow, Predictions


@dataclass(frozen=True)
class Overview:
    """The progress in one chapter or in all chapters, as text and as HTML."""

    progress: Progress
    chapter: str
    steps: list[Step]

    def __str__(self) -> str:
        return chapter_text(self.progress, self.steps) if self.chapter else overview_text(self.progress)

    __repr__ = __str__

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        html = chapter_output(self.progress, self.steps) if self.chapter else overview_output(self.progress)
        return {"text/plain": str(self), "text/html": html}


def progress(chapter: str = "") -> Overview:
    """Return your progress and the next steps, for the whole course or for one chapter, such as "05".

    The overview shows your own record of the checks, the predictions and the choices. You can change this
    record, so it is never a grade. Raises UnknownCheck if there is no such chapter.
    """
    every = read_progress()
    if not chapter:
        return Overview(every, "", next_steps(every))
    number = str(chapter).zfill(2)
    one = every.only(number)
    if not one.chapters:
        known = f"{every.chapters[0].number} to {every.chapters[-1].number}"
        raise UnknownCheck(
            f"There is no chapter {chapter!r}. Give a number from {known}, such as progress('05')."
        )
    return Overview(one, number, next_steps(every, number))


def predictions(chapter: str = "") -> Predictions:
    """Return a table that compares your predictions with the results, for one chapter or for all chapters.

    The table of one chapter also shows your progress in this chapter.
    """
    return Predictions(chapter, row=_row(chapter) if chapter else None)


def _row(number: str) -> ChapterRow | None:
    """Return the progress in a chapter, or None if the chapter has no checks, for example during grading."""
    try:
        progress = read_progress([number])
    except (UnknownCheck, ImportError):
        return None
    chapter = progress.chapters[0]
    if not chapter.parts:
        return None
    part = chapter.next_part
    return {
        "text": headline(progress, number),
        "parts": [{"check": each.check, "state": each.state, "mark": each.mark} for each in chapter.parts],
        "next": f"Next: {part.check}: {part.goal}" if part else "All parts of this chapter are passed.",
        "problems": list(progress.problems),
    }
