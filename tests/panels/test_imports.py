"""What a model may need."""

from __future__ import annotations

import subprocess
import sys

import pytest

MODELS = [
    "service.model",
    "graph.model",
    "breakit.model",
    "choices.model",
    "graph.drawing",
    "plot.model",
    "prediction.model",
    "timeline.model",
    "timeline.text",
    "topic.model",
    "types.model",
]


@pytest.mark.parametrize("model", MODELS)
def test_a_model_needs_no_kernel_and_no_ros_node(model: str) -> None:
    """A panel's model imports neither rospy nor IPython nor the widgets."""
    names = "{'rospy', 'IPython', 'ipywidgets'} & set(sys.modules)"
    code = f"import sys, course_pkg.panels.{model}; print(sorted({names}))"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=30, check=True
    )
    assert done.stdout.strip() == "[]"
