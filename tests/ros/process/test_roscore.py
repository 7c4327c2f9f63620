"""Tests of Roscore, which starts the same nodes and parameters as roscore."""

from __future__ import annotations

import os
import signal
from pathlib import Path
from uuid import UUID

import psutil
import pytest

from course_pkg.errors import SetupError
from course_pkg.ros import MasterClient, Roscore, find_or_start_master
from course_pkg.ros.process.supervisor import descendants
from tests.kernel import Kernel
from tests.support import eventually, process_state, terminal

PUBLISH = """
import rospy
rospy.init_node("talker")
rospy.loginfo("the battery is low")
"""


def processes(pids: list[int]) -> list[psutil.Process]:
    """Return the given processes that run the node /rosout."""
    return [psutil.Process(pid) for pid in pids if psutil.Process(pid).name() == "rosout"]


@pytest.fixture
def core(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Roscore:
    """Return a Roscore that is not started."""
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    return Roscore()


def test_the_graph_is_the_same_as_with_roscore(core: Roscore) -> None:
    """The nodes, services and parameters of a Roscore are the same as with the command roscore."""
    with core:
        client = MasterClient(core.uri)
        state = client.system_state()
        assert state.nodes == ("/rosout",)
        assert tuple(state.services) == ("/rosout/get_loggers", "/rosout/set_logger_level")
        assert (tuple(state.publishers), tuple(state.subscribers)) == (("/rosout_agg",), ("/rosout",))
        assert client.get_param("/rosdistro") == terminal("rosversion", "-d").stdout
        assert client.get_param("/rosversion") == terminal("rosversion", "roslaunch").stdout
        assert UUID(str(client.get_param("/run_id")))


def test_what_a_node_logs_is_in_the_log_of_rosout(core: Roscore, tmp_path: Path) -> None:
    """/rosout writes the log messages of all nodes to the file rosout.log."""
    with core, Kernel({"ROS_MASTER_URI": core.uri}) as kernel:
        kernel.run(PUBLISH)
        log = tmp_path / "rosout.log"
        assert eventually(lambda: kernel.run("rospy.loginfo('again')") or "/talker" in log.read_text())


def test_it_listens_on_loopback_only(core: Roscore) -> None:
    """/rosout listens only on 127.0.0.1.

    The library that is built from loopback.c replaces bind() in roscpp's XML-RPC server.
    """
    with core:
        [rosout] = processes(descendants(os.getpid()))
        sockets = [each for each in rosout.net_connections("inet") if each.status == psutil.CONN_LISTEN]
        assert sockets
        assert {each.laddr.ip for each in sockets} == {"127.0.0.1"}


def test_stop_ends_all_processes_and_start_works_again(core: Roscore) -> None:
    """stop() ends the master and /rosout, and start() works again after stop()."""
    core.start()
    first, pids = core.uri, descendants(os.getpid())
    assert processes(pids)
    core.stop()
    core.stop()
    assert not processes(descendants(os.getpid()))
    with core:
        assert MasterClient(core.uri).system_state().nodes == ("/rosout",)
        assert core.uri != first


def test_without_the_node_the_master_ends(
    core: Roscore, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If the package rosout is missing, start() raises an error with advice."""
    monkeypatch.setattr("course_pkg.ros.process.roscore._prefix", lambda: tmp_path)
    with pytest.raises(SetupError, match="course doctor"):
        core.start()
    assert not core.running


def test_a_kernel_without_a_master_starts_a_roscore(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without ROS_MASTER_URI, find_or_start_master() starts a Roscore."""
    monkeypatch.delenv("ROS_MASTER_URI", raising=False)
    monkeypatch.setenv("ROS_HOSTNAME", "localhost")
    found = find_or_start_master()
    assert isinstance(found, Roscore)
    assert os.environ["ROS_MASTER_URI"] == found.uri
    found.stop()


def test_rosout_ends_with_a_killed_owner(tmp_path: Path) -> None:
    """After SIGKILL of the kernel that started /rosout, /rosout exits."""
    kernel = Kernel({"ROS_MASTER_URI": None, "ROS_LOG_DIR": str(tmp_path)})
    kernel.run("from course_pkg.ros import join; node = join('owner')")
    pids = descendants(kernel.pid)
    assert processes(pids)
    os.kill(kernel.pid, signal.SIGKILL)
    eventually(lambda: all(process_state(pid) == "Z" for pid in pids))
    kernel.exit()
