"""What a student sees: panels in the notebook, each a pure model, a widget, and one ES module.

The names are looked up on first use, so that a model can be had without widgets and without ROS.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from course_pkg.panels.graph.picture import graph_text
    from course_pkg.panels.graph.view import GraphPanel
    from course_pkg.panels.prediction.view import predict, predictions
    from course_pkg.panels.service.view import ServicePanel

__all__ = ["GraphPanel", "ServicePanel", "graph_text", "predict", "predictions"]


def __getattr__(name: str) -> Any:  # noqa: ANN401 -- PEP 562: a module's attribute is of any type
    homes = {
        "GraphPanel": "graph.view",
        "ServicePanel": "service.view",
        "graph_text": "graph.picture",
        "predict": "prediction.view",
        "predictions": "prediction.view",
    }
    if name not in homes:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{homes[name]}"), name)
