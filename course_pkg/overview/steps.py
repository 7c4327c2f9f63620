"""The next steps of a student: the first part that has not passed, or the next chapter of each path."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.overview.model import ChapterProgress, Progress


@dataclass(frozen=True)
class Step:
    """The next step in a notebook.

    `notebook` is the file name of the notebook, or "" if the student has done everything.
    """

    text: str
    notebook: str = ""


def next_steps(progress: Progress, chapter: str = "") -> list[Step]:
    """Return the next steps in the chapter `chapter`, or in the chapter in which the student worked last.

    If the chapter is complete, each learning path can have a different next step. The result has at least one
    step.
    """
    by_number = {each.number: each for each in progress.chapters}
    current = by_number.get(chapter) or progress.current
    if current is None:
        first = progress.chapters[0]
        return [Step(f"Begin with chapter {first.number}, {first.title}", first.notebook)]
    if part := current.next_part:
        return [Step(f"{part.check}: {part.goal}", current.notebook)]
    following = _following(progress, current, by_number)
    if not following:
        return [Step("You have passed all parts of the course.")]
    return [
        Step(
            f"Chapter {number}, {by_number[number].title} (path: {' and '.join(names)})",
            by_number[number].notebook,
        )
        for number, names in sorted(following.items())
    ]


def _following(
    progress: Progress, current: ChapterProgress, by_number: dict[str, ChapterProgress]
) -> dict[str, list[str]]:
    """Return the incomplete chapters that come next on a learning path; the keys are chapter numbers.

    The values are the names of the learning paths.
    """
    found: dict[str, list[str]] = {}
    for path in progress.paths:
        chapters = [by_number[number] for number in path.chapters if number in by_number]
        if current in chapters:
            place = chapters.index(current)
            left = [each for each in (*chapters[place + 1 :], *chapters[:place]) if not each.complete]
            for each in left[:1]:
                names = found.setdefault(each.number, [])
                names += [name for name in [path.name[:1].lower() + path.name[1:]] if name not in names]
    return found
