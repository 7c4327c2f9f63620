"""A graded part of a chapter, and functions that find parts."""

from __future__ import annotations

import difflib
import importlib
import pkgutil
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from course_pkg.checking.credit import Goal, goals_of
from course_pkg.errors import CheckError, UnknownCheck

if TYPE_CHECKING:
    from course_pkg.checking.context import CheckContext

CHAPTERS = "course_pkg.chapters"
PRIVATE = "private_"  # The modules with an instructor's own parts have this prefix.
PUBLIC = ("__init__.py", "programs")  # Student code may read these files of a chapter.
# The patterns match the course's programs that do the work of an exercise.
PROGRAMS = ("nodes/*.py", "shop/*.py", "turtlesim/driv*.py", "chapters/ch*/programs/*.py")
FOLDER = re.compile(r"ch(\d\d)_\w+")
IMPORTED = re.compile(r"^\s*(?:from|import)\s+course_pkg\.chapters(?:\.|\s+import\s+)ch(\d\d)_", re.MULTILINE)
# The pattern matches the name of a needed file in a package of the workspace.
PACKAGED = re.compile(r"file:src/(?P<package>[^/]+)/(?P<path>.+)")


@dataclass(frozen=True)
class Part:
    """One graded part of a chapter; calling it examines the student's work.

    `needs` contains the names that the student has to define. If one of these names is missing or its value
    is still `...`, the part counts as not attempted. The character `|` joins alternative names: one of them
    is enough.

    `deadline` is the time limit of the whole check in s. If the student has to repair a file, `start` is the
    `%%writefile` cell with the wrong file. Otherwise, `start` is empty. The points are divided among `goals`.
    A part without goals gives either all of its points or no points. `runs` are the programs of the course
    that the part uses, such as "server". During grading, all other programs of the course are hidden.
    """

    check: str
    points: int
    goal: str
    needs: tuple[str, ...]
    deadline: float
    examine: Callable[[CheckContext], None]
    start: str = ""
    goals: tuple[Goal, ...] = ()
    runs: tuple[str, ...] = ()

    @property
    def hidden(self) -> tuple[str, ...]:
        """The paths of the course's programs that the student's code cannot read during grading.

        These are all programs that are not in `runs`, and their compiled files.
        """
        root = folder_of(self.check.partition(".")[0]).parents[1]
        sources = [path for pattern in PROGRAMS for path in root.glob(pattern) if path.stem != "__init__"]
        hidden = [path for path in sources if path.stem not in self.runs]
        compiled = [path for each in hidden for path in each.parent.glob(f"__pycache__/{each.stem}.*.pyc")]
        return tuple(map(str, [*hidden, *compiled]))

    @property
    def package_files(self) -> dict[str, list[str]]:
        """The files in catkin packages that the part needs.

        The keys are the names of the packages, and the values are paths relative to the package.
        """
        found: dict[str, list[str]] = {}
        for name in self.needs:
            if packaged := PACKAGED.fullmatch(name):
                found.setdefault(packaged["package"], []).append(packaged["path"])
        return found

    def __call__(self, context: CheckContext) -> None:
        """Examine the student's work."""
        self.examine(context)


def part(
    check: str,
    *,
    points: int,
    goal: str,
    needs: Sequence[str] = (),
    deadline: float = 10.0,
    start: str = "",
    goals: Sequence[str] | Mapping[str, float] = (),
    runs: Sequence[str] = (),
) -> Callable[[Callable[[CheckContext], None]], Part]:
    """Return a decorator that declares the check of the part with the id `check`, such as "05.1".

    `goals` are the goals of the part. A sequence divides the points equally; a mapping contains a weight for
    each goal. The check marks a goal with `context.fulfilled` or `context.goal`. The last goal need not be
    marked: it is fulfilled if the check passes. Without goals, a part earns its points only if the check
    passes. `runs` are the programs of the course that the part or an earlier cell starts.
    """
    divided = goals_of(check, points, goals)

    def declare(examine: Callable[[CheckContext], None]) -> Part:
        return Part(check, points, goal, tuple(needs), deadline, examine, start, divided, tuple(runs))

    return declare


def exercise_of(check: str) -> str:
    """Return the id of the exercise that a part examines, such as "05.1" for "05.1" and for "05.1.1"."""
    return ".".join(check.split(".")[:2])


