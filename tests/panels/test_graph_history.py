"""What the graph panel keeps to be played again: every change, once, and never more than it may."""

from __future__ import annotations

import json
from typing import Any

from course_pkg.panels.graph.history import BYTES, MOMENTS, History

BEGAN = 1_800_000_000.0  # s since the epoch


def shown(drawing: str = "<svg/>", **activity: Any) -> dict[str, Any]:  # noqa: ANN401 - as traits
    """Return what a panel shows."""
    return {"drawing": drawing, "facts": [], "spaces": [], "trouble": "", "activity": activity}


def filled(*sights: dict[str, Any], **limits: int) -> History:
    """Return what is kept of these sights, one a second."""
    history = History(**limits)
    history.start(BEGAN, **sights[0])
    for number, sight in enumerate(sights[1:], start=1):
        history.note(BEGAN + number, **sight)
    return history


def test_what_does_not_change_is_kept_once() -> None:
    """A graph in which nothing happens is a picture, and nothing to play."""
    assert filled(*[shown()] * 5).state(BEGAN + 9) == {}


def test_moments_and_their_scenes() -> None:
    """A drawing that comes back is not kept a second time; times are ms since the first moment."""
    kept = filled(shown("a"), shown("a", notes={"topic /x": "2 Hz"}), shown("b"), shown("a"))
    state = kept.state(BEGAN + 8.5)
    assert state["began"] == BEGAN
    assert state["length"] == 8500
    assert [scene["drawing"] for scene in state["scenes"]] == ["a", "b"]
    assert [moment[:2] for moment in state["moments"]] == [[0, 0], [1000, 0], [2000, 1], [3000, 0]]
    assert state["moments"][1][2] == {"notes": {"topic /x": "2 Hz"}}


def test_a_clock_that_is_set_back_turns_nothing_round() -> None:
    """Moments stay in the order in which they were."""
    history = filled(shown("a"), shown("b"))
    history.note(BEGAN - 3600, **shown("c"))
    assert [moment[0] for moment in history.state(BEGAN - 3600)["moments"]] == [0, 1000, 1000]


def test_nothing_is_kept_before_the_start_and_after_the_end() -> None:
    """A panel without a page gathers nothing; a new start forgets what was."""
    history = History()
    history.note(BEGAN, **shown("a"))
    history.start(BEGAN, **shown("b"))
    history.note(BEGAN + 1, **shown("c"))
    history.stop()
    history.note(BEGAN + 2, **shown("d"))
    assert [scene["drawing"] for scene in history.state(BEGAN + 2)["scenes"]] == ["b", "c"]
    history.start(BEGAN + 3, **shown("e"))
    assert history.state(BEGAN + 4) == {}


def test_it_is_bounded_in_number() -> None:
    """After hours the newest moments are there, and the first of them is the beginning."""
    kept = filled(*(shown("a", turn=turn) for turn in range(3 * MOMENTS)))
    moments = kept.state(BEGAN + 3 * MOMENTS)["moments"]
    assert len(moments) == MOMENTS
    assert (moments[0][0], moments[-1][2]) == (0, {"turn": 3 * MOMENTS - 1})


def test_it_is_bounded_in_bytes() -> None:
    """Large drawings that differ push out the oldest, with their moments."""
    kept = filled(*(shown(f"{turn:020000}") for turn in range(40)))
    state = kept.state(BEGAN + 40)
    assert len(json.dumps(state)) < 1.1 * BYTES
    assert state["scenes"][-1]["drawing"] == f"{39:020000}"
    assert len(state["scenes"]) == len(state["moments"]) > 5


def test_a_drawing_that_is_too_large_is_not_played() -> None:
    """It is no reason to fail, or to keep more than is let."""
    assert filled(shown("a"), shown("x" * (BYTES + 1)), shown("y" * (BYTES + 1))).state(BEGAN + 3) == {}
