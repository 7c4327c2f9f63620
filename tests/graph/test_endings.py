"""Whatever was started ends with its owner, however that ends."""

from __future__ import annotations

import signal
import socket
import sys
from pathlib import Path

import pytest

from course_pkg.graph import Leash, MasterClient, NodeProcess, PrivateMaster
from course_pkg.graph.ports import family, listening_ports
from tests.kernel import Kernel
from tests.support import eventually, process_state, stopped

EVERYTHING = """
from course_pkg.graph import join
node = join("owner")
server = node.run("course_pkg", "server", "getGeometry:=other", name="other")
launched = node.launch("course_pkg", "geometry.launch")
launched.wait_for_service("/getGeometry")
server.wait_for_service("/other")
result = node.master
"""


def gone(pids: list[int]) -> bool:
    """Whether none of the processes is left; one that only waits to be collected counts as gone."""
    return all(process_state(pid) == "Z" for pid in pids)


def port_is_free(uri: str) -> bool:
    """Whether nobody listens at the port of the address."""
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", int(uri.rstrip("/").rpartition(":")[2]))) != 0


def test_killed_owner_of_a_private_master() -> None:
    """After SIGKILL of a kernel no process below it is left, roslaunch's nodes included, and no port held."""
    kernel = Kernel({"ROS_MASTER_URI": None})
    uri = kernel.run(EVERYTHING)
    pids = family(kernel.pid)
    assert len(pids) >= 8
    kernel.kill()
    eventually(lambda: gone(pids))
    assert port_is_free(uri)
    kernel.exit()


def test_killed_owner_on_a_shared_master(master: PrivateMaster) -> None:
    """After SIGKILL of a kernel on a master that lives on, none of its registrations is left there."""
    kernel = Kernel()
    kernel.run(EVERYTHING)
    pids = family(kernel.pid)
    kernel.kill()
    eventually(lambda: gone(pids))
    assert eventually(lambda: MasterClient(master.uri).system_state().nodes == ())
    kernel.exit()


DEAF = """
import signal, rospy
from std_msgs.msg import Empty as Message
from std_srvs.srv import Empty
rospy.init_node("deaf")
service = rospy.Service("/deaf", Empty, lambda request: [])
publisher, subscriber = rospy.Publisher("/said", Message), rospy.Subscriber("/heard", Message)
signal.signal(signal.SIGTERM, signal.SIG_IGN)
rospy.Service("/deafened", Empty, lambda request: [])
while True:
    signal.pause()
"""


def test_deaf_node_on_a_shared_master(master: PrivateMaster) -> None:
    """A node that hears no SIGTERM is killed some time after its owner, and no registration is left of it."""
    kernel = Kernel()
    kernel.run(f"""
import sys
from course_pkg.graph import NodeProcess
node = NodeProcess([sys.executable, "-c", {DEAF!r}])
node.wait_for_service("/deafened")
""")
    pids = family(kernel.pid)
    with NodeProcess.rosrun("course_pkg", "server") as other:
        other.wait_for_service("/getGeometry")
        kernel.kill()
        eventually(lambda: gone(pids))
        eventually(lambda: not MasterClient(master.uri).lookup_node("/deaf"))
        assert MasterClient(master.uri).system_state().nodes == ("/SERVER_NODE",)
    kernel.exit()


def test_graceful_end_leaves_nothing(master: PrivateMaster) -> None:
    """A kernel that ends by itself leaves neither a registration nor a process, and takes no time over it."""
    kernel = Kernel()
    kernel.run(EVERYTHING)
    pids = family(kernel.pid)
    kernel.exit(patience=5)
    assert MasterClient(master.uri).system_state().nodes == ()
    assert gone(pids)


def test_interrupt_leaves_the_nodes_alone(kernel: Kernel) -> None:
    """An interrupt of the kernel goes to its process group, and its nodes are not in it."""
    kernel.run(
        "from course_pkg.graph import join; node = join('owner'); server = node.run('course_pkg', 'server')"
    )
    kernel.run("server.wait_for_service('/getGeometry')")
    kernel.begin("import time; time.sleep(20)")
    kernel.interrupt()
    assert kernel.reply().error == "KeyboardInterrupt"
    assert kernel.run("result = server.running, repr(node)") == [True, "<node /owner>"]


def test_thread_that_started_a_node_may_end(kernel: Kernel) -> None:
    """A node started from a thread lives on when that thread has ended."""
    kernel.run("""
        import threading
        from course_pkg.graph import NodeProcess, join
        join("owner")
        held = []
        thread = threading.Thread(target=lambda: held.append(NodeProcess.rosrun("course_pkg", "server")))
        thread.start()
        thread.join()
        held[0].wait_for_service("/getGeometry")
    """)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_stubborn_descendants_are_killed(number: signal.Signals) -> None:
    """A grandchild in a session of its own that ignores every request is killed when its parent has ended."""
    stubborn = "import signal, time; [signal.signal(n, signal.SIG_IGN) for n in (2, 15)]; time.sleep(1000)"
    parent = f"""
import subprocess, sys, time
subprocess.Popen([sys.executable, "-c", {stubborn!r}], start_new_session=True)
time.sleep(1000)
"""
    leash = Leash([sys.executable, "-c", parent])
    pids = eventually(lambda: len(found := family(leash.pid)) == 2 and found)
    leash.signal(number)
    assert leash.wait(8)
    assert gone(pids)


def test_exit_status_is_passed_on() -> None:
    """The exit status of a command, or the signal that ended it, is what its owner sees."""
    for command, status in (("exit 3", 3), ("kill -9 $$", -9), ("true", 0)):
        leash = Leash(["sh", "-c", command])
        assert leash.wait(5)
        assert leash.returncode == status


def test_stopped_node_is_ended(master: PrivateMaster) -> None:
    """A node that is stopped by SIGSTOP ends when it is told to, and takes its registrations along."""
    with NodeProcess.rosrun("course_pkg", "server") as server:
        server.wait_for_service("/getGeometry")
        with stopped(server.pid):
            server.stop()
    assert MasterClient(master.uri).lookup_service("/getGeometry") is None


def test_everything_listens_on_loopback_only(kernel: Kernel) -> None:
    """No socket of a kernel, its master, its nodes or a launch listens anywhere but on 127.0.0.1."""
    kernel.run(EVERYTHING)
    ports = listening_ports(family(kernel.pid)) or frozenset()
    assert len(ports) >= 7
    tables = Path("/proc/net/tcp").read_text() + Path("/proc/net/tcp6").read_text()
    listeners = [line.split()[1].split(":") for line in tables.splitlines() if " 0A " in line]
    assert {address for address, port in listeners if int(port, 16) in ports} == {"0100007F"}
