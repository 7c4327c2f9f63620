"""The still picture of each panel, for pages without widgets.

A picture depends only on the traits of the panel. It can therefore be drawn outside the kernel, when a
notebook is saved.
"""

from __future__ import annotations

import ast
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

DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


class Still(NamedTuple):
    """The function that draws the picture of a panel.

    `measured` is True if the picture shows measured times.
    """

    draw: Callable[[State], str]
    measured: bool = False

    @property
    def code(self) -> str:
        """The source code of the panel's modules and of paper.py, without comments and docstrings.

        If this source code changes, a picture with measured times is drawn again.
        """
        folder = Path(str(sys.modules[self.draw.__module__].__file__)).parent
        files = (*sorted(folder.glob("*.py")), Path(paper.__file__))
        return "\n".join(_without_docstrings(file.read_text("utf-8")) for file in files)


def _without_docstrings(source: str) -> str:
    """Return the source code of a module without comments and docstrings."""
    module = ast.parse(source)
    for node in ast.walk(module):
        if isinstance(node, DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            node.body = node.body[1:] or [ast.Pass()]
    return ast.unparse(module)


# The keys of STILLS are the names of the panels' folders. The saved state of a panel's widget contains the
# name of its folder.
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
