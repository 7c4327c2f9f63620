"""Tests of a running `course lab`.

The kernels and terminals are in a private network, but JupyterLab's server is outside this network.
"""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from tests.lab.commands import (
    alive,
    all_gone,
    below,
    having,
    listening,
    network_namespace,
    own_namespace,
    running,
)
from tests.lab.graph.messages import Messages
from tests.lab.test_jupyterlab import Service
from tests.lab.test_run import course_run, names
from tests.support import eventually

KERNEL = b"ipykernel_launcher"
HOLDER = b"graph/holder.py\0"
WHERE = "import os; print(os.environ['ROS_MASTER_URI'], os.readlink('/proc/self/ns/net'), os.getpid())"
SLEEP = "import time; print('begun', flush=True); time.sleep(1000)"


def test_kernels_and_terminals_share_a_private_network(served: Service) -> None:
    """Outside the private network, only the port of JupyterLab's page is open.

    A kernel, a terminal and `course run` use the same master at port 11311.

    The commands Interrupt and Restart of JupyterLab work.
    """
    messages = Messages(served)
    uri, network, pid = messages.run(WHERE, "status").split()
    assert uri == "http://localhost:11311"
    assert network != own_namespace("net")
    assert having(KERNEL, [int(pid)])  # The kernel's main process runs this cell.
    served.post("/api/terminals")
    shell = eventually(lambda: _shell_below(served.process))
    # nsenter enters the network and then calls exec(), so the shell is in the network only after a short
    # time.
    assert eventually(lambda: network_namespace(shell) == network)
    assert course_run("sh", "-c", "readlink /proc/self/ns/net; rosnode list").stdout.split() == [
        network,
        "/rosout",
    ]
    outside = [each for each in below(served.process) if network_namespace(each) != network]
    assert listening(outside) == {("127.0.0.1", served.port)}

    [kernel] = served.kernels()
    assert "begun" in messages.run(SLEEP, "stream")
    served.post(f"/api/kernels/{kernel['id']}/interrupt")
    assert messages.run("1 / 0", "error").endswith("ZeroDivisionError")
    served.post(f"/api/kernels/{kernel['id']}/restart")
    again = messages.run(WHERE, "status").split()
    assert again[:2] == [uri, network]
    assert again[2] != pid


def _shell_below(process: int) -> int | None:
    """Return the process id of the terminal's shell, or None while the shell runs its start file.

    A command of the start file can run in a copy of the shell, which has the same command line.
    """
    shells = having(b"bash\0--rcfile\0", below(process))
    return shells[0] if len(shells) == 1 else None


@pytest.mark.parametrize("victim", [HOLDER, KERNEL, b"rosmaster\0--core"])
def test_nothing_is_left_after_a_kill_and_the_end(served: Service, victim: bytes) -> None:
    """If a process of the graph was killed, Ctrl-C still ends all other processes of the lab."""
    eventually(lambda: having(victim, below(served.process)))
    family = below(served.process)
    os.kill(having(victim, family)[-1], signal.SIGKILL)
    family += below(served.process)
    served.process.send_signal(signal.SIGINT)
    served.process.communicate(timeout=20)
    assert all_gone(family)


@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_a_hundred_kills_leave_nothing(tmp_path: Path) -> None:
    """After each of 100 kills, no process remains.

    The test kills `course run`, its master, or the process that keeps the private network.
    """
    victims = [b"", b"rosmaster\0--core", HOLDER]
    left = []
    for number in range(100):
        left += killed(victims[number % len(victims)], tmp_path)
    assert left == []
    assert course_run("true", XDG_STATE_HOME=str(tmp_path)).returncode == 0
    assert [path for path in tmp_path.rglob("*") if path.is_socket()] == []


def killed(victim: bytes, state: Path) -> list[int]:
    """Start `course run`, kill one of its processes, and return the processes that still run.

    `victim` is a text in the command line of the killed process. If the text is empty, kill `course run`
    itself.
    """
    with running("run", "sleep", "1000", XDG_STATE_HOME=str(state)) as process:
        eventually(lambda: "sleep" in names(below(process)), timeout=60)
        family = [process.pid, *below(process)]
        os.kill(having(victim, family)[-1] if victim else process.pid, signal.SIGKILL)
        process.kill()
        process.wait()
        all_gone(family)
    return [pid for pid in family if alive(pid)]
