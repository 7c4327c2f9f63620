"""Widgets as a page keeps them."""

from __future__ import annotations

from typing import Any

from course_pkg.site.exhibits import EXHIBIT, STATES, VIEW, set_out
from tests.authoring.books import book, code
from tests.site.shelves import result

PLOT = "course_pkg.panels.plot.view.Plot"


def saved(kind: str, **state: Any) -> dict[str, Any]:  # noqa: ANN401
    """Return a notebook with one view of a widget of this class."""
    view = result(text_plain="Plot()")
    view["data"][VIEW] = {"model_id": "m"}
    notebook = book(code("Plot()", outputs=[view]))
    model = {"state": {"_anywidget_id": kind, "_esm": "alert(1)", "_css": "*{}", "layout": "L", **state}}
    notebook["metadata"]["widgets"] = {STATES: {"state": {"m": model}}}
    return notebook


def data(notebook: dict[str, Any]) -> dict[str, Any]:
    """Return what the first output of the notebook holds."""
    held: dict[str, Any] = notebook["cells"][0]["outputs"][0]["data"]
    return held


def test_a_panel_is_kept_without_its_script() -> None:
    """Its name and its state are kept; code and sheet come from the package."""
    notebook = saved(PLOT, data={"x": 1})
    set_out(notebook)
    assert data(notebook) == {
        "text/plain": "Plot()",
        EXHIBIT: {"panel": "plot", "state": {"data": {"x": 1}}},
    }
    assert "widgets" not in notebook["metadata"]


def test_a_widget_of_another_kind_is_its_words() -> None:
    """Nobody but the package says what runs on a page."""
    for kind in ("elsewhere.Widget", "course_pkg.panels.plot.view.Plot2.x", "", f"{PLOT}\n"):
        notebook = saved(kind)
        set_out(notebook)
        assert data(notebook) == {"text/plain": "Plot()"}


def test_a_view_without_a_state_is_its_words() -> None:
    """As after a kernel that died before its widgets said how they are."""
    notebook = saved(PLOT)
    notebook["metadata"] = {}
    set_out(notebook)
    assert data(notebook) == {"text/plain": "Plot()"}
