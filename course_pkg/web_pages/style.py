"""The style sheet of a page: the common colours and rules, then the page's own rules."""

from __future__ import annotations

from pathlib import Path

COMMON = Path(__file__).with_name("common.css")


def style_sheet(own: Path) -> str:
    """Return the text of the common style sheet, followed by the text of the file `own`."""
    return COMMON.read_text("utf-8") + own.read_text("utf-8")
