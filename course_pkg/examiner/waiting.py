"""Waiting for what a student's nodes do in their own time, as long as it may take and no longer."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

Seen = TypeVar("Seen")
LOOK = 0.03  # s between looks, where one costs little


def until(condition: Callable[[], Seen], within: float, every: float = LOOK) -> Seen:
    """Return the first true value of `condition`, asked every so many s, or what it is after `within` s."""
    deadline = time.monotonic() + within
    while not (seen := condition()) and time.monotonic() < deadline:
        time.sleep(every)
    return seen
