"""Tests of chapter 13 on a machine that has no C++ compiler."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.authoring.cells import Cell, Notebook, check_of, code_cells
from course_pkg.authoring.execute import run_all
from course_pkg.authoring.notebook_store import read

ROOT = Path(__file__).parents[2]


def shown(cell: Cell) -> str:
    """Return all outputs of a cell as text."""
    return "\n".join(output.get("data", {}).get("text/plain", "") for output in cell["outputs"])


@pytest.mark.timeout(300)
def test_without_a_compiler_run_all_reaches_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each check reports "not attempted", and the report contains the command that installs the compiler."""
    monkeypatch.setenv("CXX", "/nowhere/c++")  # CXX selects the compiler, and CMake also reads this variable.
    notebook = read(next((ROOT / "solutions").glob("13_*.ipynb")))
    executed: list[Notebook] = []
    assert run_all({"13 without a compiler": notebook}, lambda _, ran: executed.append(ran)) == {}
    cells = code_cells(executed[0])
    checks = {check_of(cell): shown(cell) for cell in cells if check_of(cell)}
    assert len(checks) == 4
    for check, words in checks.items():
        assert words.startswith(f"{check} not attempted"), words
        assert "No C++ compiler is installed" in words
        assert "apt-get install --no-install-recommends g++" in " ".join(words.split())
