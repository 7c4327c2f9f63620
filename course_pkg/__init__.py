"""A course on ROS 1 services.

A notebook needs these names; each is looked up when it is first used, so that
`import course_pkg` stays cheap for nodes and tools, which need none of them.
"""

from pkgutil import extend_path
from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.building import my_workspace
    from course_pkg.examiner import check, results
    from course_pkg.graph import join
    from course_pkg.graph.explanations import explain
    from course_pkg.panels import (
        BreakIt,
        GraphPanel,
        Plot,
        ServicePanel,
        Timeline,
        TopicPanel,
        TurtlePanel,
        TypeBrowser,
        WireView,
        choose,
        predict,
        predictions,
        show_image,
        timeline_text,
    )

# catkin generates `course_pkg.srv` into another folder; without this, the checkout hides it.
__path__ = extend_path(__path__, __name__)

__all__ = [
    "BreakIt",
    "GraphPanel",
    "Plot",
    "ServicePanel",
    "Timeline",
    "TopicPanel",
    "TurtlePanel",
    "TypeBrowser",
    "WireView",
    "check",
    "choose",
    "explain",
    "join",
    "my_workspace",
    "predict",
    "predictions",
    "results",
    "show_image",
    "timeline_text",
]

__getattr__ = lazily(
    __name__,
    {
        "building": "my_workspace",
        "examiner": "check results",
        "graph": "join",
        "graph.explanations": "explain",
        "panels": (
            "BreakIt GraphPanel Plot ServicePanel Timeline TopicPanel TurtlePanel TypeBrowser WireView "
            "choose predict predictions show_image timeline_text"
        ),
    },
)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
