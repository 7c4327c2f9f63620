"""The headers of the example answers contain a part of each hint."""

from __future__ import annotations

from pathlib import Path

import pytest

import course_pkg.checking.common_hints
from course_pkg.checking.parts import chapters, folder_of
from tests.checking.answers.example_answers import every_answer, read_answers
from tests.checking.answers.hints import Hint, hints_in, hints_of, not_shown, shown_by

CHECK = '''"""The checks of a chapter."""

@part("05.1", goal="Return the area.")
def area(context):
    """Try a box."""
    hints = [(0.0, "The area is 0."), (lambda actual: actual > 9, f"Not {MORE}: {count} is too much.")]
    context.expect("the area of a box", hints=hints + [(matches("x."), WHY if why else "")])
    raise CheckError("No box.")
'''


@pytest.mark.parametrize("chapter", chapters())
def test_every_hint_has_an_example_answer(chapter: str) -> None:
    """For each hint of the chapter, the header of an example answer contains a part of the hint."""
    hints = hints_of(chapter)
    assert hints
    assert not _lines(not_shown(hints, read_answers(folder_of(chapter) / "answers.py")))


def test_every_common_hint_has_an_example_answer() -> None:
    """For each hint in common_hints, the header of an example answer contains a part of the hint."""
    hints = hints_in(Path(course_pkg.checking.common_hints.__file__))
    assert hints
    assert not _lines(not_shown(hints, every_answer()))


def _lines(hints: list[Hint]) -> str:
    return "\n".join(map(str, hints))


def test_hints_are_the_sentences_of_a_check(tmp_path: Path) -> None:
    """Docstrings, goals and error messages are not hints."""
    path = tmp_path / "checks.py"
    path.write_text(CHECK, "utf-8")
    assert [hint.pieces for hint in hints_in(path)] == [("The area is 0.",), ("Not ", ": ", " is too much.")]


def test_a_part_of_several_hints_shows_none_of_them() -> None:
    """A text in a header quotes a hint if the text is the whole hint, or is part of only this hint."""
    one, two = Hint("", ("Return it.",)), Hint("", ("Return it. It was ", " before."))
    assert shown_by("before", [one, two]) == {two.pieces}
    assert not shown_by("Return", [one, two])
    assert shown_by("Return it.", [one, two]) == {one.pieces}
    assert not shown_by("It was 5 before", [one, two])
