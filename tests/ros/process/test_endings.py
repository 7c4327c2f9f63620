"""Tests that child processes end when their parent process ends."""

from __future__ import annotations

import os
import pty
import select
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from course_pkg.ros import MasterClient, NodeProcess, PrivateMaster, SupervisedProcess
from course_pkg.ros.process.supervised import listening_ports
from course_pkg.ros.process.supervisor import descendants
from tests.kernel import Kernel
from tests.support import eventually, process_state, stopped

EVERYTHING = """
from course_pkg.ros import NodeProcess, join
node = join("owner")
server = node.run("course_pkg", "server", "getGeometry:=other", name="other")
launched = NodeProcess.roslaunch("course_pkg", "geometry.launch")
node.keep(launched)
launched.wait_for_service("/getGeometry")
server.wait_for_service("/other")
result = node.master
"""


def family(pid: int) -> list[int]:
    """Return the process and all its descendants."""
    return [pid, *descendants(pid)]


def gone(pids: list[int]) -> bool:
    """Return whether all given processes have exited. A zombie counts as exited."""
    return all(process_state(pid) == "Z" for pid in pids)


def port_is_free(uri: str) -> bool:
    """Return whether no process listens on the port of an address."""
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", int(uri.rstrip("/").rpartition(":")[2]))) != 0


def test_killed_owner_of_a_private_master() -> None:
    """After SIGKILL of a kernel, all its descendants exit, and its ports are free."""
    kernel = Kernel({"ROS_MASTER_URI": None})
    uri = kernel.run(EVERYTHING)
    pids = family(kernel.pid)
    assert len(pids) >= 8
    kernel.kill()
    eventually(lambda: gone(pids))
    assert port_is_free(uri)
    kernel.exit()


def test_killed_owner_on_a_shared_master(master: PrivateMaster) -> None:
    """After SIGKILL of a kernel, its registrations at a shared master are removed."""
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


