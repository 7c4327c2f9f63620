"""A pytest plug-in that reports the result of each part, after nbval has run a notebook of the course.

The run of pytest fails if the check of a part failed, did not run, or is missing. The result is only
feedback: it depends on the notebook's outputs, which student code can forge. The environment variable
COURSE_NBVAL_RECORD can contain the name of a file. Then one JSON object per cell is appended to this file.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Generator, Iterable, Sequence

import pytest

from course_pkg.authoring.cells import Cell, check_of, exercise_of
from course_pkg.checking.parts import chapters, parts_of

RECORD = "COURSE_NBVAL_RECORD"
WORDS = 40000  # WORDS is the maximum number of characters of a failure's text.
# PART and MISSING are the names of user properties in a pytest report.
PART, MISSING = "part", "missing"
CALL = re.compile(r"""^\s*check\(["'](\d\d\.\d+)["']\)""", re.MULTILINE)
SEEN = pytest.StashKey[bool]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Record the result of a notebook cell; all other reports are ignored."""
    report = yield
    cell: Cell | None = getattr(item, "cell", None)
    if cell is not None and (report.when == "call" or report.outcome != "passed"):
        if part := check_of(cell):
            headline = _headline(item, cell)
            report.user_properties.append((PART, headline))
            if report.outcome == "passed" and not _is_passed(headline):
                report.outcome = "failed"
                report.longrepr = f"{headline}. The output of the check of {part} shows the reason."
        report.user_properties += [(MISSING, part) for part in _missing(item)]
        _record(cell, report)
    return report


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """Set the exit status of pytest to "failed" if a part did not pass."""
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if session.exitstatus == pytest.ExitCode.OK and reporter and _lacking(_lines(reporter)):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print a line with the result of each part."""
    lines = _lines(terminalreporter)
    if lines:
        terminalreporter.section("parts of the course")
        for line in lines:
            terminalreporter.write_line(line)
        lacking = _lacking(lines)
        terminalreporter.write_line(
            f"{len(lines)} parts, and {len(lacking)} of them did not pass."
            if lacking
            else f"{len(lines)} parts, and all of them passed."
        )


def _lines(reporter: pytest.TerminalReporter) -> list[str]:
    """Return the first line of each check's report, in the order of the parts."""
    reports = [each for group in reporter.stats.values() for each in group]
    properties = [pair for each in reports for pair in getattr(each, "user_properties", [])]
    missing = {
        (f"{part} not examined: its check is not in the notebook")
        for key, part in properties
        if key == MISSING
    }
    return sorted({*(text for key, text in properties if key == PART), *missing})


def _lacking(lines: Iterable[str]) -> list[str]:
    return [line for line in lines if not _is_passed(line)]


def _is_passed(headline: str) -> bool:
    return headline.split(":")[0].endswith(" passed")


def _missing(item: pytest.Item) -> Sequence[str]:
    """Return the parts that the notebook does not check.

    Only the first call for a notebook returns parts; later calls return an empty sequence.
    """
    notebook = item.parent
    if notebook is None or notebook.stash.get(SEEN, False):
        return ()
    notebook.stash[SEEN] = True
    cells = [cell for cell in getattr(notebook, "nb", {}).get("cells", []) if cell["cell_type"] == "code"]
    checked = {part for cell in cells for part in (check_of(cell), *CALL.findall(cell["source"])) if part}
    known = {part.partition(".")[0] for part in (*checked, *map(exercise_of, cells)) if part}
    expected = [part.check for chapter in sorted(known & set(chapters())) for part in parts_of(chapter)]
    return [part for part in expected if part not in checked]


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
