"""A pytest plug-in: nbval ignores the SVG image in an output, but compares the text of the output.

A figure shows measured times, so its SVG differs in every run. nbval itself ignores only PNG and JPEG images.
"""

from __future__ import annotations

import pytest

SKIPPED = "image/svg+xml"


def pytest_collectstart(collector: pytest.Collector) -> None:
    """Add SVG to `skip_compare`, the output types that nbval ignores; nbval documents this attribute."""
    attributes = vars(collector)
    if "skip_compare" in attributes:
        attributes["skip_compare"] += (SKIPPED,)
