"""What is done with a panel for the site, in the order in which it has to be."""

from __future__ import annotations

from typing import Any

import pytest

from course_pkg.errors import CourseError, NothingPicked
from course_pkg.site.rehearsal import rehearse, rehearsed
from tests.authoring.books import book, code


class Noted:
    """A panel that writes down what is done with it; `trouble` is raised by what records."""

    def __init__(self, trouble: CourseError | None = None) -> None:
        self.done: list[Any] = []
        self.trouble = trouble

    def received(self, kind: str, content: dict[str, Any]) -> None:
        """As from a page."""
        self.done.append((kind, content))

    def record(self, requests: list[dict[str, Any]]) -> None:
        """As a service panel's."""
        self.done.append(requests)
        if self.trouble:
            raise self.trouble

    def shown(self) -> None:
        """Begin."""
        self.done.append("shown")

    def hidden(self) -> None:
        """End."""
        self.done.append("hidden")


@pytest.mark.parametrize("trouble", [None, NothingPicked("There is no server.")])
def test_a_service_is_picked_before_it_is_recorded(trouble: CourseError | None) -> None:
    """A student's notebook may have no server for it yet: then nothing is recorded, and it goes on."""
    panel = Noted(trouble)
    rehearse(panel, {"pick": "/add_two_ints", "record": [{"a": 1, "b": 2}]})
    assert panel.done == [("pick", {"service": "/add_two_ints"}), [{"a": 1, "b": 2}]]


def test_a_panel_is_shown_for_a_while() -> None:
    """Where the notebook has no node of its own, nobody calls meanwhile."""
    panel = Noted()
    rehearse(panel, {"watch": 0, "calls": [["/switch/report", "std_srvs/Trigger", {}]]})
    assert panel.done == ["shown", "hidden"]


def test_the_panel_is_found_where_a_notebook_has_a_name_of_one_stroke() -> None:
    """`for _ in …` takes IPython's own `_` away for the rest of a notebook."""
    notebook = book(code("for _ in range(2): pass"), code("GraphPanel()", id="graphpanel"))
    added = rehearsed("03_choose", notebook)["cells"][-1]
    panel, results = Noted(), {1: "earlier"}
    names = {"_": 1, "_oh": results | {2: panel}, "__builtins__": __builtins__}
    exec(added["source"].replace("'watch': 10", "'watch': 0"), names)  # noqa: S102 -- it is our own
    assert panel.done == ["shown", "hidden"]
