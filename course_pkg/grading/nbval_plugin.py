"""A pytest plug-in that reports the result of each part after nbval has run a notebook of the course.

The result is only feedback: it comes from the outputs of the notebook, and student code can forge them. If
the variable COURSE_NBVAL_RECORD names a file, the outcome of each cell is appended to this file, one JSON
object per line.
"""

from __future__ import annotations

import json
import os
from collections.abc import Generator

import pytest

from course_pkg.authoring.cells import Cell, check_of

RECORD = "COURSE_NBVAL_RECORD"
WORDS = 40000  # maximum number of characters of a failure
LINES = pytest.StashKey[list[str]]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Record the result of a cell; ignore reports that are not about a cell."""
    report = yield
    cell: Cell | None = getattr(item, "cell", None)
    if cell is not None and (report.when == "call" or report.outcome != "passed"):
        if check_of(cell):
            report.user_properties.append(("part", _headline(item, cell)))
        _record(cell, report)
    return report


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Show a line for each part."""
    reports = [each for group in terminalreporter.stats.values() for each in group]
    properties = [pair for each in reports for pair in getattr(each, "user_properties", [])]
    lines = sorted({words for key, words in properties if key == "part"})
    if lines:
        terminalreporter.section("parts of the course")
        for line in lines:
            terminalreporter.write_line(line)


def _headline(item: pytest.Item, cell: Cell) -> str:
    """Return the first line of the check's report."""
    for output in getattr(item, "test_outputs", None) or []:
        text = str(output.get("data", {}).get("text/plain", ""))
        if text.startswith(check_of(cell)):
            return text.splitlines()[0][:200]
    return f"{check_of(cell)} not examined"


def _record(cell: Cell, report: pytest.TestReport) -> None:
    if path := os.environ.get(RECORD):
        words = {"cell": cell.get("id", ""), "outcome": report.outcome, "words": report.longreprtext[:WORDS]}
        with open(path, "a", encoding="utf-8") as file:
            file.write(json.dumps(words) + "\n")
