"""Records what a graph panel shows; a page without a kernel can then play the recording."""

from __future__ import annotations

import json
from collections import deque
from typing import TYPE_CHECKING, NamedTuple, TypedDict

if TYPE_CHECKING:
    from course_pkg.panels.graph.activity import ActivityState
    from course_pkg.panels.graph.model import Scene

MOMENTS = 150
BYTES = 200_000  # The JSON text of a recording has at most this many bytes.


class HistoryState(TypedDict, total=False):
    """A recording for the page; the dict is empty if nothing changed during the recording.

    `began` is the time of the first entry (s since the epoch), and `length` is the length of the recording
    (ms). Each entry of `moments` is a tuple: the time in ms since `began`, the index in `scenes`, and the
    activity.
    """

    began: float
    length: int
    scenes: list[Scene]
    moments: list[tuple[int, int, ActivityState]]


class _Sized(NamedTuple):
    scene: Scene
    size: int


class _Moment(NamedTuple):
    at: float
    sized: _Sized
    activity: ActivityState
    size: int


class History:
    """The latest changes of the panel; `moments` is the maximum number of entries.

    `size` is the maximum size of the JSON text in bytes.

    Changes are recorded only between start() and stop().
    """

    def __init__(self, moments: int = MOMENTS, size: int = BYTES) -> None:
        self._most, self._room = moments, size
        self._moments: deque[_Moment] = deque()
        self.running = False

    def start(self, at: float, scene: Scene, activity: ActivityState) -> None:
        """Start a new recording at the time `at` (s since the epoch).

        The first entry of the recording contains `scene` and `activity`.
        """
        self._moments.clear()
        self.running = True
        self.add(at, scene, activity)

    def stop(self) -> None:
        """End the recording, but do not delete its entries."""
        self.running = False

    def add(self, at: float, scene: Scene, activity: ActivityState) -> None:
        """Record that the panel has shown `scene` and `activity` since the time `at` (s since the epoch)."""
        if not self.running:
            return
        sized = self._sized(scene)
        if self._moments:
            last = self._moments[-1]
            if last.sized is sized and last.activity == activity:
                return
            at = max(at, last.at)  # The times do not decrease, even if a user has set the system clock back.
        self._moments.append(_Moment(at, sized, activity, _size(activity)))
        while len(self._moments) > self._most or self._weight() > self._room:
            self._moments.popleft()

    def state(self, until: float) -> HistoryState:
        """Return the recording until the time `until` (s since the epoch), or {} if nothing has changed."""
        if len(self._moments) < 2:
            return {}
        began, scenes = self._moments[0].at, self._scenes()
        return {
            "began": round(began, 1),
            "length": _milliseconds(max(until, self._moments[-1].at) - began),
            "scenes": [each.scene for each in scenes],
            "moments": [
                (_milliseconds(each.at - began), scenes.index(each.sized), each.activity)
                for each in self._moments
            ],
        }

    def _sized(self, scene: Scene) -> _Sized:
        same = (each.sized for each in reversed(self._moments) if each.sized.scene == scene)
        return next(same, None) or _Sized(scene, _size(scene))

    def _scenes(self) -> list[_Sized]:
        """Return the scenes without duplicates, in the order of the recording."""
        return list({id(each.sized): each.sized for each in self._moments}.values())

    def _weight(self) -> int:
        return sum(each.size for each in self._scenes()) + sum(each.size for each in self._moments)


def _size(shown: Scene | ActivityState) -> int:
    return len(json.dumps(shown))


def _milliseconds(seconds: float) -> int:
    return round(1000 * seconds)