def test_node_that_ignores_signals_on_a_shared_master(master: PrivateMaster) -> None:
    """After a kernel was killed, its nodes are killed and unregistered, even if the nodes ignore SIGTERM."""
    kernel = Kernel()
    kernel.run(f"""
import sys
from course_pkg.ros import NodeProcess
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


def test_normal_end_leaves_nothing(master: PrivateMaster) -> None:
    """A kernel that exits normally leaves no registrations and no processes."""
    kernel = Kernel()
    kernel.run(EVERYTHING)
    pids = family(kernel.pid)
    kernel.exit(timeout=5)
    assert MasterClient(master.uri).system_state().nodes == ()
    assert gone(pids)


def test_interrupt_does_not_end_the_nodes(kernel: Kernel) -> None:
    """If the kernel is interrupted, its nodes do not receive the interrupt."""
    kernel.run(
        "from course_pkg.ros import join; node = join('owner'); server = node.run('course_pkg', 'server')"
    )
    kernel.run("server.wait_for_service('/getGeometry')")
    kernel.begin("import time; time.sleep(20)")
    kernel.interrupt()
    assert kernel.reply().error == "KeyboardInterrupt"
    assert kernel.run("result = server.running, repr(node)") == [True, "<node /owner>"]


def test_thread_that_started_a_node_may_end(kernel: Kernel) -> None:
    """A node continues to run after the end of the thread that started the node."""
    kernel.run("""
        import threading
        from course_pkg.ros import NodeProcess, join
        join("owner")
        held = []
        thread = threading.Thread(target=lambda: held.append(NodeProcess.rosrun("course_pkg", "server")))
        thread.start()
        thread.join()
        held[0].wait_for_service("/getGeometry")
    """)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_stubborn_descendants_are_killed(number: signal.Signals) -> None:
    """A grandchild that ignores signals is killed after its parent has exited."""
    stubborn = "import signal, time; [signal.signal(n, signal.SIG_IGN) for n in (2, 15)]; time.sleep(1000)"
    parent = f"""
import subprocess, sys, time
subprocess.Popen([sys.executable, "-c", {stubborn!r}], start_new_session=True)
time.sleep(1000)
"""
    process = SupervisedProcess([sys.executable, "-c", parent])
    pids = eventually(lambda: len(found := family(process.pid)) == 2 and found)
    process.signal(number)
    assert process.wait(8)
    assert gone(pids)


def test_temporary_folder_of_a_killed_process_is_deleted(tmp_path: Path) -> None:
    """If a process with a temporary folder is killed, the folder is deleted."""
    owner = """
import signal, time
from course_pkg.ros.process.supervised import temporary_folder
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
with temporary_folder("killed-"):
    time.sleep(1000)
"""
    process = SupervisedProcess([sys.executable, "-c", owner], env={**os.environ, "TMPDIR": str(tmp_path)})
    pids = eventually(lambda: len(found := family(process.pid)) == 2 and found)
    assert list(tmp_path.iterdir())
    process.end(grace=0.0)
    assert gone(pids)
    assert not list(tmp_path.iterdir())


def test_exit_status_is_passed_on() -> None:
    """`returncode` is the exit status of the command, or -n if signal n ended the command."""
    for command, status in (("exit 3", 3), ("exit 255", 255), ("kill -9 $$", -9), ("true", 0)):
        process = SupervisedProcess(["sh", "-c", command])
        assert process.wait(5)
        assert process.returncode == status


OWNER = """
import signal, sys
from course_pkg.ros import SupervisedProcess
signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT, signal.SIGCHLD])
process = SupervisedProcess(sys.argv[1:], foreground=True)
assert process.wait(20)
sys.exit(process.returncode)
"""


def test_background_processes_of_a_foreground_command_end(tmp_path: Path) -> None:
    """The background processes of a foreground command end with the command."""
    line = f"sleep 1000 & echo $! > {tmp_path}/pid; setsid sleep 1000 & cat; exit 4"
    done = subprocess.run(
        [sys.executable, "-c", OWNER, "sh", "-c", line],
        input="typed",
        capture_output=True,
        text=True,
        timeout=20,
        check=False,
    )
    assert (done.stdout, done.returncode) == ("typed", 4)
    assert process_state(int((tmp_path / "pid").read_text())) == "Z"


def test_a_terminal_interrupts_a_foreground_command_once() -> None:
    """The command receives each Ctrl-C exactly once."""
    command = (
        "import signal\n"
        "came = []\n"
        "signal.signal(signal.SIGINT, lambda *_: (came.append(1), print('interrupted', flush=True)))\n"
        "print('ready', flush=True)\n"
        "while not came: signal.sigtimedwait([], 0.02)\n"
        "signal.sigtimedwait([], 0.3); print('end', flush=True)"
    )
    pid, terminal = pty.fork()
    if pid == 0:
        os.execv(sys.executable, [sys.executable, "-c", OWNER, sys.executable, "-c", command])  # noqa: S606
    printed, deadline = b"", time.monotonic() + 20
    while b"end" not in printed and time.monotonic() < deadline:
        if select.select([terminal], [], [], 0.1)[0]:
            printed += os.read(terminal, 1024)
            if printed.endswith(b"ready\r\n"):
                os.write(terminal, b"\x03")
    assert printed.count(b"interrupted") == 1
    assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 0
    os.close(terminal)


def test_stopped_node_is_ended(master: PrivateMaster) -> None:
    """stop() also ends and unregisters a node that is suspended with SIGSTOP."""
    with NodeProcess.rosrun("course_pkg", "server") as server:
        server.wait_for_service("/getGeometry")
        with stopped(server.pid):
            server.stop()
    assert MasterClient(master.uri).lookup_service("/getGeometry") is None


def test_everything_listens_on_loopback_only(kernel: Kernel) -> None:
    """A kernel, its master and its nodes listen only on 127.0.0.1."""
    kernel.run(EVERYTHING)
    ports = listening_ports(kernel.pid)
    assert len(ports) >= 7
    tables = Path("/proc/net/tcp").read_text() + Path("/proc/net/tcp6").read_text()
    listeners = [line.split()[1].split(":") for line in tables.splitlines() if " 0A " in line]
    assert {address for address, port in listeners if int(port, 16) in ports} == {"0100007F"}
