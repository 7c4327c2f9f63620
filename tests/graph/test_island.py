"""An island is a graph of its own: what happens there harms nobody, and nothing of it stays."""

from __future__ import annotations

import gc
import subprocess
import time

import pytest

from course_pkg.errors import NodeFailed, UnknownExecutable
from course_pkg.graph import Island, MasterClient, PrivateMaster, look
from tests.support import eventually, process_state

pytestmark = pytest.mark.usefixtures("master")


def test_it_is_apart(master: PrivateMaster) -> None:
    """Its nodes are known to its own master, and to no other."""
    with Island() as island:
        island.run("course_pkg", "pulse")
        assert MasterClient(island.uri).system_state().nodes == ("/pulse",)
        assert look(master.uri).nodes == ()
        assert repr(island) == "<an island with a master and 1 programs>"


def test_a_stream_outlives_its_master() -> None:
    """What has found one another talks on; who comes later finds nobody."""
    with Island() as island:
        island.run("course_pkg", "pulse")
        echo = island.start("rostopic", "echo", "/pulse")
        eventually(lambda: "data" in echo.output())
        island.kill_master()
        before = echo.output().count("data")
        eventually(lambda: echo.output().count("data") >= before + 3)
        late = island.start("rostopic", "list")
        assert late.wait(10) != 0
        assert "Unable to communicate with master" in late.output()


def test_the_second_of_a_name_ends_the_first() -> None:
    """Every run is another process, also under the same name: the master tells the first to go."""
    with Island() as island:
        first, second = (island.run("course_pkg", "pulse") for _ in range(2))
        assert first.wait(10) == 0
        assert "new node registered with same name" in first.output()
        assert second.running


def test_nothing_stays() -> None:
    """Closing ends all, also what was killed before; a forgotten island closes itself."""
    island = Island()
    running, killed = (island.run("course_pkg", "pulse", f"__name:=pulse_{number}") for number in range(2))
    master = island._master.pid
    killed.kill()
    island.close()
    island.close()
    assert [process_state(pid) for pid in (running.pid, killed.pid, master)] == ["Z", "Z", "Z"]
    forgotten = Island().start("sleep", "60")
    gc.collect()
    assert not forgotten.running


def test_a_node_that_is_not_there_or_ends_is_told(master: PrivateMaster) -> None:
    """With what there is instead, and with what it printed."""
    started = time.monotonic()
    with Island() as island:
        with pytest.raises(UnknownExecutable, match="Did you mean 'pulse'"):
            island.run("course_pkg", "pulze")
        with pytest.raises(NodeFailed, match="usage: client"):
            island.run("course_pkg", "client")
    assert time.monotonic() - started < 10


def test_its_address_is_for_the_tools() -> None:
    """ROS_MASTER_URI leads any command there."""
    with Island() as island:
        island.run("course_pkg", "pulse")
        command = f"ROS_MASTER_URI={island.uri} rosnode list"
        done = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=20, check=True)  # noqa: S602
        assert done.stdout == "/pulse\n"
