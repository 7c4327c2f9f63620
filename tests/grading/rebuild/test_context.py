"""Tests of the search for cells that an answer needs."""

from __future__ import annotations

import time

import pytest

from course_pkg.grading.rebuild.context import needed

ABOVE = ("import math", "def area(box):\n    return math.prod(box)", "side = 2", "unused = area([1])")


def test_cells_that_define_a_needed_name_are_found() -> None:
    """The result contains the nearest cell that defines the name, and all cells that this cell needs."""
    assert needed("def double(box):\n    return 2 * area(box)", "", ABOVE) == ABOVE[:2]


def test_known_names_need_no_other_cell() -> None:
    """Builtins and names of the course's cells need no other cell."""
    assert needed("import math\nprint(math.pi, len([1]))", "", ABOVE) == ()
    assert needed("def f():\n    return side", "side = 3", ABOVE) == ()


def test_names_inside_of_an_answer_need_no_other_cell() -> None:
    """Names that an answer defines inside of a block or a function need no other cell."""
    above = ("error = 1", "def work():\n    pass", "import queue")
    assert needed("try:\n    f = 1\nexcept OSError as error:\n    print(error)", "", above) == ()
    assert needed("def f():\n    import queue\n    def work():\n        queue\n    work()", "", above) == ()


def test_the_variable_of_a_comprehension_is_not_given() -> None:
    """The variable of a comprehension is not available in later cells."""
    assert needed("print(error)", "", ("[error for error in (1, 2)]",)) == ()


def test_magics_are_read_as_ipython_reads_them() -> None:
    """The search finds names in a cell with an IPython magic."""
    assert needed("%time x = side", "", ABOVE) == ()
    assert needed("!ls\nx = side", "", ABOVE) == ("side = 2",)


@pytest.mark.parametrize(
    ("answer", "above"),
    [
        ("\n".join(f"u{n}" for n in range(9000)), ["x=[" + "1," * 45000 + "]"] * 20),
        ("%lsmagic\n" * 20_000, []),
        ("if a: pass\n" + "elif a: pass\n" * 100_000, []),
        ("(" * 100_000, ["-" * 100_000 + "1"]),
    ],
    ids=["many names and long cells", "many magics", "a long ladder", "deep"],
)
def test_unusual_sources_take_little_time(answer: str, above: list[str]) -> None:
    """The search takes little time, even for very unusual source code."""
    began = time.process_time()
    assert needed(answer, "", above) == ()
    assert time.process_time() - began < 10.0  # Without a limit, the search would take minutes.