def add_private(folder: str) -> None:
    """Add the parts in the files private_NN.py of a folder; a part "05.1.1" belongs to exercise 05.1."""
    importlib.import_module(CHAPTERS).__path__.append(folder)


def chapters() -> list[str]:
    """Return the numbers of the chapters, such as ["00", "05"]."""
    return sorted(_modules())


def folder_of(chapter: str) -> Path:
    """Return the folder of a chapter, such as "05"; raise UnknownCheck if there is none."""
    return Path(str(importlib.import_module(_module_of(chapter)).__file__)).parent


def folders_for(chapter: str) -> list[Path]:
    """Return the folder of a chapter, such as "14", and the folders of the chapters that it imports.

    The list is sorted, and includes the chapters that are imported indirectly. For an unknown chapter, the
    list is empty.
    """
    modules, found, new = _modules(), set[str](), {chapter}
    while new := (new & modules.keys()) - found:
        found |= new
        new = {number for each in new for number in _imported(folder_of(each))}
    return sorted(map(folder_of, found))


def _imported(folder: Path) -> set[str]:
    """Return the numbers of the chapters that the modules in the folder `folder` import."""
    texts = (path.read_text("utf-8") for path in folder.rglob("*.py"))
    return {number for text in texts for number in IMPORTED.findall(text)}


def notebook_of(chapter: str) -> str:
    """Return the file name of a chapter's notebook, such as "05_write_a_server.ipynb"."""
    return f"{_module_of(chapter).rpartition('.ch')[2]}.ipynb"


def title_of(chapter: str) -> str:
    """Return the title of a chapter, such as "Write a server"."""
    return str(importlib.import_module(_module_of(chapter)).TITLE)


def parts_of(chapter: str) -> list[Part]:
    """Return the parts of a chapter, such as "05", in the order of their ids.

    Raises UnknownCheck for a chapter without checks, and CheckError if two parts have the same id.
    """
    modules = [importlib.import_module(f"{_module_of(chapter)}.checks")]
    package = importlib.import_module(CHAPTERS)
    if any(found.name == PRIVATE + chapter for found in pkgutil.iter_modules(package.__path__)):
        modules.append(importlib.import_module(f"{CHAPTERS}.{PRIVATE}{chapter}"))
    found = [value for module in modules for value in vars(module).values() if isinstance(value, Part)]
    _refuse_doubles(found, modules[0].__name__)
    return sorted(found, key=lambda item: [int(number) for number in item.check.split(".")])


def secret_paths() -> list[Path]:
    """Return the paths that student code may not read: the chapters' checks, fixtures and answers."""
    package = importlib.import_module(CHAPTERS)
    folders = [
        folder for root in package.__path__ for folder in Path(root).glob("ch[0-9]*") if folder.is_dir()
    ]
    return [path for folder in folders for path in folder.iterdir() if path.name not in PUBLIC]


def _modules() -> dict[str, str]:
    """Return a dict that maps the number of each chapter to the name of the chapter's module."""
    names = [module.name for module in pkgutil.iter_modules(importlib.import_module(CHAPTERS).__path__)]
    return {found[1]: f"{CHAPTERS}.{found[0]}" for name in names if (found := FOLDER.fullmatch(name))}


def _module_of(chapter: str) -> str:
    modules = _modules()
    if chapter not in modules:
        raise UnknownCheck(
            f"chapter {chapter!r} has no checks; the chapters with checks are {', '.join(modules) or 'none'}"
        )
    return modules[chapter]


def every_part() -> Iterator[Part]:
    """Yield the parts of all chapters."""
    for chapter in chapters():
        yield from parts_of(chapter)


def start_of(check: str) -> str:
    """Return the cell that the student repairs in the part `check`, or an empty string if there is none."""
    chapter = check.partition(".")[0]
    parts = parts_of(chapter) if chapter in chapters() else []
    return next((candidate.start for candidate in parts if candidate.check == check), "")


def find(check: str) -> Part:
    """Return the part with the id `check`; import only the chapter of this part.

    Raises UnknownCheck if no part has this id; the message contains similar ids.
    """
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
        raise CheckError(f"{module} declares {', '.join(doubles)} more than once: give each part its own id")
