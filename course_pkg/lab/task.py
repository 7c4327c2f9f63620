"""What `course lab` tells the process of its server."""

from __future__ import annotations

import json
from typing import NamedTuple
from urllib.parse import quote

VARIABLE = "COURSE_LAB"  # which holds a task, for arguments can be read by every user of the machine


class Task(NamedTuple):
    """What to serve, and to whom."""

    socket: int  # the descriptor that listens
    token: str
    notebook: str  # to open, relative to the checkout, or empty
    page: str  # the file in which JupyterLab's page is kept
    ready: str  # the file to make once the server is up

    @property
    def path(self) -> str:
        """The address of the page below the server's."""
        return f"/lab/tree/{quote(self.notebook)}" if self.notebook else "/lab"

    def as_text(self) -> str:
        """Return what the variable holds."""
        return json.dumps(self._asdict())
