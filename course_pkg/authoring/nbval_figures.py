"""A plug-in of pytest: nbval compares the text of a figure, and leaves its SVG out.

A figure shows measured times, so its SVG differs in every run. nbval itself leaves only PNG and JPEG out.
"""

from __future__ import annotations

import pytest

SKIPPED = "image/svg+xml"


def pytest_collectstart(collector: pytest.Collector) -> None:
    """Add SVG to what nbval does not compare in this notebook (nbval's documented way)."""
    attributes = vars(collector)
    if "skip_compare" in attributes:
        attributes["skip_compare"] += (SKIPPED,)
