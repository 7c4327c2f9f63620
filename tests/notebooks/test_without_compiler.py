"""Chapter 11 on a machine that cannot build C++."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from course_pkg.authoring.cells import check_of, code_cells
from course_pkg.authoring.execute import run
from course_pkg.authoring.shelf import read
from course_pkg.authoring.tidy import strip

ROOT = Path(__file__).parents[2]


def shown(cell: dict[str, Any]) -> str:
    """Return all that a cell shows, as text."""
    return "\n".join(output.get("data", {}).get("text/plain", "") for output in cell["outputs"])


@pytest.mark.timeout(300)
def test_without_a_compiler_run_all_reaches_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """The chapter says what is missing and what to type, and its checks read 'not attempted'."""
    monkeypatch.setenv("CXX", "/nowhere/c++")  # CMake goes by it, too
    notebook = read(next((ROOT / "solutions").glob("11_*.ipynb")))
    strip(notebook)
    run("11 without a compiler", notebook)
    cells = code_cells(notebook)
    assert "There is no C++ compiler here" in shown(cells[0])
    checks = {check_of(cell): shown(cell) for cell in cells if check_of(cell)}
    assert len(checks) == 4
    for check, words in checks.items():
        assert words.startswith(f"{check} not attempted"), words
        assert "apt-get install --no-install-recommends g++" in " ".join(words.split())
