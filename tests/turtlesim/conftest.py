"""A turtle simulator that the tests of one module share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.ros import NodeProcess, PrivateMaster


@pytest.fixture(scope="module")
def simulator(master: PrivateMaster) -> Iterator[NodeProcess]:
    """Run `rosrun turtlesim turtlesim_node` until it answers."""
    with NodeProcess(["rosrun", "turtlesim", "turtlesim_node"]) as process:
        process.wait_for_service("/spawn")
        yield process
