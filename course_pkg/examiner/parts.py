"""A graded part: what it is about, what it needs, and the function that examines it."""

from __future__ import annotations

import difflib
import importlib
import pkgutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from course_pkg.errors import ExamError, UnknownCheck

if TYPE_CHECKING:
    from course_pkg.examiner.exam import Exam

CHECKS = "course_pkg.examiner.checks"
PRIVATE = "private_"  # modules of an instructor's own begin so, instead of with chapter_


@dataclass(frozen=True)
class Part:
    """One graded part of a chapter; calling it examines the student's work through an Exam.

    `needs` are the names that the student defines; while one of them is still `...` the part is not
    attempted, and while one is missing it cannot be examined. `deadline` (s) bounds the whole check.
    `start` is the cell that a student begins with, where that is something to repair: a `%%writefile` cell,
    whole. Otherwise it is empty, and the cell is the solution's with its answer taken out.
    """

    check: str
    points: int
    goal: str
    needs: tuple[str, ...]
    deadline: float
    examine: Callable[[Exam], None]
    start: str = ""

    def __call__(self, exam: Exam) -> None:
        """Examine the student's work."""
        self.examine(exam)


def part(
    check: str,
    *,
    points: int,
    goal: str,
    needs: Sequence[str] = (),
    deadline: float = 10.0,
    start: str = "",
) -> Callable[[Callable[[Exam], None]], Part]:
    """Declare the decorated function to be the check of the part with the id `check`, such as "05.1"."""

    def declare(examine: Callable[[Exam], None]) -> Part:
        return Part(check, points, goal, tuple(needs), deadline, examine, start)

    return declare


def exercise_of(check: str) -> str:
    """Return the exercise that a part examines: "05.1" for itself, and for one such as "05.1.1"."""
    return ".".join(check.split(".")[:2])


def add_private(folder: str) -> None:
    """Have the modules private_NN.py in `folder` declare parts, too; "05.1.1" is one for exercise 05.1."""
    importlib.import_module(CHECKS).__path__.append(folder)


def chapters() -> list[str]:
    """Return the chapters that have checks, such as ["00", "05"]."""
    package = importlib.import_module(CHECKS)
    names = [module.name for module in pkgutil.iter_modules(package.__path__)]
    return sorted(name.removeprefix("chapter_") for name in names if name.startswith("chapter_"))


def parts_of(chapter: str) -> list[Part]:
    """Return the parts of a chapter, such as "05", in the order of their ids."""
    if chapter not in chapters():
        raise UnknownCheck(f"no chapter {chapter!r} has checks: there are {', '.join(chapters()) or 'none'}")
    package = importlib.import_module(CHECKS)
    names = [f"chapter_{chapter}", f"{PRIVATE}{chapter}"]
    there = {module.name for module in pkgutil.iter_modules(package.__path__)}
    modules = [importlib.import_module(f"{CHECKS}.{name}") for name in names if name in there]
    found = [value for module in modules for value in vars(module).values() if isinstance(value, Part)]
    _refuse_doubles(found, modules[0].__name__)
    return sorted(found, key=lambda item: [int(number) for number in item.check.split(".")])


def every_part() -> Iterator[Part]:
    """Yield the parts of all chapters."""
    for chapter in chapters():
        yield from parts_of(chapter)


def start_of(check: str) -> str:
    """Return what a student begins the part `check` with, where its check says so; else an empty text."""
    chapter = check.partition(".")[0]
    parts = parts_of(chapter) if chapter in chapters() else []
    return next((candidate.start for candidate in parts if candidate.check == check), "")


def find(check: str) -> Part:
    """Return the part with the id `check`; importing no chapter but its own unless it is unknown."""
    chapter = str(check).partition(".")[0]
    if chapter in chapters():
        for candidate in parts_of(chapter):
            if candidate.check == check:
                return candidate
    known = [candidate.check for candidate in every_part()]
    near = difflib.get_close_matches(str(check), known, n=3, cutoff=0.4) or known[:3]
    raise UnknownCheck(f"There is no check {check!r}. Did you mean {' or '.join(map(repr, near))}?")


def _refuse_doubles(found: list[Part], module: str) -> None:
    ids = [item.check for item in found]
    if doubles := sorted({check for check in ids if ids.count(check) > 1}):
        raise ExamError(f"{module} declares {', '.join(doubles)} more than once: give each part its own id")
