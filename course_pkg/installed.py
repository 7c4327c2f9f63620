"""Only this module decides whether the package is in a checkout or in a shared installation.

In a checkout, the notebooks are next to the package, and one user owns all files. A shared installation
(`course install`) is read-only, and each user has a separate folder with notebooks, workspace and results.
"""

from __future__ import annotations

import os
from pathlib import Path

RECORD = "installation.json"  # This file is in each complete version of a shared installation.
# This folder is in the user's own folder. It contains the results, the settings of JupyterLab, and logs.
DATA = ".course"


def version_folder(checkout: Path) -> Path | None:
    """Return the installed version that contains the checkout, or None if the checkout is not installed."""
    return checkout.parent if (checkout.parent / RECORD).is_file() else None


def own_folder(checkout: Path) -> Path:
    """Return the folder with the user's notebooks and workspace. In a checkout, the result is the checkout.

    For a shared installation, the result is the folder in the variable COURSE_HOME, or ~/ros-course.
    """
    if version_folder(checkout) is None:
        return checkout
    given = os.environ.get("COURSE_HOME") or "~/ros-course"
    return Path(os.path.abspath(os.path.expanduser(given)))
