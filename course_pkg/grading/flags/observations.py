"""Observations: actions of a program that an instructor may want to examine.

Each observation has a key, such as "os.environ". Observations that also occur in the course's own notebooks
are left out.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from course_pkg.grading.flags.syntax import UNREADABLE, aliases, imports, is_python, line_of, tree
from course_pkg.grading.flags.work import Answer, Found, Group
from course_pkg.grading.grade import Flag

SHOWN = 5  # SHOWN is the maximum number of flags of one kind for one answer.


@dataclass(frozen=True)
class Observation:
    """An action of a student's program."""

    key: str
    line: int
    words: str  # `words` is a sentence that tells the instructor what the program does.


@dataclass(frozen=True)
class Program:
    """The syntax tree of a program, and the imported objects to which its names refer."""

    module: ast.Module
    names: Mapping[str, str]


Observe = Callable[[Program], Iterable[Observation]]


def unusual(group: Group, kind: str, observe: Observe, *, whole_notebook: bool) -> Iterator[Found]:
    """Yield a flag for each observation that occurs in an answer, but not in the course's own code.

    The course's own code is the solution of the exercise, and all cells that are not exercises. If
    `whole_notebook` is True, the solutions of the chapter's other exercises are also part of the course's own
    code.
    """
    shown = [tree(Answer("00", source)) for source in group.shown]
    given = imports(shown)
    taught = {seen.key for module in shown for seen in observe(Program(module, aliases(module, given)))}
    own = {
        name: {each.key for each in _seen(answer, given, observe)} for name, answer in group.solution.items()
    }
    if whole_notebook:
        taught = taught.union(*own.values())
    for work, answer in group.answers():
        if is_python(answer):
            known = taught | own.get(answer.name, set())
            new = {each.key: each for each in _seen(answer, given, observe) if each.key not in known}
            for each in sorted(new.values(), key=lambda every: every.line)[:SHOWN]:
                yield work, Flag(kind, answer.where, each.words, each.line, line_of(answer, each.line))


def _seen(answer: Answer, given: Mapping[str, str], observe: Observe) -> list[Observation]:
    """Return the observations in an answer.

    A cell of the notebook can use the imports of other cells.
    """
    try:
        module = tree(answer)
        return list(observe(Program(module, aliases(module, {} if answer.path else given))))
    except UNREADABLE:
        return [
            Observation(
                "unreadable", 0, "The code is not valid Python, so it was not searched for suspicious lines."
            )
        ]
