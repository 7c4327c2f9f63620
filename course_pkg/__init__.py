"""A course on ROS 1 services; the notebooks import these names.

Each name is imported when it is first used. `import course_pkg` is therefore fast for nodes and tools.
"""

from pkgutil import extend_path
from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.checking import check
    from course_pkg.overview.notebook import predictions, progress
    from course_pkg.panels import (
        BreakIt,
        GraphPanel,
        ServicePanel,
        Timeline,
        TopicPanel,
        TurtlePanel,
        TypeBrowser,
        WireView,
        choose,
        predict,
    )
    from course_pkg.ros import join
    from course_pkg.ros.explain import explain

# catkin generates the module `course_pkg.srv` in a folder outside the checkout. The next line makes Python
# search that folder, too.
__path__ = extend_path(__path__, __name__)

__all__ = [
    "BreakIt",
    "GraphPanel",
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
    "predict",
    "predictions",
    "progress",
]

__getattr__ = lazily(
    __name__,
    {
        "checking": "check",
        "overview.notebook": "predictions progress",
        "ros": "join",
        "ros.explain": "explain",
        "panels": (
            "BreakIt GraphPanel ServicePanel Timeline TopicPanel TurtlePanel TypeBrowser WireView "
            "choose predict"
        ),
    },
)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
