"""The widget of the timeline; it only sends a recording to the page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from traitlets import Dict

from course_pkg.panels.panel import Panel
from course_pkg.panels.timeline.model import state
from course_pkg.panels.timeline.waits import timeline_text

if TYPE_CHECKING:
    from course_pkg.ros import Recording

HERE = Path(__file__).parent


class Timeline(Panel):
    """A sequence diagram of a recording: each node has rows, and time runs from left to right.

    `recording` comes from a block `with node.record() as recording: …` that has ended.
    """

    front_end: ClassVar[Path] = HERE / "timeline.js"
    style_sheet: ClassVar[Path] = HERE / "timeline.css"

    recorded = Dict(help="the recording, in columns; see model.py").tag(sync=True)

    def __init__(self, recording: Recording) -> None:
        super().__init__()
        self._recording = recording
        self.publish(recorded=state(recording))

    @property
    def text(self) -> str:
        """Sentences about which node waited for which node. The sentences are the same in every run."""
        return timeline_text(self._recording)

    def __repr__(self) -> str:
        return "Timeline()"
