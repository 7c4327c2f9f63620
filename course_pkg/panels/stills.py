"""The still picture of each panel, which a page without widgets shows instead of the panel.

A picture depends only on the traits of the panel. So it is drawn outside the kernel when a notebook is
stored, and a student's notebook spends no time on it.
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
    """The function that draws a panel's picture. `measured` means that the picture shows measured times."""

    draw: Callable[[State], str]
    measured: bool = False

    @property
    def code(self) -> str:
        """The source code that draws the picture; if it changes, a measured picture is drawn again."""
        files = (sys.modules[self.draw.__module__].__file__, paper.__file__)
        return "".join(Path(str(file)).read_text("utf-8") for file in files)


# The keys are the folders of the panels. A saved state names its panel by the same folder.
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
