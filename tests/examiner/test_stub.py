"""An exercise that is as it was handed out is recognised, and nothing else is."""

from __future__ import annotations

import linecache
from typing import Any

import pytest

from course_pkg.examiner.stub import is_stub


def made(source: str, name: str = "it", *, keep_source: bool = True) -> Any:  # noqa: ANN401
    """Return what a cell with `source` defines, its source on record as IPython keeps it."""
    file = f"<cell {hash(source)} {keep_source}>"
    if keep_source:
        linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    names: dict[str, Any] = {}
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
    """A docstring and `...` are what is handed out, in a function, a class or a variable."""
    assert is_stub(made(source))


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
    """Whatever was written, also what does nothing, is an attempt."""
    assert not is_stub(made(source))


def test_without_source_the_code_decides() -> None:
    """A function whose source is gone is a stub when its code does nothing."""
    assert is_stub(made("def it(x):\n    ...", keep_source=False))
    assert not is_stub(made("def it(x):\n    return x + 1", keep_source=False))
