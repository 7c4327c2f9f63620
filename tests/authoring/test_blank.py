"""Tests of `blank`, which removes the answer from an exercise cell."""

# ruff: noqa: E501 -- each source stands above its result, so that a reader can compare the two lines

from __future__ import annotations

import ast

import pytest

from course_pkg.authoring.blank import blank
from course_pkg.errors import AuthoringError

CASES = {
    "docstring kept": (
        'def f(x):\n    """Do it.\n\n    x: what.\n    """\n    # secret\n    y = x\n    return y\n\n\nf(1)\n',
        'def f(x):\n    """Do it.\n\n    x: what.\n    """\n    ...\n\n\nf(1)\n',
    ),
    "no docstring": ("def f(x):\n    return 1", "def f(x):\n    ..."),
    "comment on the signature": (
        "def f(x):  # given\n    # secret\n    return 1",
        "def f(x):  # given\n    ...",
    ),
    "comments behind the body": (
        "def f():\n    return 1  # secret\n    # secret\n\n# kept\nx()",
        "def f():\n    ...\n\n# kept\nx()",
    ),
    "one line": ("def f(x): return {1: x}", "def f(x): ..."),
    "one line with a docstring": ('def f(x): "Do it."; return 1', 'def f(x): "Do it."; ...'),
    "signature over lines": (
        "@wrap({1: 2})\ndef f(\n    x: dict[str, int] = {'a': 1},  # given: x\n    *, y=lambda z: z,\n) -> 'list[int]':\n"
        "    return [x]\n",
        "@wrap({1: 2})\ndef f(\n    x: dict[str, int] = {'a': 1},  # given: x\n    *, y=lambda z: z,\n) -> 'list[int]':\n"
        "    ...\n",
    ),
    "annotation with a colon": (
        "def f() -> dict[slice(1):2]:\n    return 1",
        "def f() -> dict[slice(1):2]:\n    ...",
    ),
    "async, nested, quotes": (
        "async def f():\n    def g():\n        '''\ndef h():\n    pass\n'''\n    return g\nf()",
        "async def f():\n    ...\nf()",
    ),
    "tabs and unicode": (
        'def größe(ä):\n\t"""Größe → m²."""\n\treturn \'ü\'\nprint(\'ß\')',
        'def größe(ä):\n\t"""Größe → m²."""\n\t...\nprint(\'ß\')',
    ),
    "methods": (
        "class A:\n    '''Counts.'''\n\n    limit = 3\n\n    def f(self):\n        return 1\n\n    @property\n"
        "    def g(self): return 2\n\na = A()\na.f()",
        "class A:\n    '''Counts.'''\n\n    limit = 3\n\n    def f(self):\n        ...\n\n    @property\n"
        "    def g(self): ...\n\na = A()\na.f()",
    ),
    "assignments": (
        "import os\na = 1  # why\nb: int = (\n    2 +\n    3\n)\nc, (d, *e) = 1, (2, 3)\nf = g = h()\nx.y = 1\nz: int\n",
        "import os\na = ...  # why\nb: int = ...\nc, (d, *e) = ..., (..., ...)\nf = g = ...\nx.y = 1\nz: int\n",
    ),
    "wiring stays": (
        "def f(): return 1\nanswer = f()\nother = len([])\nserve('/x', f)",
        "def f(): ...\nanswer = f()\nother = ...\nserve('/x', f)",
    ),
    "magics": (
        "%time f()\nfiles = !ls -l\n!echo hi\nf?\nx = %who\ndef f():\n    return 1\n",
        "%time f()\nfiles = ...\n!echo hi\nf?\nx = ...\ndef f():\n    ...\n",
    ),
    "written Python": (
        "%%writefile client.py\n#!/usr/bin/env python3\nimport sys\n\ndef main(argv):\n    '''Ask.'''\n    return 0\n\n"
        "if __name__ == '__main__':\n    sys.exit(main(sys.argv))\n",
        "%%writefile client.py\n#!/usr/bin/env python3\nimport sys\n\ndef main(argv):\n    '''Ask.'''\n    ...\n\n"
        "if __name__ == '__main__':\n    sys.exit(main(sys.argv))\n",
    ),
    "written text": (
        "%%writefile srv/Area.srv\n# The sides.\n# In metres.\nfloat32 a\n---\nfloat32 b",
        "%%writefile srv/Area.srv\n# The sides.\n# In metres.\n...",
    ),
    "timed": ("%%time\nx = 1", "%%time\nx = ..."),
    "nothing to take out": ("import os\nprint(os)\n# why", "import os\nprint(os)\n# why"),
}


@pytest.mark.parametrize(("source", "expected"), CASES.values(), ids=CASES)
def test_rules(source: str, expected: str) -> None:
    """`blank` removes the answer and changes no other byte of the cell."""
    assert blank(source) == expected


@pytest.mark.parametrize("source", [source for source, _ in CASES.values()], ids=CASES)
def test_blanking_twice_changes_nothing_more(source: str) -> None:
    """`blank` does not change a cell that is already blank."""
    assert blank(blank(source)) == blank(source)


@pytest.mark.parametrize("name", [name for name, (source, _) in CASES.items() if "%" not in source])
def test_a_blank_exercise_is_valid_python(name: str) -> None:
    """A blank exercise is valid Python."""
    ast.parse(blank(CASES[name][0]))


@pytest.mark.parametrize("source", ["def f(:\n    return", "%%bash\nls", "%%script true\nx = 1"])
def test_a_cell_without_a_rule_is_refused(source: str) -> None:
    """`blank` raises an error for a cell that is not valid Python."""
    with pytest.raises(AuthoringError):
        blank(source)
