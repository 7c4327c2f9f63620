"""Nodes as processes: found, waited for, and ended with their registrations."""

from __future__ import annotations

import signal
import sys
import time

import pytest

from course_pkg.errors import GraphError, NodeFailed, UnknownExecutable
from course_pkg.graph import MasterClient, NodeProcess, PrivateMaster
from tests.kernel import Kernel
from tests.support import eventually

pytestmark = pytest.mark.usefixtures("master")


@pytest.mark.parametrize(
    ("package", "program", "told"),
    [
        ("no_such_package", "server", "no package 'no_such_package'"),
        ("course_pkg", "sever", "Did you mean 'server'?"),
        ("course_pkg", "zzz", "It has: "),
    ],
)
def test_missing_program(package: str, program: str, told: str) -> None:
    """A package or a program that is not there is named at once, with what is there."""
    with pytest.raises(UnknownExecutable) as error:
        NodeProcess.rosrun(package, program)
    assert told in str(error.value)


def test_command_that_cannot_be_started() -> None:
    """A command that does not exist is an error of the call, and leaves no process."""
    with pytest.raises(GraphError, match="No such file"):
        NodeProcess(["/no/such/command"])


def test_output_is_kept() -> None:
    """What a node prints, to stdout and stderr, is there while it runs and after it has ended."""
    with NodeProcess(
        [sys.executable, "-c", "import sys; print('out'); print('err', file=sys.stderr)"]
    ) as process:
        assert process.wait(5) == 0
        assert sorted(process.output().split()) == ["err", "out"]
    assert "out" in process.output()


def test_waiting_fails_fast_when_the_node_dies() -> None:
    """Waiting for a service of a process that ends is over when it ends, and shows the end of its output."""
    with NodeProcess([sys.executable, "-c", "raise SystemExit('no luck today')"]) as process:
        started = time.monotonic()
        with pytest.raises(NodeFailed, match="no luck today") as error:
            process.wait_for_service("/never", timeout=20)
        assert time.monotonic() - started < 5
        assert error.value.returncode == 1


def test_waiting_has_a_limit() -> None:
    """Waiting for a service that never comes is over after the time given, and the process goes on."""
    with NodeProcess.rosrun("course_pkg", "pulse") as process:
        with pytest.raises(NodeFailed, match=r"after 0\.2 s"):
            process.wait_for_service("/never", timeout=0.2)
        assert process.running


def test_waiting_for_words() -> None:
    """A wait for what a program prints ends when it is printed, and fails when it cannot come any more."""
    script = "import time; print('first'); time.sleep(60)"
    with NodeProcess([sys.executable, "-c", script]) as process:
        process.wait_for_output("first")
        with pytest.raises(NodeFailed, match=r"has not printed 'second' after 0\.2 s"):
            process.wait_for_output("second", timeout=0.2)
    with (
        NodeProcess([sys.executable, "-c", "raise SystemExit('no luck today')"]) as process,
        pytest.raises(NodeFailed, match=r"never printed 'second'\. .*\nno luck today"),
    ):
        process.wait_for_output("second")


def test_waiting_is_for_this_process(kernel: Kernel) -> None:
    """A name that another node serves already does not count: the wait is for this process to serve it."""
    kernel.run("""
        from course_pkg.srv import geometry
        from course_pkg.graph import join
        node = join("first")
        node.serve("/contested", geometry, lambda request: (-1, -1))
        other = node.run("course_pkg", "server", "getGeometry:=/contested")
        other.wait_for_service("/contested")
        assert node.call("/contested", geometry, 1, 2, 3).area == 2
    """)


def test_stopping_withdraws(master: PrivateMaster) -> None:
    """A process that was stopped is off the graph when stop() returns, also if it had to be killed."""
    deaf = """
import rospy, signal, threading
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
rospy.init_node("deaf", disable_signals=True)
threading.Event().wait()
"""
    client = MasterClient(master.uri)
    process = NodeProcess([sys.executable, "-c", deaf])
    process.wait_for_service("/deaf/get_loggers")
    process.stop(grace=0.2)
    assert not process.running
    assert client.system_state().nodes == ()
    process.stop()


def test_killing_leaves_the_registration(master: PrivateMaster) -> None:
    """What kill() leaves at the master can be studied; the next node of the name takes over."""
    process = NodeProcess.rosrun("course_pkg", "server")
    process.wait_for_service("/getGeometry")
    process.kill()
    assert process.returncode == -signal.SIGKILL
    assert MasterClient(master.uri).lookup_service("/getGeometry") is not None
    with NodeProcess.rosrun("course_pkg", "server") as successor:
        successor.wait_for_service("/getGeometry")
    assert MasterClient(master.uri).lookup_service("/getGeometry") is None


def test_running_again_replaces(kernel: Kernel) -> None:
    """A cell that runs a node, run again, ends the former process; another name is another process."""
    kernel.run("""
        from course_pkg.graph import join
        node = join("student")
        first = node.run("course_pkg", "server")
        first.wait_for_service("/getGeometry")
        second = node.run("course_pkg", "server")
        second.wait_for_service("/getGeometry")
        third = node.run("course_pkg", "server", "getGeometry:=/third", name="third")
        third.wait_for_service("/third")
        assert (first.running, second.running, third.running) == (False, True, True)
        assert (repr(first), repr(third)) == ("<course_pkg/server, ended>", "<third, running>")
    """)


def test_one_program_in_two_namespaces_is_two_nodes(kernel: Kernel) -> None:
    """A namespace among the arguments makes another node beside the first; the same again replaces it."""
    kernel.run("""
        from course_pkg.graph import join
        node = join("student")
        left, right = (node.run("course_pkg", "server", f"__ns:=/{side}") for side in ("left", "right"))
        left.wait_for_service("/left/getGeometry")
        right.wait_for_service("/right/getGeometry")
        again = node.run("course_pkg", "server", "__ns:=/left")
        again.wait_for_service("/left/getGeometry")
        assert (left.running, right.running, again.running) == (False, True, True)
    """)


def test_launch_file() -> None:
    """A launch file runs with its nodes, and they end with it."""
    with NodeProcess.roslaunch("course_pkg", "geometry.launch", "client:=true") as process:
        process.wait_for_service("/getGeometry")
        eventually(lambda: "area: 6.24\n" in process.output() and "volume: 55.54\n" in process.output())
