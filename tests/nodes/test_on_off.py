"""The server that knows two numbers, and the client that sends one of them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.graph import NodeProcess
from tests.nodes.terminals import program, terminal
from tests.support import eventually

pytestmark = pytest.mark.usefixtures("master")

ANSWERS = {"0: OFF\n", "1: ON\n"}


@pytest.fixture
def server() -> Iterator[NodeProcess]:
    """`rosrun course_pkg on_off_server`, answering."""
    with NodeProcess(["rosrun", "course_pkg", "on_off_server"]) as process:
        process.wait_for_service("/on_off")
        yield process


@pytest.mark.parametrize(("number", "state"), [("0", "OFF"), ("1", "ON")])
def test_two_numbers_have_an_answer(server: NodeProcess, number: str, state: str) -> None:
    """0 is OFF, 1 is ON."""
    assert terminal("rosservice", "call", "/on_off", number).stdout == f'state: "{state}"\n'


@pytest.mark.parametrize("number", ["2", "-1", "2147483647"])
def test_other_numbers_are_refused_by_name(server: NodeProcess, number: str) -> None:
    """Any other number is refused in words that name it and say what would be right; the server goes on."""
    done = terminal("rosservice", "call", "/on_off", "--", number)
    assert done.returncode == 2
    assert f"cannot process request: {number} is neither 0 (OFF) nor 1 (ON)" in done.stderr
    assert "Traceback" not in server.output()
    assert terminal("rosservice", "call", "/on_off", "1").returncode == 0


def test_client_sends_either_number(server: NodeProcess) -> None:
    """The client prints what it sent and what it got, and sends now the one, now the other."""
    seen: set[str] = set()

    def both() -> bool:
        done = program("on_off_client")
        assert (done.returncode, done.stderr) == (0, "")
        seen.add(done.stdout)
        return len(seen) > 1

    eventually(both, timeout=60)
    assert seen == ANSWERS


def test_client_takes_no_arguments() -> None:
    """A number on the command line is a wrong line: usage, and exit status 2, at once."""
    done = program("on_off_client", "1")
    assert done.returncode == 2
    assert done.stderr.startswith("usage: on_off_client")


def test_client_without_a_server() -> None:
    """Without a server the client gives up after 5 s, in one line, with exit status 1."""
    done = program("on_off_client")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "timeout exceeded while waiting for service /on_off\n"


def test_client_without_a_master() -> None:
    """Without a master the client says so, in one line, with exit status 1."""
    done = program("on_off_client", ROS_MASTER_URI="http://localhost:1")
    assert (done.returncode, done.stdout) == (1, "")
    assert "No ROS master at http://localhost:1" in done.stderr
    assert "Traceback" not in done.stderr
