"""The data of each chapter on the landing page: its title, time, goals and points."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from course_pkg.authoring.cells import Notebook, code_cells, exercise_of, points_of

LABEL = re.compile(r"\*\*(?P<label>You will|You need|Time)\*\*:?\s*(?P<text>.*?)(?=\n\n|\Z)", re.DOTALL)
TITLE = re.compile(r"# (?P<title>.+)")
MINUTES = re.compile(r"(?P<minutes>\d+) minutes")


class Chapter(NamedTuple):
    """A chapter in the syllabus.

    The texts `lead`, `will` and `need` are Markdown. `minutes` is 0 if the notebook does not contain a time.
    """

    name: str  # `name` is the name of the chapter's files without the extension, such as 05_write_a_server.
    title: str
    lead: str
    will: str
    need: str
    minutes: int
    points: tuple[int, ...]  # `points` contains the points of each exercise.

    @property
    def number(self) -> str:
        """The chapter's number as two digits."""
        return self.name[:2]

    @property
    def page(self) -> str:
        """The file name of the chapter's page."""
        return f"{self.name}.html"

    @property
    def full_title(self) -> str:
        """The chapter's number and title, as the text of a link."""
        return f"{self.number} {self.title}"


def chapter_of(name: str, notebook: Notebook) -> Chapter:
    """Return the chapter of the notebook `name`, from the notebook's first cell and its exercises."""
    first = str(notebook["cells"][0]["source"]) if notebook["cells"] else ""
    title = TITLE.match(first)
    labels = {found["label"]: found["text"].strip() for found in LABEL.finditer(first)}
    minutes = MINUTES.search(labels.get("Time", ""))
    points = (points_of(cell) or 0 for cell in code_cells(notebook) if exercise_of(cell))
    return Chapter(
        name,
        title["title"].strip() if title else name,
        _lead(first),
        labels.get("You will", ""),
        labels.get("You need", ""),
        int(minutes["minutes"]) if minutes else 0,
        tuple(points),
    )


def hours(chapters: Sequence[Chapter]) -> str:
    """Return the total time of these chapters, such as "2 hours and 5 minutes"."""
    whole, rest = divmod(sum(chapter.minutes for chapter in chapters), 60)
    parts = ((whole, "hour"), (rest, "minute"))
    return " and ".join(f"{number} {unit}{'s' * (number != 1)}" for number, unit in parts if number)


def _lead(first: str) -> str:
    paragraphs = first.split("\n\n")[1:]
    return next((text for text in paragraphs if not text.startswith("**")), "")
