"""Tests of the programs of chapter 11: the session server, its client, and the TCP echo."""

from __future__ import annotations

import socket
from collections.abc import Iterator

import pytest

from course_pkg.chapters.ch11_look_inside.programs.session_client import read_arguments
from course_pkg.ros import MasterClient, NodeProcess, PrivateMaster
from course_pkg.ros.node.proxy import BoundedProxy
from tests.support import eventually, program, terminal

pytestmark = pytest.mark.usefixtures("master")
KIND = "course_pkg/AddUp"


@pytest.fixture
def server() -> Iterator[NodeProcess]:
    """Start `rosrun course_pkg session_server`, and wait until its service is available."""
    with NodeProcess(["rosrun", "course_pkg", "session_server"]) as process:
        process.wait_for_service("/add_up", timeout=20)
        yield process


def added(session: str, amount: int) -> tuple[int, int]:
    """Add an amount to a session. Return the session's total and its number of calls."""
    answer = BoundedProxy("/add_up", KIND, headers={"session": session}).call(amount)
    return answer.total, answer.calls


@pytest.mark.usefixtures("server")
def test_each_session_has_its_own_total() -> None:
    """Each session has its own total, and a different node can continue a session."""
    assert [added("alice", 5), added("bob", 100), added("alice", -7)] == [(5, 1), (100, 1), (-2, 2)]
    assert program("session_client", "alice", "10", "10").stdout.splitlines() == [
        "alice: 8 after 3 calls",
        "alice: 18 after 4 calls",
    ]


@pytest.mark.usefixtures("server")
def test_refusals_contain_the_reason() -> None:
    """The server refuses a call without a session, and a total above the int32 range."""
    done = terminal("rosservice", "call", "/add_up", "5")
    assert done.returncode == 2
    assert "cannot process request: the connection header has no field session" in done.stderr
    assert added("large", 2**31 - 1) == (2**31 - 1, 1)
    assert "more than an int32 can hold" in program("session_client", "large", "1").stderr
    assert added("large", -1) == (2**31 - 2, 2)


@pytest.mark.usefixtures("server")
def test_client_with_a_rate_repeats_its_amount() -> None:
    """With _rate:=20, the client sends its amount repeatedly until the client is stopped."""
    with NodeProcess(["rosrun", "course_pkg", "session_client", "steady", "1", "_rate:=20"]) as client:
        client.wait_for_output("after 5 calls")
    assert "Traceback" not in client.output()


def test_arguments_are_read() -> None:
    """read_arguments() returns the session and the numbers, or None for invalid arguments."""
    assert read_arguments(["alice", "5", "-3"]) == ("alice", [5, -3])
    for words in ([], ["alice"], ["", "5"], ["alice", "five"], ["alice", str(2**31)]):
        assert read_arguments(words) is None


def test_client_without_a_server_or_with_wrong_arguments() -> None:
    """The exit status is 2 for wrong arguments, and 1 if there is no server."""
    done = program("session_client", "alice")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("usage: session_client")
    done = program("session_client", "alice", "1")
    assert (done.returncode, done.stderr) == (1, "timeout exceeded while waiting for service /add_up\n")


def test_echo_sends_back_every_byte(master: PrivateMaster) -> None:
    """The TCP echo stores its port in a parameter, and sends back every byte."""
    with NodeProcess(["rosrun", "course_pkg", "tcp_echo"]) as echo:
        echo.wait_for_output("The server runs")
        port = eventually(lambda: MasterClient(master.uri).get_param("/tcp_echo/port"))
        with socket.create_connection(("localhost", port), timeout=5) as sock:
            sock.sendall(bytes(range(16)))
            sock.shutdown(socket.SHUT_WR)
            came = b"".join(iter(lambda: sock.recv(4096), b""))
    assert came == bytes(range(16))


@pytest.mark.usefixtures("server")
def test_a_program_uses_the_master_of_its_argument() -> None:
    """With __master:=…, the server and the client use another master."""
    with PrivateMaster() as other:
        there = f"__master:={other.uri}"
        with NodeProcess(["rosrun", "course_pkg", "session_server", there]):
            eventually(lambda: MasterClient(other.uri).lookup_service("/add_up"), timeout=20)
            assert program("session_client", "alice", "5", there).stdout.splitlines() == [
                "alice: 5 after 1 calls"
            ]
    assert added("alice", 1) == (1, 1)
