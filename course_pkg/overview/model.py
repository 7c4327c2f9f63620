"""The progress of a student as plain data: parts, chapters, and the whole course."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.checking.record import PartRecord
from course_pkg.panels.choices.model import ChoiceRecord
from course_pkg.panels.prediction.model import Prediction

NOT_CHECKED = "not checked"
PASSED = "passed"
NO_GRADE = "This is your own record of the checks that you ran. It is not a grade."


@dataclass(frozen=True)
class PartProgress:
    """A part of a chapter, and the student's record for the part.

    The record is None if the part was never checked.
    """

    check: str
    goal: str
    possible: int
    record: PartRecord | None = None

    @property
    def passed(self) -> bool:
        """Whether a check of the part has passed at least once; later checks may have failed."""
        return bool(self.record and self.record.passed)

    @property
    def earned(self) -> float:
        """All points of a passed part; otherwise, the points of its last check."""
        return self.possible if self.passed else self.record.points if self.record else 0

    @property
    def state(self) -> str:
        """The state of the part: "passed", "not checked", or the result of the last check."""
        if self.passed:
            return PASSED
        return self.record.verdict if self.record else NOT_CHECKED

    @property
    def mark(self) -> str:
        """The state of the part as one character."""
        return "✓" if self.passed else "✗" if self.record else "·"


@dataclass(frozen=True)
class ChapterProgress:
    """The parts, predictions and choices of a chapter."""

    number: str
    title: str
    notebook: str
    parts: tuple[PartProgress, ...]
    predictions: tuple[Prediction, ...] = ()
    choices: tuple[ChoiceRecord, ...] = ()

    @property
    def passed(self) -> int:
        """The number of parts that have passed."""
        return sum(part.passed for part in self.parts)

    @property
    def complete(self) -> bool:
        """Whether all parts have passed."""
        return self.passed == len(self.parts)

    @property
    def points(self) -> tuple[float, int]:
        """The earned and the possible points."""
        return round(sum(part.earned for part in self.parts), 2), sum(part.possible for part in self.parts)

    @property
    def right(self) -> tuple[int, int]:
        """The number of correct predictions, and the number of predictions that were compared with a result.

        Only predictions that were made before the result was known are counted.
        """
        compared = [each for each in self.predictions if each.compared and each.first]
        return sum(each.right for each in compared), len(compared)

    @property
    def chosen(self) -> tuple[int, int]:
        """The number of correct choices, and the number of choices that were compared with a solution."""
        compared = [each for each in self.choices if each.compared]
        return sum(each.fit for each in compared), sum(len(each.first) for each in compared)

    @property
    def latest(self) -> str:
        """The time of the last check, prediction or choice as ISO 8601 in UTC, or ""."""
        checked = [part.record.checked for part in self.parts if part.record]
        answered = [max(each.answered, each.compared) for each in self.predictions]
        return max([*checked, *answered, *(each.compared for each in self.choices)], default="")

    @property
    def next_part(self) -> PartProgress | None:
        """The first part that has not passed, or None if all parts have passed."""
        return next((part for part in self.parts if not part.passed), None)


@dataclass(frozen=True)
class LearningPath:
    """A path through the course: its name, and the numbers of its chapters in order."""

    name: str
    chapters: tuple[str, ...]


@dataclass(frozen=True)
class Progress:
    """The progress in all chapters, or in selected chapters.

    `problems` contains messages about records that cannot be read.
    """

    chapters: tuple[ChapterProgress, ...]
    paths: tuple[LearningPath, ...] = ()
    problems: tuple[str, ...] = ()

    @property
    def passed(self) -> tuple[int, int]:
        """The number of parts that have passed, and the number of all parts."""
        return sum(each.passed for each in self.chapters), sum(len(each.parts) for each in self.chapters)

    @property
    def points(self) -> tuple[float, int]:
        """The earned and the possible points."""
        pairs = [each.points for each in self.chapters]
        return round(sum(earned for earned, _ in pairs), 2), sum(possible for _, possible in pairs)

    @property
    def right(self) -> tuple[int, int]:
        """The numbers of correct predictions and of compared predictions in all chapters."""
        return _sum([each.right for each in self.chapters])

    @property
    def chosen(self) -> tuple[int, int]:
        """The number of correct choices, and the number of choices that were compared with a solution."""
        return _sum([each.chosen for each in self.chapters])

    @property
    def current(self) -> ChapterProgress | None:
        """The chapter in which the student worked last.

        The result is None if there is no check, prediction or choice yet.
        """
        begun = [each for each in self.chapters if each.latest]
        return max(begun, key=lambda each: each.latest, default=None)

    def only(self, number: str) -> Progress:
        """Return the progress in only the chapter `number`, such as "05".

        If this chapter is unknown, the result contains no chapters.
        """
        chapters = tuple(each for each in self.chapters if each.number == number)
        return Progress(chapters, self.paths, self.problems)


def _sum(pairs: list[tuple[int, int]]) -> tuple[int, int]:
    return sum(first for first, _ in pairs), sum(second for _, second in pairs)
