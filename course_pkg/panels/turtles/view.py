"""The widget of the turtle panel."""

from __future__ import annotations

import math
import struct
import threading
import time
from enum import Enum
from pathlib import Path
from typing import ClassVar

from traitlets import Dict

from course_pkg.errors import GraphError
from course_pkg.panels.panel import PageMessage, Panel
from course_pkg.panels.turtles.pen import Colour, Observation
from course_pkg.panels.turtles.recording import BACKGROUND, TurtleRecording
from course_pkg.ros import MasterClient, master_uri
from course_pkg.ros.protocol.xmlrpc import number
from course_pkg.ros.topic.bulk_reader import BulkReader

HERE = Path(__file__).parent
TYPES = ("turtlesim/Pose", "turtlesim/Color")
POSE = struct.Struct("<5f")
SEND = 0.1  # SEND is the time in s between two messages to the page.
KEEP = 5.0  # While no page shows the panel, the panel saves its state every `KEEP` s.
ALONE = 300.0  # The recording stops if no page has shown the panel for this time (s).


class Page(Enum):
    """Whether a page contains the panel, and whether the reader sees the panel."""

    NONE = "none"
    PAUSED = "paused"  # A page contains the panel, but the reader has scrolled the panel out of view.
    OPEN = "open"


class TurtlePanel(Panel):
    """A picture of all turtles on the graph, with their trails.

    The simulator of the turtles can be the course's own simulator or the original turtlesim.

    The panel subscribes only to the topics of the poses and of the colour sensors. From these messages, the
    panel derives the states of the pens, and calls of `clear` and `reset`. The recording begins when the
    panel is created, even if no page shows the panel.
    """

    front_end: ClassVar[Path] = HERE / "turtles.js"
    style_sheet: ClassVar[Path] = HERE / "turtles.css"

    recorded = Dict(help="what the turtles did; see recording.py").tag(sync=True)

    def __init__(self) -> None:
        super().__init__()
        self._began = time.monotonic()
        self._recording = TurtleRecording(_background())
        self._colours: dict[str, Colour] = {}
        self._lock = threading.Lock()
        self._page = Page.NONE
        # `_sent` is the number of rows that the page has received, and `_edition` is the edition of these
        # rows.
        self._sent = self._edition = 0
        self._last_sent = self._last_kept = self._left = self._began
        self._reader = BulkReader(TYPES, self._received, self._missing, self._polled)
        self.publish(recorded=self._recording.state())
        self._reader.start()

    def shown(self) -> None:
        """Send the whole recording to the page; new rows follow later."""
        self._reader.start()
        self._send_all()

    def hidden(self) -> None:
        """Save the recording. If no page shows the panel for `ALONE` seconds, the recording stops."""
        self._page, self._left = Page.NONE, time.monotonic()
        self._keep()

    def received(self, kind: str, content: PageMessage) -> None:  # noqa: ARG002
        """Handle a message from the page: rows are missing, or the panel is no longer in the visible area."""
        if kind == "resend":
            self._send_all()
        elif kind == "pause":
            self._page = Page.PAUSED

    def close(self) -> None:
        """Stop recording."""
        self._reader.stop()
        super().close()

    def __repr__(self) -> str:
        return "TurtlePanel()"

    def _received(self, topic: str, messages: list[bytes]) -> None:
        name, _, what = topic.rpartition("/")
        name = name.lstrip("/")
        if what == "color_sensor":
            self._colours[name] = (messages[-1][0], messages[-1][1], messages[-1][2])
            return
        x, y, theta, speed, _turn = POSE.unpack(messages[-1])
        if all(map(math.isfinite, (x, y, theta, speed))):
            with self._lock:
                self._recording.see(
                    self._now(), name, Observation(x, y, theta, speed, self._colours.get(name))
                )

    def _missing(self, topic: str) -> None:
        if topic.endswith("/pose"):
            with self._lock:
                self._recording.miss(self._now(), topic.removesuffix("/pose").lstrip("/"))

    def _polled(self) -> None:
        now = time.monotonic()
        if self._page is Page.OPEN and now - self._last_sent >= SEND:
            self._last_sent = now
            self._send_new()
        elif self._page is Page.NONE and now - self._last_kept >= KEEP:
            self._keep()
            if now - self._left > ALONE:
                self._reader.stop()

    def _send_new(self) -> None:
        with self._lock:
            whole = self._recording.edition != self._edition
            start, rows = self._sent, self._recording.rows[self._sent :]
            self._sent += len(rows)
            known = {"names": list(self._recording.names), "palette": list(self._recording.palette)}
        if whole:
            self._send_all()
        elif rows:
            self._post({"kind": "rows", "start": start, "rows": rows, "now": self._now(), **known})

    def _send_all(self) -> None:
        self._page = Page.OPEN
        with self._lock:
            state = self._recording.state()
            self._sent, self._edition = len(state["rows"]), state["edition"]
        self._post({"kind": "recording", "recording": state, "now": self._now()})

    def _post(self, content: PageMessage) -> None:
        with self.turn:
            self.send(content)

    def _keep(self) -> None:
        self._last_kept = time.monotonic()
        with self._lock:
            state = self._recording.state()
        kept = (len(self.recorded.get("rows", ())), self.recorded.get("edition"))
        if kept != (len(state["rows"]), state["edition"]):
            self.publish(recorded=state)

    def _now(self) -> int:
        return round((time.monotonic() - self._began) * 1000)


def _background() -> Colour:
    """Return the background colour from the simulator's parameters, or the default colour."""
    try:
        own = MasterClient(master_uri(), 0.5).get_param("/turtlesim", {})
    except GraphError:
        return BACKGROUND
    values = [own.get(f"background_{each}") if isinstance(own, dict) else None for each in "rgb"]
    try:
        red, green, blue = (int(number(value)) % 256 for value in values)
    except TypeError:
        return BACKGROUND
    return red, green, blue
