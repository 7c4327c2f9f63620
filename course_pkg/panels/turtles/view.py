"""The turtle panel as a widget."""

from __future__ import annotations

import math
import struct
import threading
import time
from enum import Enum
from pathlib import Path
from typing import Any, ClassVar

from traitlets import Dict

from course_pkg.errors import GraphError
from course_pkg.graph import MasterClient, master_uri
from course_pkg.graph.bulk import BulkReader
from course_pkg.panels.panel import Panel
from course_pkg.panels.turtles.ink import Colour, Sight
from course_pkg.panels.turtles.tape import BACKGROUND, Tape

HERE = Path(__file__).parent
TYPES = ("turtlesim/Pose", "turtlesim/Color")
POSE = struct.Struct("<5f")
TELL = 0.1  # s between messages to the page
KEEP = 5.0  # s between states kept where no page shows the panel
ALONE = 300.0  # s after which a panel that no page shows stops watching


class Page(Enum):
    """Who looks at the panel."""

    NONE = "none"
    PAUSED = "paused"  # a page has it, out of sight
    OPEN = "open"


class TurtlePanel(Panel):
    """Every turtle of the graph with its trail, as it moves, of this course's simulator or the real one.

    It listens to poses and colours only, so it knows of pens, `clear` and `reset` what these tell. What it
    has seen is kept and can be played again. It records from the start, also where no page shows it.
    """

    front_end: ClassVar[Path] = HERE / "turtles.js"
    style_sheet: ClassVar[Path] = HERE / "turtles.css"

    tape: Dict[str, Any] = Dict(help="what the turtles did; see tape.py").tag(sync=True)

    def __init__(self) -> None:
        super().__init__()
        self._began = time.monotonic()
        self._tape = Tape(_background())
        self._colours: dict[str, Colour] = {}
        self._lock = threading.Lock()
        self._page = Page.NONE
        self._told = self._edition = 0  # how much of the tape the page has
        self._telling = self._keeping = self._left = self._began
        self._reader = BulkReader(TYPES, self._heard, self._missing, self._looked)
        self.publish(tape=self._tape.state())
        self._reader.start()

    def shown(self) -> None:
        """Give the page all there is, and go on from there."""
        self._reader.start()
        self._send_all()

    def hidden(self) -> None:
        """Keep what was seen; without a page it is watched for a while longer."""
        self._page, self._left = Page.NONE, time.monotonic()
        self._keep()

    def received(self, kind: str, content: dict[str, Any]) -> None:  # noqa: ARG002
        """Answer a page that has lost the thread, or that is out of sight for a while."""
        if kind == "resend":
            self._send_all()
        elif kind == "pause":
            self._page = Page.PAUSED

    def close(self) -> None:
        """Stop watching."""
        self._reader.stop()
        super().close()

    def __repr__(self) -> str:
        return "TurtlePanel()"

    def _heard(self, topic: str, messages: list[bytes]) -> None:
        name, _, what = topic.rpartition("/")
        name = name.lstrip("/")
        if what == "color_sensor":
            self._colours[name] = (messages[-1][0], messages[-1][1], messages[-1][2])
            return
        x, y, theta, speed, _turn = POSE.unpack(messages[-1])
        if all(map(math.isfinite, (x, y, theta, speed))):
            with self._lock:
                self._tape.see(self._now(), name, Sight(x, y, theta, speed, self._colours.get(name)))

    def _missing(self, topic: str) -> None:
        if topic.endswith("/pose"):
            with self._lock:
                self._tape.miss(self._now(), topic.removesuffix("/pose").lstrip("/"))

    def _looked(self) -> None:
        now = time.monotonic()
        if self._page is Page.OPEN and now - self._telling >= TELL:
            self._telling = now
            self._tell()
        elif self._page is Page.NONE and now - self._keeping >= KEEP:
            self._keep()
            if now - self._left > ALONE:
                self._reader.stop()

    def _tell(self) -> None:
        with self._lock:
            whole = self._tape.edition != self._edition
            start, rows = self._told, self._tape.rows[self._told :]
            self._told += len(rows)
            known = {"names": list(self._tape.names), "palette": list(self._tape.palette)}
        if whole:
            self._send_all()
        elif rows:
            self._post({"kind": "rows", "start": start, "rows": rows, "now": self._now(), **known})

    def _send_all(self) -> None:
        self._page = Page.OPEN
        with self._lock:
            state = self._tape.state()
            self._told, self._edition = len(state["rows"]), state["edition"]
        self._post({"kind": "tape", "tape": state, "now": self._now()})

    def _post(self, content: dict[str, Any]) -> None:
        with self.turn:
            self.send(content)

    def _keep(self) -> None:
        self._keeping = time.monotonic()
        with self._lock:
            state = self._tape.state()
        if state["rows"] != self.tape.get("rows"):
            self.publish(tape=state)

    def _now(self) -> int:
        return round((time.monotonic() - self._began) * 1000)


def _background() -> Colour:
    """Return the colour of new paper, as the simulator's parameters have it, or the usual one."""
    try:
        own = MasterClient(master_uri(), 0.5).get_param("/turtlesim", {})
    except GraphError:
        return BACKGROUND
    values = [own.get(f"background_{each}") if isinstance(own, dict) else None for each in "rgb"]
    if not all(isinstance(value, int) for value in values):
        return BACKGROUND
    red, green, blue = (int(value) % 256 for value in values if value is not None)
    return red, green, blue
