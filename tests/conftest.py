"""Fixtures that tests of several parts share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from course_pkg.graph.master import PrivateMaster
from tests.browser.chromium import chromium
from tests.kernel import Kernel

ANSWERS, NOTEBOOKS = "tests/examiner/test_answers.py", "tests/notebooks/test_validation.py"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keep a file's tests on one worker (`--dist loadgroup`), and begin with the two files that take longest.

    The tests of a file share a master, or a browser.
    """
    files = {item: item.path.relative_to(item.config.rootpath).as_posix() for item in items}
    items.sort(key=lambda item: (files[item] != ANSWERS, files[item] != NOTEBOOKS))
    for item, file in files.items():
        item.add_marker(pytest.mark.xdist_group(file))


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Start a browser, once for all tests of a worker: a second one would not start beside it."""
    with chromium() as started:
        yield started


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
