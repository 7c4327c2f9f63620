"""A fixture that runs a turtle simulator for all tests of a module."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.ros import NodeProcess, PrivateMaster


@pytest.fixture(scope="module")
def simulator(master: PrivateMaster) -> Iterator[NodeProcess]:
    """Run `rosrun turtlesim turtlesim_node` until its services are available."""
    with NodeProcess(["rosrun", "turtlesim", "turtlesim_node"]) as process:
        process.wait_for_service("/spawn")
        yield process
