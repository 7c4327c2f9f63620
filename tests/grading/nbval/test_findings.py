"""Tests of finding(), which converts a message of nbval into a sentence for the student."""

from __future__ import annotations

import pytest

from course_pkg.grading.nbval.findings import OTHER, finding

START = "\x1b[91mNotebook cell execution failed\x1b[0m\n\x1b[94mCell 3: "


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("", ""),
        (
            f"{START}Cell execution caused an exception\n\nTraceback:\n"
            "\x1b[31mNameError\x1b[39m: name 'x' is not defined",
            "The cell raised NameError: name 'x' is not defined",
        ),
        (
            f"{START}Timeout of 40 seconds exceeded executing cell\n\nKeyboardInterrupt:",
            "The cell was stopped, because it ran for more than 40 s.",
        ),
        (
            "The cell gave no result within 160 s, so this cell and all cells after it have no result.",
            "The cell was stopped, because it ran for more than 160 s.",
        ),
        (
            f"{START}Cell outputs differ\n mismatch 'text/html'\n<p>cut",
            "The output of the cell is different from the output with the right answers.",
        ),
        (
            f"{START}Cell outputs differ\n\nMissing output fields from running code: {{'text/plain'}}",
            "With the right answers, this cell shows more output.",
        ),
        (
            "pytest plugin exception: Kernel dead on test start",
            "The cell was not run, because the kernel had ended in an earlier cell.",
        ),
        ("pytest plugin exception: b'<IDS|MSG>' is not in list", OTHER),
    ],
)
def test_a_finding_is_one_sentence(words: str, sentence: str) -> None:
    """Each finding is one sentence with the error or the time, without the output of pytest."""
    assert finding(words) == sentence
