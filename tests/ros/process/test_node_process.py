"""Tests of nodes as processes, and of private graphs."""

from __future__ import annotations

import gc
import signal
import subprocess
import sys
import time

import pytest

from course_pkg.errors import GraphError, NodeFailed, UnknownExecutable
from course_pkg.ros import MasterClient, NodeProcess, PrivateGraph, PrivateMaster, look
from tests.kernel import Kernel
from tests.support import eventually, process_state

pytestmark = pytest.mark.usefixtures("master")


@pytest.mark.parametrize(
    ("package", "program", "message"),
    [
        ("no_such_package", "server", "no package 'no_such_package'"),
        ("course_pkg", "sever", "Did you mean 'server'?"),
        ("course_pkg", "zzz", "The package has these programs: "),
    ],
)
def test_missing_program(package: str, program: str, message: str) -> None:
    """If a package or program is unknown, the error message contains similar names."""
    with pytest.raises(UnknownExecutable) as error:
        NodeProcess.rosrun(package, program)
    assert message in str(error.value)


def test_command_that_cannot_be_started() -> None:
    """An unknown command raises GraphError."""
    with pytest.raises(GraphError, match="No such file"):
        NodeProcess(["/no/such/command"])


def test_output_is_kept() -> None:
    """output() contains stdout and stderr, even after the exit of the process."""
    with NodeProcess(
        [sys.executable, "-c", "import sys; print('out'); print('err', file=sys.stderr)"]
    ) as process:
        assert process.wait(5) == 0
        assert sorted(process.output().split()) == ["err", "out"]
    assert "out" in process.output()


def test_waiting_ends_when_the_node_ends() -> None:
    """If the process exits, wait_for_service() raises NodeFailed with the last output."""
    with NodeProcess([sys.executable, "-c", "raise SystemExit('no luck today')"]) as process:
        started = time.monotonic()
        with pytest.raises(NodeFailed, match="no luck today") as error:
            process.wait_for_service("/never", timeout=20)
        assert time.monotonic() - started < 5
        assert error.value.returncode == 1


def test_waiting_has_a_limit() -> None:
    """If the service never appears, wait_for_service() raises NodeFailed at the timeout."""
    with NodeProcess.rosrun("course_pkg", "pulse") as process:
        with pytest.raises(NodeFailed, match=r"after 0\.2 s"):
            process.wait_for_service("/never", timeout=0.2)
        assert process.running


def test_waiting_for_output() -> None:
    """wait_for_output() returns when the text is printed, and fails at the timeout."""
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


def test_waiting_checks_the_process(kernel: Kernel) -> None:
    """wait_for_service() ignores the service of another node, and waits for the new process."""
    kernel.run("""
        import rospy
        from course_pkg.srv import geometry
        from course_pkg.ros import join
        node = join("first")
        rospy.Service("/contested", geometry, lambda request: (-1, -1))
        other = node.run("course_pkg", "server", "getGeometry:=/contested")
        other.wait_for_service("/contested")
        assert node.call("/contested", geometry, 1, 2, 3).area == 2
    """)


def test_stop_unregisters(master: PrivateMaster) -> None:
    """After stop(), the process has no registrations, even if stop() had to kill the process."""
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


def test_stop_unregisters_a_node_that_registers_meanwhile(master: PrivateMaster) -> None:
    """If the process registers a service during stop(), this service is unregistered too."""
    late = """
import os, rosgraph, signal, socket
listener = socket.create_server(("127.0.0.1", 0))
uri = f"http://localhost:{listener.getsockname()[1]}/"
def register(*_):
    rosgraph.Master("/late", os.environ["ROS_MASTER_URI"]).registerPublisher("/late", "std_msgs/Empty", uri)
    print("registered", flush=True)
    os._exit(0)
signal.signal(signal.SIGINT, register)
print("ready", flush=True)
signal.pause()
"""
    process = NodeProcess([sys.executable, "-c", late])
    process.wait_for_output("ready")
    process.stop()
    assert "registered" in process.output()
    assert MasterClient(master.uri).system_state().nodes == ()


