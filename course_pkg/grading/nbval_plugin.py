"""A plug-in of pytest that says, after nbval has run a notebook of the course, how each part went.

It is feedback, made from what the notebook shows: a kernel can show anything. Where the variable
COURSE_NBVAL_RECORD names a file, every cell's outcome is appended to it, a JSON object a line.
"""

from __future__ import annotations

import json
import os
from collections.abc import Generator
from typing import Any

import pytest

from course_pkg.authoring.cells import check_of

RECORD = "COURSE_NBVAL_RECORD"
WORDS = 40000  # characters of a failure
LINES = pytest.StashKey[list[str]]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Note how a cell went; what is no cell is let through."""
    report = yield
    cell = getattr(item, "cell", None)
    if isinstance(cell, dict) and (report.when == "call" or report.outcome != "passed"):
        if check_of(cell):
            report.user_properties.append(("part", _headline(item, cell)))
        _record(cell, report)
    return report


def pytest_terminal_summary(terminalreporter: Any) -> None:  # noqa: ANN401 -- pytest gives it no public type
    """Show a line for each part."""
    reports = [each for group in terminalreporter.stats.values() for each in group]
    properties = [pair for each in reports for pair in getattr(each, "user_properties", [])]
    lines = sorted({words for key, words in properties if key == "part"})
    if lines:
        terminalreporter.section("parts of the course")
        for line in lines:
            terminalreporter.write_line(line)


def _headline(item: pytest.Item, cell: dict[str, Any]) -> str:
    """Return the first line of what the check showed."""
    for output in getattr(item, "test_outputs", None) or []:
        text = str(output.get("data", {}).get("text/plain", ""))
        if text.startswith(check_of(cell)):
            return text.splitlines()[0][:200]
    return f"{check_of(cell)} not examined"


def _record(cell: dict[str, Any], report: pytest.TestReport) -> None:
    if path := os.environ.get(RECORD):
        words = {"cell": cell.get("id", ""), "outcome": report.outcome, "words": report.longreprtext[:WORDS]}
        with open(path, "a", encoding="utf-8") as file:
            file.write(json.dumps(words) + "\n")
