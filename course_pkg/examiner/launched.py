"""What a launch file brings up on a master of its own, and what roslaunch says where it does not."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from contextlib import suppress

from course_pkg.errors import GraphError
from course_pkg.examiner.waiting import until
from course_pkg.graph.snapshot import Snapshot, look

LOOK = 0.1  # s between looks at a whole graph
COLOUR = re.compile(r"\x1b\[\d*m")


def becomes(uri: str, condition: Callable[[Snapshot], object], within: float) -> bool:
    """Return whether `condition` holds for the graph of the master at `uri`, as soon as it does.

    At the latest after `within` s. There may be no master yet.
    """

    def holds() -> bool:
        with suppress(GraphError):  # its master has not come up yet
            return bool(condition(look(uri)))
        return False

    return until(holds, within, LOOK)


def telling_line(printed: str) -> str:
    """Return the last line that tells of an error, or else the last line; without colours and this folder."""
    lines = [line.strip() for line in COLOUR.sub("", printed).splitlines() if line.strip()]
    telling = [line for line in lines if "rror" in line or "annot" in line or "nvalid" in line]
    return (telling or lines or ["nothing"])[-1].replace(f"{os.getcwd().rstrip('/')}/", "/")
