"""Finds notebooks of the course's first edition, in which some chapters and exercises have other numbers."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from course_pkg.grading.intake.reading import StudentCell

PART = re.compile(r"""(?:exercise|check)-(\d\d)-\d+|^check\(["'](\d\d)\.\d+["']\)""", re.MULTILINE)
TITLE = re.compile(r"# (.+)")


@dataclass(frozen=True)
class RenumberedChapter:
    """A chapter of the course's first edition; `now` is its number in the current edition."""

    name: str  # `name` is the name of the file in the first edition, without the ending .ipynb.
    title: str  # `title` is the heading of the chapter in the first edition.
    now: str
    moved: str = ""  # `moved` is a sentence about exercises that are now in another chapter.

    @property
    def number(self) -> str:
        """The number of the chapter in the first edition."""
        return self.name[:2]

    @property
    def difference(self) -> str:
        """Sentences that tell a student what has changed in this chapter since the first edition."""
        if self.number == self.now:
            return f"the exercises of this chapter had other numbers. {self.moved}".strip()
        return (
            f"this chapter had number {self.number}, and it is chapter {self.now} now. {self.moved}".strip()
        )


RENUMBERED = (
    RenumberedChapter("07_use_existing_services", "Use the services that already exist", "08"),
    RenumberedChapter("08_drive_turtles", "Drive turtles", "09"),
    RenumberedChapter("09_look_inside", "Look inside a call", "11"),
    RenumberedChapter(
        "10_survive_trouble",
        "Survive trouble",
        "12",
        (
            "Exercise 10.1 is now exercise 10.4 in chapter 10. Exercise 10.2 is now exercise 10.5 "
            "in chapter 10."
        ),
    ),
    RenumberedChapter("11_cpp", "Read and build the C++ side", "13"),
    RenumberedChapter("12_robot_cashier", "Build the robot cashier", "15"),
    RenumberedChapter("13_go_further", "Go further", "16"),
)

# Chapter 03 has the same number in both editions of the course, but its exercises have other numbers.
CHOOSE = RenumberedChapter(
    "03_choose",
    "Choose between a stream and a question",
    "03",
    (
        "Exercise 03.3 is now exercise 10.2 in chapter 10. Exercise 03.5 is now exercise 03.4. The old "
        "exercise 03.4 was removed."
    ),
)
# Only the first edition of the course has the part 03.5.
LAST_PART = re.compile(r"(?:exercise|check)-03-5|[\"']03\.5[\"']")


def first_edition(name: str, cells: Sequence[StudentCell], by_ids: str) -> RenumberedChapter | None:
    """Return the chapter of the first edition to which a notebook belongs, or None for a newer notebook.

    `name` is the notebook's file name, in lower case with underscores. `by_ids` is the chapter that has the
    most cell ids in common with the notebook. The chapter number alone is not sufficient, because in the
    current edition, this number belongs to another chapter.
    """
    number = _number(cells)
    if number == CHOOSE.number and (CHOOSE.title in _titles(cells) or _has_last_part(cells)):
        return CHOOSE
    if not number:
        return next((each for each in RENUMBERED if each.name in name), None)
    chapter = next((each for each in RENUMBERED if each.number == number), None)
    if chapter and (chapter.name in name or chapter.title in _titles(cells) or chapter.now == by_ids):
        return chapter
    return None


def _number(cells: Sequence[StudentCell]) -> str:
    """Return the most frequent chapter number in the ids of exercises and checks, or "" if there is none."""
    texts = [text for cell in cells for text in (cell.id, cell.source)]
    found = [first or second for text in texts for first, second in PART.findall(text)]
    found += [part[:2] for cell in cells for part in (cell.exercise, cell.check) if part]
    return Counter(found).most_common(1)[0][0] if found else ""


def _has_last_part(cells: Sequence[StudentCell]) -> bool:
    """Return whether the notebook has the part 03.5."""
    return any(
        "03.5" in (cell.exercise, cell.check) or LAST_PART.search(f"{cell.id} {cell.source}")
        for cell in cells
        if cell.kind == "code"
    )


def _titles(cells: Sequence[StudentCell]) -> set[str]:
    found = (TITLE.match(cell.source) for cell in cells if cell.kind == "markdown")
    return {title[1].strip() for title in found if title}
