"""A course on ROS 1 services.

A notebook needs these names; each is looked up when it is first used, so that
`import course_pkg` stays cheap for nodes and tools, which need none of them.
"""

from importlib import import_module
from pkgutil import extend_path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from course_pkg.examiner import check, results
    from course_pkg.graph import join
    from course_pkg.panels import GraphPanel, ServicePanel, predict, predictions

# catkin generates `course_pkg.srv` into another folder; without this, the checkout hides it.
__path__ = extend_path(__path__, __name__)

__all__ = ["GraphPanel", "ServicePanel", "check", "join", "predict", "predictions", "results"]


def __getattr__(name: str) -> Any:  # noqa: ANN401 -- PEP 562: a module's attribute is of any type
    homes = {
        "check": "course_pkg.examiner",
        "results": "course_pkg.examiner",
        "join": "course_pkg.graph",
        "GraphPanel": "course_pkg.panels",
        "ServicePanel": "course_pkg.panels",
        "predict": "course_pkg.panels",
        "predictions": "course_pkg.panels",
    }
    if name not in homes:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(homes[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
