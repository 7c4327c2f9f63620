"""Tests that other users and other labs can reach only the page of a running `course lab`."""

from __future__ import annotations

import os
import secrets
import sys
from contextlib import suppress
from pathlib import Path

from course_pkg.lab.graph.graph import Which, join_or_start
from course_pkg.lab.graph.network import entering
from tests.lab.commands import below, network_of
from tests.lab.graph.messages import Messages
from tests.lab.test_jupyterlab import Service
from tests.support import terminal

SCANNER = Path(__file__).with_name("scanner.py").read_text()
# This cell starts a node with a service and a panel, and opens an abstract socket. The node, the service and
# the socket have the same name.
CELL = """
import socket
import rospy
from course_pkg import GraphPanel, join
from std_srvs.srv import Trigger
node = join("{name}")
calls = []
service = rospy.Service("/{name}", Trigger, lambda request: calls.append(request))
hidden = socket.socket(socket.AF_UNIX)
hidden.bind("\\0{name}")
hidden.listen()
panel = GraphPanel()
"""
OTHER_USER = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "/usr/bin/python3")


def scan(*command: str, name: str, sockets: list[str] = []) -> list[str]:  # noqa: B006 -- nothing changes it
    """Run the scanner; `command` is the start of a command line, and ends with a Python interpreter.

    Return the sorted results without duplicates.
    """
    ended = terminal(*command, "-I", "-c", SCANNER, name, *sockets)
    assert ended.returncode == 0, ended.stderr
    return sorted(set(ended.stdout.split()))


def visible(pids: list[int], kinds: tuple[str, ...]) -> set[str]:
    """Return the names of the given processes' listening sockets that are visible in /proc/net.

    A name is the address of a TCP or UDP socket, or the path of a Unix socket. The addresses have the format
    of /proc/net.
    """
    owned: set[str] = set()
    for pid in pids:
        with suppress(OSError):  # The process has ended.
            owned |= {os.readlink(file) for file in Path(f"/proc/{pid}/fd").iterdir()}
    names = set()
    for kind in kinds:
        for line in Path("/proc/net", kind).read_text().splitlines()[1:]:
            words = line.split()
            inode, name, listens = (
                (words[6], words[-1], words[3] == "00010000")
                if kind == "unix"
                else (words[9], words[1], kind.startswith("udp") or words[3] == "0A")
            )
            if listens and f"socket:[{inode}]" in owned:
                names.add(name)
    return names


def test_a_scan_finds_nothing_but_the_page(served: Service, tmp_path: Path) -> None:
    """A scan from outside the lab's network finds no master, node, service or socket.

    During the scan, the service is not called and not replaced. A scan from inside the network finds a
    master, a node, a service and a socket.
    """
    name = f"hidden_{secrets.token_hex(4)}"
    messages = Messages(served)
    messages.run(CELL.format(name=name), "status")
    kernel, uri = messages.run(
        "import os; print(os.getpid(), os.environ['ROS_MASTER_URI'])", "status"
    ).split()
    family = [served.process.pid, *below(served.process)]
    assert visible(family, ("tcp", "tcp6", "udp", "udp6")) == {f"0100007F:{served.port:04X}"}
    sockets = sorted(visible(family, ("unix",)))
    assert not [each for each in sockets if each.startswith("@")]

    lookup = ("rosservice", "uri", f"/{name}")
    inside = network_of(int(kernel))
    before = terminal(*inside, "env", f"ROS_MASTER_URI={uri}", *lookup).stdout
    assert before.startswith("rosrpc://")
    assert scan(*inside, sys.executable, name=name) == ["master", "node", "service", "socket"]

    other_lab = join_or_start(Which.ALONE, tmp_path)
    try:
        other_lab.wait_for_master()
        networks = {os.fstat(other_lab.files[-1]).st_ino, os.stat(f"/proc/{kernel}/ns/net").st_ino}
        assert len(networks) == 2
        assert scan(*entering(other_lab.files), sys.executable, name=name) == []
        assert scan(sys.executable, name=name) == []
        if os.geteuid() == 0:
            assert scan(*OTHER_USER, name=name, sockets=sockets) == []
    finally:
        other_lab.leave()
    assert terminal(*inside, "env", f"ROS_MASTER_URI={uri}", *lookup).stdout == before
    assert messages.run("print(len(calls))", "status") == "0\n"
