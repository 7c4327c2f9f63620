"""Fixtures that tests in several folders use."""

from __future__ import annotations

import signal
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from course_pkg.ros.process.master import PrivateMaster
from course_pkg.ros.process.node_process import NodeProcess
from course_pkg.sandbox.linux.bubblewrap import refusal
from tests.browser.chromium import chromium
from tests.kernel import Kernel

ANSWERS, NOTEBOOKS = "tests/checking/answers/test_answers.py", "tests/notebooks/test_validation.py"
LAB = "JupyterLab"  # All tests with JupyterLab belong to this group.


def pytest_configure() -> None:
    """Restore the default handlers of signals that a shell disables for background commands."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGQUIT, signal.SIG_DFL)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


# This function must run first, because a hook of pytest-xdist with the same name reads the groups.
@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put tests into groups. pytest-xdist runs each group on one worker.

    The tests of a file form a group, because these tests share a master. The tests of example answers form a
    group. All tests with JupyterLab form a group, because loading JupyterLab's page is slow.
    """
    for item in items:
        group = item.path.relative_to(item.config.rootpath).as_posix()
        if group == NOTEBOOKS:
            group = item.name
        elif "lab" in getattr(item, "fixturenames", ()):
            group = LAB
        item.add_marker(pytest.mark.xdist_group(group))
    items.sort(key=_place)


def _place(item: pytest.Item) -> int:
    group = next(item.iter_markers("xdist_group")).args[0]
    if group in (ANSWERS, LAB):
        return 0
    return 1 if item.path.match(NOTEBOOKS) else 2 if item.path.match("tests/site/*") else 3


@pytest.fixture(scope="session", autouse=True)
def state_home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Use a separate state folder and separate graphs for the commands of this pytest worker."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        yield


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Start one browser for all tests of a pytest worker."""
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[PrivateMaster]:
    """Start a real master for the tests of one module, and set the ROS variables for this master."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_LOG_DIR", str(tmp_path_factory.mktemp("ros")))
        patch.setenv("ROS_HOSTNAME", "localhost")
        patch.delenv("ROS_IP", raising=False)
        with PrivateMaster() as private:
            patch.setenv("ROS_MASTER_URI", private.uri)
            yield private


@pytest.fixture
def kernel(master: PrivateMaster) -> Iterator[Kernel]:
    """Start a new process that runs cells.

    rospy can start only once in a process.
    """
    with Kernel() as fresh:
        yield fresh


@pytest.fixture(scope="module")
def server(master: PrivateMaster) -> Iterator[NodeProcess]:
    """Run the course's geometry server for the tests of one module."""
    assert master.uri
    server = NodeProcess.rosrun("course_pkg", "server")
    server.wait_for_service("/getGeometry", timeout=20)
    yield server
    server.stop()


@pytest.fixture(scope="session")
def sandbox() -> None:
    """Skip the test if this machine cannot create a sandbox."""
    if reason := refusal():
        pytest.skip(reason)
