"""Tests of the reader for files with right and wrong example answers."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.checking.answers.example_answers import Answer, read_answers

FILE = '''"""Answers."""

# %% 05.1 right: with a variable
def double(x):
    twice = 2 * x
    return twice

# %% 05.1 right: in one line
def double(x):
    return x + x

# %% 05.1 wrong: three times | hint: that is x three times
replace("2 * x", "3 * x")
# %% 05.1 wrong: nothing is returned | hint: return it
replace("\\n    return twice", "")
# %% 05.1 wrong: adds one | hint: x + 1
based_on("in one line")
replace("x + x", "x + 1")
# %% 05.1 wrong: another name | hint: no double
replace("twice", "half", times=2)
replace("def double(x)", "def half(x)")
# %% 05.1 wrong: one line less | hint: a shorter program
replace("twice = … return twice", "return 3 * x")

# %% 05.1 wrong: a triangle | hint: another program
def double(x):
    return sum(range(x))

# %% 05.1 wrong: a larger triangle | hint: a change
based_on("a triangle")
replace("(x))", "(x + 1))")
# %% 05.1 wrong: a large triangle | hint: a change of a change
based_on("a larger triangle")
replace("x + 1", "x + 2")

# %% 05.2 right: C++
r"""%%writefile double.cpp
int twice(int x) { return 2 * x; }
"""

# %% 05.2 wrong: the file's name | hint: double.cpp
replace("""
%%writefile double.cpp
""", """
%%writefile twice.cpp
""")
'''
DOUBLE = "def double(x):\n    twice = 2 * x\n    return twice\n"


def _read(tmp_path: Path, text: str) -> list[Answer]:
    path = tmp_path / "answers.py"
    path.write_text(text)
    return read_answers(path)


def test_right_and_wrong_answers_are_read_in_order(tmp_path: Path) -> None:
    """The answers are returned in the order of the file."""
    answers = _read(tmp_path, FILE)
    assert answers[0] == Answer("05.1", True, "with a variable", "", DOUBLE)
    assert [(each.check, each.right, each.title, each.hint) for each in answers[1:4]] == [
        ("05.1", True, "in one line", ""),
        ("05.1", False, "three times", "that is x three times"),
        ("05.1", False, "nothing is returned", "return it"),
    ]
    assert [each.check for each in answers] == ["05.1"] * 10 + ["05.2"] * 2


@pytest.mark.parametrize(
    ("title", "source"),
    [
        ("three times", DOUBLE.replace("2", "3")),
        ("nothing is returned", "def double(x):\n    twice = 2 * x\n"),
        ("adds one", "def double(x):\n    return x + 1\n"),
        ("another name", "def half(x):\n    half = 2 * x\n    return half\n"),
        ("one line less", "def double(x):\n    return 3 * x\n"),
        ("a triangle", "def double(x):\n    return sum(range(x))\n"),
        ("a larger triangle", "def double(x):\n    return sum(range(x + 1))\n"),
        ("a large triangle", "def double(x):\n    return sum(range(x + 2))\n"),
        ("C++", "%%writefile double.cpp\nint twice(int x) { return 2 * x; }\n"),
        ("the file's name", "%%writefile twice.cpp\nint twice(int x) { return 2 * x; }\n"),
    ],
)
def test_source_is_a_program_a_string_or_a_change(tmp_path: Path, title: str, source: str) -> None:
    """The file contains an answer as a program, as a string, or as changes in the text of another answer."""
    assert [each.source for each in _read(tmp_path, FILE) if each.title == title] == [source]


def test_solution_is_the_exercise_cell_of_the_notebook(tmp_path: Path) -> None:
    """`solution()` returns the solution in the notebook."""
    one, other = _read(
        tmp_path,
        """# %% 09.6 right: the solution
solution()
# %% 09.6 wrong: no launch file | hint: y
replace("<launch>", "<node>")
""",
    )
    assert one.source.startswith("%%writefile")
    assert other.source == one.source.replace("<launch>", "<node>") != one.source


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
def test_a_malformed_header_is_refused(tmp_path: Path, header: str) -> None:
    """If a header in the file is malformed, the error message contains the line number and the header."""
    with pytest.raises(ValueError, match=f"line 1: '# %% {header}' is not a header"):
        _read(tmp_path, f"# %% {header}\nx = 1\n")


@pytest.mark.parametrize(
    ("change", "line", "message"),
    [
        ('replace("4 * x", "3 * x")', 13, r"'4 \* x' occurs 0 times, not 1"),
        ('replace("twice", "half")', 13, "'twice' occurs 2 times, not 1"),
        ('replace("twice", "half", times=3)', 13, "'twice' occurs 2 times, not 3"),
        ('replace("twice … 3 * x", "half")', 13, r"'twice … 3 \* x' occurs 0 times, not 1"),
        ('replace("2", "3")\nreplace("2", "4")', 14, "'2' occurs 0 times"),
        ('based_on("C++")\nreplace("2", "3")', 12, "no earlier answer to this part has the title 'C\\+\\+'"),
        ('based_on("a change")\nreplace("2", "3")', 12, "no earlier answer to this part has the title"),
        ('based_on("a large triangle")\nreplace("2", "3")', 12, "no earlier answer to this part"),
        ('replace("2", "3")\nbased_on("in one line")', 14, "write replace"),
        ('replace("2")', 13, "write replace"),
        ('replace("", "3")', 13, "write replace"),
        ('replace("2", 3)', 13, "write replace"),
        ('replace("2", "3", count=1)', 13, "write replace"),
        ('replace("2", "3")\nx = 1', 14, "write replace"),
        ("x = = 1", 13, "not valid Python"),
        ("%%writefile x.cpp", 13, "not valid Python"),
    ],
)
def test_a_change_that_does_not_fit_is_refused(tmp_path: Path, change: str, line: int, message: str) -> None:
    """If a change is invalid, the error message contains the file, the line number and the reason."""
    start = FILE.index("# %% 05.1 wrong")
    with pytest.raises(ValueError, match=rf"answers\.py, line {line}: .*{message}"):
        _read(tmp_path, f"{FILE[:start]}# %% 05.1 wrong: a change | hint: y\n{change}\n{FILE[start:]}")


def test_a_change_needs_a_right_answer(tmp_path: Path) -> None:
    """A change without `based_on` is only valid after a right answer to the same part."""
    with pytest.raises(ValueError, match="line 1: no earlier answer"):
        _read(tmp_path, '# %% 05.1 wrong: x | hint: y\nreplace("2", "3")\n')


def test_titles_of_a_part_differ(tmp_path: Path) -> None:
    """Two answers to one part must have different titles."""
    cell = "# %% {} right: a loop\nx = 1\n"
    assert len(_read(tmp_path, cell.format("05.1") + cell.format("05.2"))) == 2
    with pytest.raises(ValueError, match=r"line 3: another answer to 05\.1 has the title 'a loop'"):
        _read(tmp_path, cell.format("05.1") * 2)
