"""What is known of a counter from a stream of frames, and a bounded wait for somebody there. No ROS."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

from course_pkg.errors import CameraSilent

SILENCE = 1.0  # s without a good frame, after which nobody can tell


class Eye:
    """Knows what the newest good frame shows; `changed` is notified of each good frame."""

    def __init__(self, sees: Callable[[Any], bool]) -> None:
        self.changed = threading.Condition()
        self._sees = sees
        self._seen = False
        self._told = -float("inf")  # when the newest good frame came, in s of time.monotonic()

    def hear(self, frame: Any) -> None:  # noqa: ANN401 -- a class that genpy generates
        """Take in a frame; one that is malformed says nothing."""
        try:
            seen = self._sees(frame)
        except ValueError:
            return
        with self.changed:
            self._seen, self._told = seen, time.monotonic()
            self.changed.notify_all()

    def look(self) -> bool | None:
        """Return whether somebody is there; None where no good frame came in the last second."""
        return self._seen if time.monotonic() - self._told <= SILENCE else None


def await_customer(eye: Eye, patience: float) -> bool:
    """Return whether somebody was seen: as soon as that is so, after `patience` s at the latest.

    Raises CameraSilent where, when the time is over, nobody can tell.
    """
    with eye.changed:
        found = eye.changed.wait_for(eye.look, timeout=patience)
    if found is None:
        raise CameraSilent(f"the camera has said nothing for {SILENCE:g} s, so nobody can tell")
    return bool(found)
