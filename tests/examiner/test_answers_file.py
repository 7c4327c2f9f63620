"""The file of right and wrong answers is read as it is meant, or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import AnswersBroken
from course_pkg.examiner.answers import read_answers

FILE = '''"""Answers."""

# %% before
import rospy

# %% 05.1 before
near = 1

# %% 05.2 before
far = 2

# %% 05.1 after
go()

# %% 05.1 right: as it should be
x = 1

# %% 05.1 wrong: the other way | hint: turn it round
x = 2
'''


def test_answers_carry_what_runs_around_them(tmp_path: Path) -> None:
    """The file's own cells come first, then the part's; another part's are left out."""
    path = tmp_path / "chapter_05.answers.py"
    path.write_text(FILE)
    right, wrong = read_answers(path)
    assert (right.right, right.title, right.hint, right.source) == (True, "as it should be", "", "x = 1\n")
    assert (wrong.right, wrong.title, wrong.hint) == (False, "the other way", "turn it round")
    assert right.before == "import rospy\n\nnear = 1\n"
    assert right.after == "go()\n"


@pytest.mark.parametrize(
    "header",
    [
        "05.1 wrong: no hint",
        "05.1 right: x | hint: y",
        "right: no part",
        "05.1 rigth: x",
        "05.1",
        "5.1 right: x",
    ],
)
def test_a_header_that_is_not_one_is_named(tmp_path: Path, header: str) -> None:
    """The line and what stands in it are in the message."""
    path = tmp_path / "chapter_05.answers.py"
    path.write_text(f"# %% {header}\nx = 1\n")
    with pytest.raises(AnswersBroken, match="line 1"):
        read_answers(path)
