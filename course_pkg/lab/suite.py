"""`course test`: lint, types, spelling and the tests."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path


def run_suite(arguments: Sequence[str]) -> int:
    """Run every check of the repository, all of them even where one fails; 0 if all is well."""
    root = Path(__file__).parents[2]
    return subprocess.call([sys.executable, "-m", "pytest", *arguments], cwd=root)
