"""Finds the hints in the source code of checks without running the checks.

Each sentence in a check is a hint, except docstrings, goals and error messages.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from course_pkg.checking.parts import every_part, folder_of
from tests.checking.answers.example_answers import Answer

# A string with several lines is a program or a file, not a hint.
SENTENCE = re.compile(r"[^\n]* [^\n]*\S[.?]( [^\n]*)?")


@dataclass(frozen=True)
class Hint:
    """A hint of a check.

    For an f-string, `pieces` contains the constant strings between the replacement fields.
    """

    place: str  # The file and the line of the hint, for error messages.
    pieces: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.place}: {'…'.join(self.pieces)}"

    def contains(self, text: str) -> bool:
        """Return whether this hint contains the given text."""
        return any(text in piece for piece in self.pieces)


def hints_in(path: Path) -> list[Hint]:
    """Return the hints in a module."""
    texts = _strings(ast.parse(path.read_text("utf-8")))
    return [Hint(f"{path}:{line}", pieces) for line, pieces in texts if SENTENCE.fullmatch("…".join(pieces))]


def hints_of(chapter: str) -> list[Hint]:
    """Return the hints in all checks of a chapter; the argument is the chapter's number, such as "05"."""
    goals = {(goal.text,) for part in every_part() for goal in part.goals}
    found = [hint for path in sorted(folder_of(chapter).glob("checks/**/*.py")) for hint in hints_in(path)]
    return [hint for hint in found if hint.pieces not in goals]


def not_shown(hints: list[Hint], answers: Iterable[Answer]) -> list[Hint]:
    """Return the hints that no header of an example answer quotes."""
    shown = set().union(*(shown_by(text, hints) for answer in answers for text in answer.quotes))
    return [hint for hint in hints if hint.pieces not in shown]


def shown_by(text: str, hints: list[Hint]) -> set[tuple[str, ...]]:
    """Return the constant strings (`pieces`) of the only hint that contains the given text.

    If several hints contain the text, return the hint that is equal to the text. If there is no such hint,
    return an empty set.
    """
    found = {hint.pieces for hint in hints if hint.contains(text)}
    return found & {(text,)} or (found if len(found) == 1 else set())


def _strings(node: ast.AST) -> Iterator[tuple[int, tuple[str, ...]]]:
    """For each possible hint in a syntax tree, yield its line number and its constant strings."""
    match node:
        case ast.Expr(ast.Constant()) | ast.Raise() | ast.keyword("goal"):
            return
        case ast.Constant(str(text)):
            yield node.lineno, (text,)
        case ast.JoinedStr(values):
            texts = (each.value if isinstance(each, ast.Constant) else "\0" for each in values)
            yield node.lineno, tuple("".join(map(str, texts)).split("\0"))
        case _:
            for child in ast.iter_child_nodes(node):
                yield from _strings(child)
