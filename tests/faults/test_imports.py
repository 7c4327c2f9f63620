"""Where the faults stand in the order of imports."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

import course_pkg.faults

FOLDER = Path(course_pkg.faults.__file__).parent
BELOW = {"errors", "faults", "graph", "lazy"}
NAMES = re.compile(r"^\s*(?:from|import) course_pkg\.(\w+)", re.MULTILINE)


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.py")), ids=lambda path: path.stem)
def test_faults_know_the_graph_and_nothing_above(path: Path) -> None:
    """Panels and checks know the faults, not the other way round."""
    assert set(NAMES.findall(path.read_text("utf-8"))) <= BELOW


def test_a_fault_needs_no_rospy_in_the_kernel() -> None:
    """What is at fault runs in processes of its own: the kernel only starts and asks them."""
    code = "import sys, course_pkg.faults as f; f.caused, f.probe, f.names(); print('rospy' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=30, check=True
    )
    assert done.stdout.strip() == "False"
