"""When `course sync` stores a solution notebook, each panel in the outputs gets a picture."""

from __future__ import annotations

import copy

import pytest

from course_pkg.authoring.cells import Notebook
from course_pkg.authoring.normalise import tidy
from course_pkg.authoring.pictures import MADE_BY, SVG, add_pictures
from course_pkg.authoring.widgets import STATES, VIEW
from tests.authoring.books import book, code

QUESTION = {"part": "question", "question": "Does it wait?", "choices": ["yes", "no"], "answer": ""}
TURTLES = {"background": [69, 86, 255], "names": [], "palette": [], "rows": [], "length": 0, "edition": 0}


def executed(plot: str, *, source: str = "plot()", panel: str = "prediction") -> Notebook:
    """Return an executed notebook with two cells: a panel and a plot."""
    view = {"text/plain": "Panel()", VIEW: {"model_id": "m"}}
    shown = {"output_type": "execute_result", "data": view, "metadata": {}, "execution_count": 1}
    drawn = {"output_type": "display_data", "data": {"text/plain": "<Figure>", SVG: plot}, "metadata": {}}
    notebook = book(code("Panel()", id="a", outputs=[shown]), code(source, id="b", outputs=[drawn]))
    state = {**QUESTION, "recorded": TURTLES, "_anywidget_id": f"course_pkg.panels.{panel}.view.Panel"}
    notebook["metadata"]["widgets"] = {STATES: {"state": {"m": {"state": state}}}}
    return notebook


def stored(notebook: Notebook, before: Notebook) -> Notebook:
    """Return the stored form of `notebook`; `before` is the solution that was stored earlier."""
    notebook = copy.deepcopy(notebook)
    add_pictures(notebook, before)
    tidy(notebook)
    return notebook


def test_a_panel_gets_a_picture_beside_its_text() -> None:
    """A stored panel has a picture and a text, but no widget view."""
    notebook = stored(executed("<svg>1</svg>"), book())
    (output,) = notebook["cells"][0]["outputs"]
    assert set(output["data"]) == {"text/plain", SVG}
    assert output["metadata"] == {}
    assert "<title>Prediction: Does it wait? Choices: yes, no.</title>" in str(output["data"][SVG])


def test_a_plot_stays_while_nothing_changed() -> None:
    """If the code and the text output are unchanged, the stored plot stays."""
    first = stored(executed("<svg>1</svg>"), book())
    assert first["cells"][1]["outputs"][0]["metadata"][SVG][MADE_BY]
    assert stored(executed("<svg>2</svg>"), first) == first


@pytest.mark.parametrize("change", ["source", "text", "earlier cell", "no digest"])
def test_a_plot_is_drawn_anew_after_a_change(change: str) -> None:
    """If the code or the text output changes, the new plot replaces the stored plot."""
    first = stored(executed("<svg>1</svg>"), book())
    again = executed("<svg>2</svg>", source="plot(2)" if change == "source" else "plot()")
    if change == "text":
        again["cells"][1]["outputs"][0]["data"]["text/plain"] = "<Figure 2>"
    elif change == "earlier cell":
        again["cells"][0]["source"] = "Panel(2)"
    elif change == "no digest":
        first["cells"][1]["outputs"][0]["metadata"] = {}
    assert stored(again, first)["cells"][1]["outputs"][0]["data"][SVG] == "<svg>2</svg>"


def test_only_a_measured_picture_of_a_panel_stays() -> None:
    """A new run replaces the stored picture of a prediction, but not the stored picture of a recording."""
    for panel, stays in (("prediction", False), ("turtles", True)):
        first = stored(executed("<svg>1</svg>", panel=panel), book())
        first["cells"][0]["outputs"][0]["data"][SVG] = "<svg>old</svg>"
        again = stored(executed("<svg>1</svg>", panel=panel), first)
        assert (again["cells"][0]["outputs"][0]["data"][SVG] == "<svg>old</svg>") is stays


def test_a_widget_of_another_library_gets_no_picture() -> None:
    """Only panels of the course get a picture; a widget of another library gets no picture."""
    notebook = executed("<svg>1</svg>")
    notebook["metadata"]["widgets"][STATES]["state"]["m"]["state"]["_anywidget_id"] = "another.Widget"
    assert set(stored(notebook, book())["cells"][0]["outputs"][0]["data"]) == {"text/plain"}
