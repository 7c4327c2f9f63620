"""The answers that the checks are held to: what students would write, right and wrong.

Beside `checks/chapter_05.py` stands `checks/chapter_05.answers.py`, in percent format:

    # %% before                    run first, for every answer of the file: imports, joining the graph
    # %% 05.1 before               run next, for the answers of this part
    # %% 05.1 right: TITLE         an answer, in place of the exercise cell
    # %% 05.1 wrong: TITLE | hint: TEXT
                                   an answer that is refused, with TEXT in the report
    # %% 05.1 after                run after the answer: what the exercise cell does besides
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from course_pkg.errors import AnswersBroken
from course_pkg.examiner import checks

HEADER = re.compile(
    r"# %% (?:(?P<check>\d\d\.\d+) )?(?P<kind>before|after|right|wrong)"
    r"(?:: (?P<title>[^|\n]+?)(?:\s*\| hint: (?P<hint>.+))?)?\s*$"
)


@dataclass(frozen=True)
class Answer:
    """One answer, ready to be run."""

    check: str
    right: bool
    title: str
    hint: str
    source: str  # what stands in for the exercise cell
    before: str
    after: str


def around(check: str) -> tuple[str, str]:
    """Return what is run before and after an answer to the part `check`, whatever the answer."""
    name = f"chapter_{check.partition('.')[0]}.answers.py"
    paths = (Path(folder) / name for folder in checks.__path__)
    blocks = [block for path in paths if path.exists() for block in _blocks(path)]
    return _joined(blocks, check, "before"), _joined(blocks, check, "after")


@dataclass(frozen=True)
class _Block:
    check: str
    kind: str
    title: str
    hint: str
    source: str


def every_answer() -> Iterator[Answer]:
    """Yield the answers to all chapters' parts."""
    for folder in checks.__path__:
        for path in sorted(Path(folder).glob("chapter_*.answers.py")):
            yield from read_answers(path)


def read_answers(path: Path) -> list[Answer]:
    """Return the answers in the file at `path`."""
    blocks = list(_blocks(path))
    answers = [block for block in blocks if block.kind in ("right", "wrong")]
    return [
        Answer(
            block.check,
            block.kind == "right",
            block.title,
            block.hint,
            block.source,
            _joined(blocks, block.check, "before"),
            _joined(blocks, block.check, "after"),
        )
        for block in answers
    ]


def _blocks(path: Path) -> Iterator[_Block]:
    """Yield the cells of the file; what stands above the first is the file's own docstring."""
    lines = path.read_text("utf-8").splitlines()
    starts = [number for number, line in enumerate(lines) if line.startswith("# %%")]
    for start, end in zip(starts, [*starts[1:], len(lines)], strict=True):
        found = HEADER.match(lines[start])
        if not found or not _complete(found):
            raise AnswersBroken(
                f"{path.name}, line {start + 1}: {lines[start]!r} is not a header of an answer"
            )
        source = "\n".join(lines[start + 1 : end]).strip("\n") + "\n"
        yield _Block(found["check"] or "", found["kind"], found["title"] or "", found["hint"] or "", source)


def _complete(header: re.Match[str]) -> bool:
    """Hold that an answer has a part and a title, and a wrong one a hint."""
    if header["kind"] in ("before", "after"):
        return not header["title"]
    return bool(header["check"] and header["title"]) and bool(header["hint"]) == (header["kind"] == "wrong")


def _joined(blocks: list[_Block], check: str, kind: str) -> str:
    return "\n".join(block.source for block in blocks if block.kind == kind and block.check in ("", check))
