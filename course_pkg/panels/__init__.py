"""Interactive panels for the notebooks, such as the graph panel and the service panel.

Each panel consists of a widget, a model of its state, and one ES module that runs in the browser. The model
needs no browser and no Jupyter kernel.

This package imports a panel only when a program first uses the panel's name, such as `GraphPanel`. Therefore,
a program can import a model on a machine without ipywidgets or ROS.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.panels.breakit.view import BreakIt
    from course_pkg.panels.choices.view import choose
    from course_pkg.panels.graph.picture import graph_text
    from course_pkg.panels.graph.view import GraphPanel
    from course_pkg.panels.prediction.view import predict
    from course_pkg.panels.service.view import ServicePanel
    from course_pkg.panels.timeline.view import Timeline
    from course_pkg.panels.timeline.waits import timeline_text
    from course_pkg.panels.topic.view import TopicPanel
    from course_pkg.panels.turtles.view import TurtlePanel
    from course_pkg.panels.types.view import TypeBrowser
    from course_pkg.panels.wire.view import WireView

__all__ = [
    "BreakIt",
    "GraphPanel",
    "ServicePanel",
    "Timeline",
    "TopicPanel",
    "TurtlePanel",
    "TypeBrowser",
    "WireView",
    "choose",
    "graph_text",
    "predict",
    "timeline_text",
]

__getattr__ = lazily(
    __name__,
    {
        "breakit.view": "BreakIt",
        "choices.view": "choose",
        "graph.picture": "graph_text",
        "graph.view": "GraphPanel",
        "prediction.view": "predict",
        "service.view": "ServicePanel",
        "timeline.waits": "timeline_text",
        "timeline.view": "Timeline",
        "topic.view": "TopicPanel",
        "turtles.view": "TurtlePanel",
        "types.view": "TypeBrowser",
        "wire.view": "WireView",
    },
)