def test_killing_leaves_the_registration(master: PrivateMaster) -> None:
    """After kill(), the registrations stay at the master until a node with the same name starts."""
    process = NodeProcess.rosrun("course_pkg", "server")
    process.wait_for_service("/getGeometry")
    process.kill()
    assert process.returncode == -signal.SIGKILL
    assert MasterClient(master.uri).lookup_service("/getGeometry") is not None
    with NodeProcess.rosrun("course_pkg", "server") as successor:
        successor.wait_for_service("/getGeometry")
    assert MasterClient(master.uri).lookup_service("/getGeometry") is None


def test_running_again_replaces(kernel: Kernel) -> None:
    """run() ends an earlier process that has the same node name, but no other process."""
    kernel.run("""
        from course_pkg.ros import join
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
    """A program can run in two namespaces at the same time."""
    kernel.run("""
        from course_pkg.ros import join
        node = join("student")
        left, right = (node.run("course_pkg", "server", f"__ns:=/{side}") for side in ("left", "right"))
        left.wait_for_service("/left/getGeometry")
        right.wait_for_service("/right/getGeometry")
        again = node.run("course_pkg", "server", "__ns:=/left")
        again.wait_for_service("/left/getGeometry")
        assert (left.running, right.running, again.running) == (False, True, True)
    """)


def test_launch_file() -> None:
    """A launch file starts its nodes with the given arguments."""
    with NodeProcess.roslaunch("course_pkg", "geometry.launch", "client:=true") as process:
        process.wait_for_service("/getGeometry")
        eventually(lambda: "area: 6.24\n" in process.output() and "volume: 55.54\n" in process.output())


def test_a_private_graph_is_separate(master: PrivateMaster) -> None:
    """The nodes of a private graph are registered only at the master of this graph."""
    with PrivateGraph() as graph:
        graph.run("course_pkg", "pulse")
        assert MasterClient(graph.uri).system_state().nodes == ("/pulse",)
        assert look(master.uri).nodes == ()
        assert repr(graph) == "<a private graph with a master and 1 programs>"


def test_messages_continue_without_the_master() -> None:
    """Connected nodes exchange messages even after the end of their master."""
    with PrivateGraph() as graph:
        graph.run("course_pkg", "pulse")
        echo = graph.start("rostopic", "echo", "/pulse")
        eventually(lambda: "data" in echo.output())
        graph.kill_master()
        before = echo.output().count("data")
        eventually(lambda: echo.output().count("data") >= before + 3)
        late = graph.start("rostopic", "list")
        assert late.wait(10) != 0
        assert "Unable to communicate with master" in late.output()


def test_the_second_node_with_a_name_ends_the_first() -> None:
    """If a second node has the same name, the master shuts down the first node."""
    with PrivateGraph() as graph:
        first, second = (graph.run("course_pkg", "pulse") for _ in range(2))
        assert first.wait(10) == 0
        assert "new node registered with same name" in first.output()
        assert second.running


def test_close_ends_everything_of_a_private_graph() -> None:
    """close() ends all programs and the master of a private graph."""
    graph = PrivateGraph()
    running, killed = (graph.run("course_pkg", "pulse", f"__name:=pulse_{number}") for number in range(2))
    master = graph._master.pid
    killed.kill()
    graph.close()
    graph.close()
    assert [process_state(pid) for pid in (running.pid, killed.pid, master)] == ["Z", "Z", "Z"]
    forgotten = PrivateGraph().start("sleep", "60")
    gc.collect()
    assert not forgotten.running


def test_a_private_graph_reports_a_node_that_is_missing_or_ends(master: PrivateMaster) -> None:
    """If a program is unknown, the error of run() contains similar names.

    If a program exits immediately, the error of run() contains the program's output.
    """
    started = time.monotonic()
    with PrivateGraph() as graph:
        with pytest.raises(UnknownExecutable, match="Did you mean 'pulse'"):
            graph.run("course_pkg", "pulze")
        with pytest.raises(NodeFailed, match="usage: client"):
            graph.run("course_pkg", "client")
    assert time.monotonic() - started < 10


def test_the_tools_use_the_address_of_a_private_graph() -> None:
    """A command with the graph's address in ROS_MASTER_URI uses this graph."""
    with PrivateGraph() as graph:
        graph.run("course_pkg", "pulse")
        command = f"ROS_MASTER_URI={graph.uri} rosnode list"
        done = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=20, check=True)  # noqa: S602
        assert done.stdout == "/pulse\n"
