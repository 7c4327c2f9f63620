"""What a graph panel showed, and when: what a page without a kernel plays again."""

from __future__ import annotations

import json
from collections import deque
from typing import Any, NamedTuple

State = dict[str, Any]

SCENE = ("drawing", "facts", "spaces", "trouble")  # what is large and changes seldom
MOMENTS = 150
BYTES = 200_000  # of all that is kept, as JSON


class _Scene(NamedTuple):
    shown: State
    size: int


class _Moment(NamedTuple):
    at: float
    scene: _Scene
    activity: State
    size: int


class History:
    """The moments at which what is shown became another; the newest, as many as are let.

    Nothing is kept before start() and after stop().
    """

    def __init__(self, moments: int = MOMENTS, size: int = BYTES) -> None:
        self._most, self._room = moments, size
        self._moments: deque[_Moment] = deque()
        self.running = False

    def start(self, at: float, **shown: object) -> None:
        """Begin anew at a time (s since the epoch), with what is shown then."""
        self._moments.clear()
        self.running = True
        self.note(at, **shown)

    def stop(self) -> None:
        """Keep nothing more."""
        self.running = False

    def note(self, at: float, **shown: object) -> None:
        """Keep what is shown from this time (s since the epoch) on: the parts of SCENE, and `activity`."""
        if not self.running:
            return
        scene = self._scene({name: shown[name] for name in SCENE})
        activity: State = dict(shown["activity"] or {})  # type: ignore[call-overload]
        if self._moments:
            last = self._moments[-1]
            if last.scene is scene and last.activity == activity:
                return
            at = max(at, last.at)  # a clock may be set back
        self._moments.append(_Moment(at, scene, activity, _size(activity)))
        while len(self._moments) > self._most or self._weight() > self._room:
            self._moments.popleft()

    def state(self, until: float) -> State:
        """Return what a page plays: {} where nothing changed before `until` (s since the epoch).

        `began` is the time of the first moment (s since the epoch), `length` that of all (ms), `scenes` the
        states that differ, `moments` a list of (ms since `began`, which scene, activity).
        """
        if len(self._moments) < 2:
            return {}
        began, scenes = self._moments[0].at, self._scenes()
        return {
            "began": round(began, 1),
            "length": _milliseconds(max(until, self._moments[-1].at) - began),
            "scenes": [each.shown for each in scenes],
            "moments": [
                [_milliseconds(each.at - began), scenes.index(each.scene), each.activity]
                for each in self._moments
            ],
        }

    def _scene(self, shown: State) -> _Scene:
        same = (each.scene for each in reversed(self._moments) if each.scene.shown == shown)
        return next(same, None) or _Scene(shown, _size(shown))

    def _scenes(self) -> list[_Scene]:
        """Return each scene once, in the order in which they came."""
        return list({id(each.scene): each.scene for each in self._moments}.values())

    def _weight(self) -> int:
        return sum(each.size for each in self._scenes()) + sum(each.size for each in self._moments)


def _size(shown: State) -> int:
    return len(json.dumps(shown))


def _milliseconds(seconds: float) -> int:
    return round(1000 * seconds)
