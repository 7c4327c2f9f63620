"""Finds the flags in a class's submissions: all kinds of flags, or the kinds that the instructor selects."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from types import ModuleType

from course_pkg.errors import GradingError
from course_pkg.grading.flags import kinds
from course_pkg.grading.flags.work import Found, Group, group_of
from course_pkg.grading.grade import Flag, Grade, Submission
from course_pkg.grading.plan import plan

Find = Callable[[Group], Iterator[Found]]
Key = tuple[str, str, str]  # A key contains the student, the chapter, and the path of the submission.
NONE = "none"


def kind_names() -> list[str]:
    """Return the names of all kinds of flags; each name is the name of a module in the package `kinds`."""
    return sorted(module.name for module in pkgutil.iter_modules(kinds.__path__))


def title_of(kind: str) -> str:
    """Return a report's heading for a kind of flag; for an unknown kind, return the name of the kind."""
    return str(_module(kind).TITLE) if kind in kind_names() else kind


def wanted_kinds(names: Sequence[str]) -> list[str]:
    """Return the kinds of flag that the option --flags selects.

    An empty option selects all kinds, and "none" selects no kind.

    Raises GradingError if a name is not a kind of flag.
    """
    known = kind_names()
    if list(names) == [NONE]:
        return []
    if unknown := [name for name in names if name not in known]:
        raise GradingError(
            f"--flags does not know {', '.join(unknown)}. Use one or more of these values: "
            f"{','.join(known)}. Use the value none to look for no flags."
        )
    return [name for name in known if not names or name in names]


def with_flags(
    grades: Sequence[Grade], submissions: Sequence[Submission], names: Sequence[str]
) -> list[Grade]:
    """Search the graded submissions for flags of the kinds in `names`; return the grades with these flags.

    Submissions that do not count, such as earlier attempts, get no flags. A grade from an earlier run keeps
    its flags if this run has no submission for the grade.
    """
    graded = {_key(grade) for grade in grades}
    counting = [each for each in submissions if each.chapter and _key(each) in graded]
    flags: dict[Key, list[Flag]] = {_key(each): [] for each in counting}
    for chapter in sorted({each.chapter for each in counting}) if names else ():
        group = group_of(chapter, [each for each in counting if each.chapter == chapter], plan(chapter))
        for name in names:
            for work, flag in _module(name).find(group):
                flags[work.student, chapter, work.origin].append(flag)
    return [replace(grade, flags=tuple(flags.get(_key(grade), grade.flags))) for grade in grades]


def _key(each: Grade | Submission) -> Key:
    return each.student, each.chapter, each.origin


def _module(kind: str) -> ModuleType:
    return importlib.import_module(f"{kinds.__name__}.{kind}")
