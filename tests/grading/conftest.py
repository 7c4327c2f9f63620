"""Fixtures for the tests of grading."""

from __future__ import annotations

import pytest

from course_pkg.grading.walls import refusal


@pytest.fixture(scope="session")
def walls() -> None:
    """Skip, with the reason, on a machine that has no walls; `course grade` refuses there, too."""
    if words := refusal():
        pytest.skip(words)
