"""Tests of a private network: programs outside the network cannot find or reach its sockets."""

from __future__ import annotations

import os
import pwd
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.lab.graph import network
from course_pkg.lab.graph.outgoing import Outgoing
from course_pkg.setup.network import outgoing_problem
from tests.lab.commands import ROOT, can_connect

LISTEN = """
import socket, sys
servers = [socket.create_server(("127.0.0.1", port)) for port in (0, 11311)]
hidden = socket.socket(socket.AF_UNIX); hidden.bind("\\0course-test"); hidden.listen()
print(*(server.getsockname()[1] for server in servers), flush=True)
sys.stdin.read()
"""
AS_NOBODY = """
import os, subprocess, sys
sys.path.insert(0, {root!r})
from course_pkg.lab.graph import network
files = network.create()
shell = "whoami; touch {file}; stat -c %U {file}; grep CapEff /proc/self/status"
subprocess.run([*network.entering(files), "sh", "-c", shell], check=True)
"""


@pytest.fixture
def files() -> Iterator[list[int]]:
    """Create a private network, or skip the test if this machine does not allow one."""
    try:
        created = network.create()
    except OSError as error:
        pytest.skip(f"no private network: {error}")
    yield created
    for file in created:
        os.close(file)


def inside(files: list[int], *command: str) -> subprocess.CompletedProcess[str]:
    """Run a command in the private network, and wait until the command exits."""
    return subprocess.run(
        [*network.entering(files), *command], capture_output=True, text=True, timeout=30, check=False
    )


def test_no_port_and_no_abstract_socket_is_visible_outside(files: list[int]) -> None:
    """A process outside the network cannot find or reach the network's sockets.

    The outside process does not see the network's sockets in /proc/net, and cannot connect to these sockets.
    """
    command = [*network.entering(files), sys.executable, "-c", LISTEN]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        port, master = map(int, process.stdout.readline().split())
        assert f":{port:04X} " in inside(files, "cat", "/proc/net/tcp").stdout
        assert "@course-test" in inside(files, "cat", "/proc/net/unix").stdout
        assert master == 11311
        assert f":{port:04X} " not in Path("/proc/net/tcp").read_text()
        assert "@course-test" not in Path("/proc/net/unix").read_text()
        assert not can_connect(port)
        process.communicate("")


def test_two_networks_have_separate_ports(files: list[int]) -> None:
    """A server in one network cannot be reached from another network of the same user."""
    try_it = (
        "import socket; print(socket.socket().connect_ex(('127.0.0.1', 11311)))  # 111 is connection refused"
    )
    others = network.create()
    command = [*network.entering(files), sys.executable, "-c", LISTEN]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        process.stdout.readline()
        assert inside(files, sys.executable, "-c", try_it).stdout == "0\n"
        assert inside(others, sys.executable, "-c", try_it).stdout == "111\n"
        process.communicate("")
    for file in others:
        os.close(file)


def test_other_computers_can_be_reached_but_not_this_ones_loopback(files: list[int]) -> None:
    """With slirp4netns, a program can reach other computers, but not 127.0.0.1 of this computer."""
    reason, _ = outgoing_problem()
    if reason:
        pytest.skip(reason)
    outgoing = Outgoing.start(files)
    assert outgoing
    assert outgoing.works()
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        assert can_connect(port)
        for host in ("127.0.0.1", "10.0.2.2"):
            ask = f"import socket; socket.create_connection(({host!r}, {port}), 3)"
            reason = inside(files, sys.executable, "-c", ask).stderr
            assert "Connection refused" in reason or "Network is unreachable" in reason
    routes = inside(files, "cat", "/proc/net/route").stdout
    outgoing.end()
    assert "tap0\t00000000" in routes


def test_an_ordinary_user_keeps_name_and_files() -> None:
    """In the network, `whoami` prints the user's name, and the user has no additional rights."""
    name = pwd.getpwuid(65534 if os.getuid() == 0 else os.getuid()).pw_name
    file = f"/tmp/course-test-{os.getpid()}"  # noqa: S108 -- tmp_path belongs to root
    script = AS_NOBODY.format(root=str(ROOT), file=file)
    drop = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.getuid() == 0 else []
    python = ["/usr/bin/python3", "-B", "-I", "-S", "-c", script]
    answer = subprocess.run(
        [*drop, *python], capture_output=True, text=True, cwd="/", timeout=30, check=False
    )
    Path(file).unlink(missing_ok=True)
    if "not permitted" in answer.stderr or "Permission denied" in answer.stderr:
        pytest.skip(answer.stderr)
    assert answer.stdout == f"{name}\n{name}\nCapEff:\t0000000000000000\n", answer.stderr
