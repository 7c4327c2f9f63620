"""Tests of the course's geometry server and client in a terminal."""

from __future__ import annotations

import os
import signal
import socket
import time
from collections.abc import Iterator

import pytest

from course_pkg.nodes.client import read_sides
from course_pkg.ros import MasterClient, NodeProcess, PrivateMaster
from tests.support import eventually, terminal

pytestmark = pytest.mark.usefixtures("master")


@pytest.fixture
def server() -> Iterator[NodeProcess]:
    """Start `rosrun course_pkg server`, and wait until its service is available."""
    with NodeProcess(["rosrun", "course_pkg", "server"]) as process:
        process.wait_for_service("/getGeometry")
        yield process


def test_rosservice_call(server: NodeProcess) -> None:
    """`rosservice call` prints the area and the volume, and the server logs the request."""
    done = terminal("rosservice", "call", "/getGeometry", "1.2", "5.2", "8.9")
    assert done.returncode == 0
    values = dict(line.split(": ") for line in done.stdout.splitlines())
    assert round(float(values["area"]), 2) == 6.24
    assert round(float(values["volume"]), 2) == 55.54
    assert "1.2 x 5.2 x 8.9: area 6.24, volume 55.536" in server.output()


def test_client_prints_area_and_volume(server: NodeProcess) -> None:
    """The client prints only the area and the volume, each on a separate line."""
    done = terminal("rosrun", "course_pkg", "client", "1.2", "5.2", "8.9")
    assert (done.returncode, done.stdout, done.stderr) == (0, "area: 6.24\nvolume: 55.54\n", "")


def test_rossrv_show() -> None:
    """`rossrv show` prints the fields of the type."""
    assert "float32 length" in terminal("rossrv", "show", "geometry").stdout


@pytest.mark.parametrize("words", [[], ["1", "2"], ["1", "2", "3", "4"], ["1", "2", "tall"]])
def test_client_with_a_wrong_line(words: list[str]) -> None:
    """If the arguments are wrong, the client prints its usage, and its exit status is 2."""
    done = terminal("rosrun", "course_pkg", "client", *words)
    assert done.returncode == 2
    assert done.stderr.startswith("usage: client LENGTH WIDTH HEIGHT")


@pytest.mark.parametrize(
    ("sides", "message"),
    [
        (["-1", "2", "3"], "length is -1"),
        (["1", "nan", "3"], "width is nan"),
        (["1", "2", "inf"], "height is inf"),
    ],
)
def test_impossible_box_is_refused(server: NodeProcess, sides: list[str], message: str) -> None:
    """The server refuses an invalid side, and the client prints the server's error message."""
    done = terminal("rosrun", "course_pkg", "client", *sides)
    assert done.returncode == 1
    assert f"service cannot process request: {message}" in done.stderr
    assert "Traceback" not in done.stderr


def test_number_that_does_not_fit_into_a_float32(server: NodeProcess) -> None:
    """If a number is too large for a float32, the error message contains the number and no traceback."""
    done = terminal("rosrun", "course_pkg", "client", "1e39", "1", "1")
    assert (done.returncode, done.stderr) == (
        2,
        "1e+39 does not fit into a float32. Give a smaller number.\n",
    )


def test_client_without_a_server() -> None:
    """Without a server, the client prints a timeout message after 5 s, and its exit status is 1."""
    done = terminal("rosrun", "course_pkg", "client", "1", "2", "3")
    assert done.returncode == 1
    assert "timeout exceeded while waiting for service /getGeometry" in done.stderr
    assert "Traceback" not in done.stderr


def test_client_without_a_master() -> None:
    """Without a master, the client prints an error message within 5 s, and its exit status is 1."""
    started = time.monotonic()
    done = terminal("rosrun", "course_pkg", "client", "1", "2", "3", ROS_MASTER_URI="http://localhost:1")
    assert done.returncode == 1
    assert "No ROS master at http://localhost:1" in done.stderr
    assert time.monotonic() - started < 5


def test_remapping(master: PrivateMaster) -> None:
    """The names of the node and of the service can be remapped."""
    command = ["rosrun", "course_pkg", "server", "__name:=other", "getGeometry:=/measure"]
    with NodeProcess(command) as process:
        process.wait_for_service("/measure")
        assert MasterClient(master.uri).system_state().services["/measure"] == ("/other",)
        done = terminal(
            "rosrun", "course_pkg", "client", "1", "2", "3", "getGeometry:=/measure", "__name:=me"
        )
        assert done.stdout == "area: 2.00\nvolume: 6.00\n"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_server(server: NodeProcess, master: PrivateMaster, number: signal.Signals) -> None:
    """After SIGINT or SIGTERM, the server unregisters and exits within 2 s."""
    started = time.monotonic()
    os.kill(server.pid, number)
    assert server.wait(5) == 0
    assert time.monotonic() - started < 2
    assert "Traceback" not in server.output()
    assert MasterClient(master.uri).system_state().nodes == ()


def test_server_ends_while_it_waits_for_a_master(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C stops a server that waits for a master."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    with NodeProcess(["rosrun", "course_pkg", "server"]) as process:
        eventually(lambda: "The program waits for a master" in process.output())
        process.interrupt()
        assert process.wait(5) == 0
        assert "Traceback" not in process.output()


def test_server_is_not_blocked_by_an_idle_connection(server: NodeProcess, master: PrivateMaster) -> None:
    """A connection that sends nothing does not block other clients."""
    uri = MasterClient(master.uri).lookup_service("/getGeometry")
    assert uri is not None
    with socket.create_connection(("localhost", int(uri.rpartition(":")[2]))):
        done = terminal("rosrun", "course_pkg", "client", "1", "2", "3")
    assert done.stdout == "area: 2.00\nvolume: 6.00\n"


@pytest.mark.parametrize(
    ("words", "sides"),
    [
        (["1.2", "5.2", "8.9"], (1.2, 5.2, 8.9)),
        (["-1", "1e3", "0"], (-1.0, 1000.0, 0.0)),
        (["1", "2"], None),
        (["a", "2", "3"], None),
    ],
)
def test_reading_the_sides(words: list[str], sides: tuple[float, float, float] | None) -> None:
    """read_sides() accepts three numbers in any Python notation, and returns None for other arguments."""
    assert read_sides(words) == sides
