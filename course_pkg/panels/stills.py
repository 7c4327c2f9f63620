"""The still picture of each panel: what a page without widgets shows in its place.

A picture is a pure function of the panel's traits. So it is drawn when a notebook is stored, outside of the
kernel, and costs a student's notebook nothing.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from course_pkg.panels import paper
from course_pkg.panels.breakit.still import still as breakit
from course_pkg.panels.choices.still import still as choices
from course_pkg.panels.graph.still import still as graph
from course_pkg.panels.paper import State
from course_pkg.panels.prediction.still import still as prediction
from course_pkg.panels.service.still import still as service
from course_pkg.panels.timeline.still import still as timeline
from course_pkg.panels.topic.still import still as topic
from course_pkg.panels.turtles.still import still as turtles
from course_pkg.panels.types.still import still as types
from course_pkg.panels.wire.still import still as wire


class Still(NamedTuple):
    """How the picture of a panel is drawn, and whether it shows measured times, which differ in each run."""

    draw: Callable[[State], str]
    measured: bool = False

    @property
    def code(self) -> str:
        """The source of the function; when it changes, a measured picture has to be drawn again."""
        files = (sys.modules[self.draw.__module__].__file__, paper.__file__)
        return "".join(Path(str(file)).read_text("utf-8") for file in files)


# By the folder of the panel, which is also the name by which a saved state tells which panel it is.
STILLS = {
    "breakit": Still(breakit),
    "choices": Still(choices),
    "graph": Still(graph),
    "prediction": Still(prediction),
    "service": Still(service),
    "timeline": Still(timeline, measured=True),
    "topic": Still(topic),
    "turtles": Still(turtles, measured=True),
    "types": Still(types),
    "wire": Still(wire),
}
