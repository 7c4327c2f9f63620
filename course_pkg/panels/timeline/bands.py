"""Joins short, neighbouring events into bands for the still picture; bands.js does the same for the page."""

from __future__ import annotations

from dataclasses import dataclass, field

from course_pkg.panels.timeline.scene import Event, Scene

# A picture shows events as one band if their widths and the distances between them are less than `CLOSE` px.
CLOSE = 3.0
MANY = 5  # A band contains at least this many calls or messages.
CALLS, REQUESTS = "calls", "requests"
WHAT = {
    "lookup": CALLS,
    "connect": CALLS,
    "request": CALLS,
    "wait": CALLS,
    "response": CALLS,
    "handler": REQUESTS,
    "publish": "messages",
    "callback": "callbacks",
}


@dataclass
class Band:
    """A group of neighbouring events of one kind; `count` is the number of calls or messages in the group."""

    what: str
    kind: str
    left: float
    right: float
    top: float
    height: float
    count: int = 0
    events: list[int] = field(default_factory=list)
    key: int = -1

    def take(self, event: Event) -> None:
        """Add an event."""
        self.events.append(event.number)
        self.right = max(self.right, event.right)
        self.count += event.key != self.key
        self.key = event.key


def bands_of(scene: Scene) -> list[Band]:
    """Return the bands of the whole recording."""
    latest: dict[tuple[int, int, int, str], Band] = {}
    bands: list[Band] = []
    for event in scene.events:
        what = WHAT.get(event.kind, "")
        if not what or event.right - event.left >= CLOSE:
            continue
        place = (event.lane, event.row, event.depth, what)
        band = latest.get(place)
        if band is None or event.left - band.right >= CLOSE:
            band = Band(what, event.kind, event.left, event.right, event.top, event.height)
            latest[place] = band
            bands.append(band)
        band.take(event)
    return [band for band in bands if band.count >= MANY]
