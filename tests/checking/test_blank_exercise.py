"""An exercise is blank only if the student has not changed the exercise."""

from __future__ import annotations

import linecache

import pytest

from course_pkg.checking.kernel.agent import is_blank
from course_pkg.checking.plain_values import Value


def made(source: str, name: str = "it", *, keep_source: bool = True) -> Value:
    """Return the object that a cell with the given source defines."""
    file = f"<cell {hash(source)} {keep_source}>"
    if keep_source:
        linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    names: dict[str, Value] = {}
    exec(compile(source, file, "exec"), names)  # noqa: S102
    return names[name]


@pytest.mark.parametrize(
    "source",
    [
        "def it(x): ...",
        "def it(x):\n    ...",
        'def it(x):\n    """Do it."""\n    ...',
        'def it(x):\n    """Do it."""',
        "async def it(x):\n    ...",
        "class it:\n    def a(self): ...\n    def b(self):\n        '''B.'''\n        ...",
        "it = ...",
    ],
)
def test_stubs(source: str) -> None:
    """A function with only a docstring or `...`, a class of such functions, and the value `...` are blank."""
    assert is_blank(made(source))


@pytest.mark.parametrize(
    "source",
    [
        "def it(x): return None",
        "def it(x):\n    pass",
        'def it(x):\n    """Do it."""\n    return ...',
        "class it:\n    def a(self): ...\n    def b(self): return 1",
        "class it: ...",
        "it = None",
        "it = 0",
        "it = len",
        "it = lambda: ...",
    ],
)
def test_attempts(source: str) -> None:
    """Code that the student has written counts as an attempt, even if it does nothing."""
    assert not is_blank(made(source))


def test_without_source_the_code_decides() -> None:
    """A function without available source is blank if its code does nothing."""
    assert is_blank(made("def it(x):\n    ...", keep_source=False))
    assert not is_blank(made("def it(x):\n    return x + 1", keep_source=False))
