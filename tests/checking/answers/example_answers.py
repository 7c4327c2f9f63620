"""Reads the example answers: right and wrong answers with which the tests examine the checks.

Each chapter has its example answers in `answers.py`, which is valid Python in percent format. A cell is one
answer:

    # %% 05.1 right: TITLE
    # %% 05.1 wrong: TITLE | hint: TEXT     the report must contain TEXT, a part of the hint
    # %% 05.1 wrong: TITLE | hint: ONE … TWO     the report must contain both parts

The source of the answer is below its header, in one of four forms:

- a program in Python;
- one string, for a program that is not Python (such as a `%%writefile` of a C++ file);
- `solution()`: the part's exercise cell in the chapter's notebook in `solutions`;
- a small change of another answer to the same part:

      based_on("TITLE")                     without this line: based on the part's first right answer
      replace("old text", "new text")       the old text occurs once in the other answer
      replace("old", "new", times=3)        the old text occurs three times, and all three are replaced
      replace("begin … end", "new text")    the old text begins and ends with these two texts

Replacements are made one after the other. If a replacement replaces whole lines, its old text starts with a
line break. If the other answer is also a change, this other answer has to come earlier in the file.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from course_pkg.authoring.cells import code_cells, exercise_of
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.checking.fixtures import around, percent_cells
from course_pkg.checking.parts import chapters, folder_of

HEADER = re.compile(
    r"# %% (?P<check>\d\d\.\d+) (?P<kind>right|wrong): (?P<title>[^|\n]+?)(?:\s*\| hint: (?P<hint>.+))?\s*$"
)


@dataclass(frozen=True)
class Answer:
    """An example answer with its complete source."""

    check: str
    right: bool
    title: str
    hint: str
    source: str  # the source that runs instead of the exercise cell

    @property
    def quotes(self) -> list[str]:
        """The parts of a hint that the report must contain; an empty list for a right answer."""
        return [] if self.right else [" ".join(part.split()) for part in self.hint.split(" … ")]

    @property
    def before(self) -> str:
        """The source that runs before the answer."""
        return _around(self.check)[0]

    @property
    def after(self) -> str:
        """The source that runs after the answer."""
        return _around(self.check)[1]


@dataclass(frozen=True)
class Replacement:
    """A change of a source: the new text replaces the old text, which must occur `times` times."""

    old: str
    new: str
    times: int
    place: str  # file and line, for error messages

    def apply(self, source: str) -> str:
        """Return the changed source. Raises ValueError if the old text does not occur `times` times."""
        pattern = ".*?".join(map(re.escape, self.old.split(" … ")))
        changed, found = re.subn(pattern, lambda _: self.new, source, flags=re.DOTALL)
        if found != self.times:
            raise ValueError(f"{self.place}: {self.old!r} occurs {found} times, not {self.times}")
        return changed


@dataclass(frozen=True)
class Change:
    """A source that is made from another answer's source by replacements."""

    base: str  # the title of the other answer; empty for the part's first right answer
    replacements: tuple[Replacement, ...]
    place: str

    def apply(self, programs: dict[str, str]) -> str:
        """Return the changed source; `programs` maps the titles of the part's answers to their sources.

        Raises ValueError if there is no such answer, or if the old text of a replacement is not found.
        """
        base = self.base or next(iter(programs), "")
        if base not in programs:
            raise ValueError(f"{self.place}: no earlier answer to this part has the title {base!r}")
        # With this line break, a replacement of whole lines can also replace the first line.
        source = "\n" + programs[base]
        for replacement in self.replacements:
            source = replacement.apply(source)
        return source.strip("\n") + "\n"


@cache
def _around(check: str) -> tuple[str, str]:
    return around(check)


def every_answer() -> Iterator[Answer]:
    """Yield the answers to the parts of all chapters."""
    for chapter in chapters():
        yield from read_answers(folder_of(chapter) / "answers.py")


def read_answers(path: Path) -> list[Answer]:
    """Return the answers of a file in their order.

    Raises ValueError, with file and line, if the file is not valid Python or a header is malformed. Also
    raises ValueError if two answers to a part have the same title, or if a change does not fit the other
    answer.
    """
    text = path.read_text("utf-8")
    _parse(text, path, 1)
    answers: list[Answer] = []
    changes: dict[int, Change] = {}
    titles: set[tuple[str, str]] = set()
    for header, source, line in percent_cells(text):
        found = HEADER.match(header)
        if not found or bool(found["hint"]) != (found["kind"] == "wrong"):
            raise ValueError(f"{path}, line {line}: {header!r} is not a header of an answer")
        if (title := (found["check"], found["title"])) in titles:
            raise ValueError(f"{path}, line {line}: another answer to {title[0]} has the title {title[1]!r}")
        titles.add(title)
        body = _body(source, found["check"], path, line)
        if isinstance(body, Change):
            changes[len(answers)] = body
            body = ""
        right = found["kind"] == "right"
        answers.append(Answer(found["check"], right, found["title"], found["hint"] or "", body))
    known = [answer for number, answer in enumerate(answers) if number not in changes]
    known.sort(key=lambda answer: not answer.right)
    for number, change in changes.items():
        programs = {each.title: each.source for each in known if each.check == answers[number].check}
        answers[number] = replace(answers[number], source=change.apply(programs))
        known.append(answers[number])
    return answers


def _parse(source: str, path: Path, first_line: int) -> ast.Module:
    try:
        return ast.parse(source)
    except SyntaxError as error:
        line = first_line + (error.lineno or 1) - 1
        raise ValueError(f"{path}, line {line}: not valid Python: {error.msg}") from error


@cache
def _solutions(chapter: str) -> dict[str, str]:
    """Return the sources of the exercise cells in a chapter's solution; the keys are the parts."""
    (path,) = NotebookStore().solutions([chapter])
    return {part: cell["source"] for cell in code_cells(read(path)) if (part := exercise_of(cell))}


def _body(source: str, check: str, path: Path, header_line: int) -> str | Change:
    """Return the source of an answer, or the change from which this source is made."""
    statements = _parse(source, path, header_line + 1).body
    match statements:
        case [ast.Expr(ast.Constant(str(text)))]:
            return text.strip("\n") + "\n"
        case [ast.Expr(ast.Call(ast.Name("solution"), [], []))]:
            return _solutions(check.partition(".")[0])[check].strip("\n") + "\n"
        case [ast.Expr(ast.Call(ast.Name("replace" | "based_on"))), *_]:
            return _change(statements, path, header_line)
    return source


def _change(statements: list[ast.stmt], path: Path, header_line: int) -> Change:
    base = ""
    replacements = []
    for number, statement in enumerate(statements):
        place = f"{path}, line {header_line + statement.lineno}"
        match statement:
            case ast.Expr(ast.Call(ast.Name("based_on"), [ast.Constant(str(title))], [])) if number == 0:
                base = title
            case ast.Expr(
                ast.Call(ast.Name("replace"), [ast.Constant(str(old)), ast.Constant(str(new))], keywords)
            ) if (times := _times(keywords)) and old:
                replacements.append(Replacement(old, new, times, place))
            case _:
                raise ValueError(f"{place}: write replace(OLD, NEW) or replace(OLD, NEW, times=N)")
    return Change(base, tuple(replacements), f"{path}, line {header_line}")


def _times(keywords: list[ast.keyword]) -> int:
    """Return the value of the keyword `times`.

    Return 1 if there are no keywords, and 0 for wrong keywords.
    """
    match keywords:
        case []:
            return 1
        case [ast.keyword("times", ast.Constant(int(times)))]:
            return times
    return 0
