"""Fixtures that tests of several parts share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.graph.master import PrivateMaster
from tests.kernel import Kernel


@pytest.fixture(scope="module")
def master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[PrivateMaster]:
    """A real master for one module of tests, on a port of its own, and the environment that leads to it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_LOG_DIR", str(tmp_path_factory.mktemp("ros")))
        patch.setenv("ROS_HOSTNAME", "localhost")
        patch.delenv("ROS_IP", raising=False)
        with PrivateMaster() as private:
            patch.setenv("ROS_MASTER_URI", private.uri)
            yield private


@pytest.fixture
def kernel(master: PrivateMaster) -> Iterator[Kernel]:
    """A process of its own that runs cells: rospy allows one node for each process, and starts it once."""
    with Kernel() as fresh:
        yield fresh
