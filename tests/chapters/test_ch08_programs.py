"""Tests of the programs of chapter 08."""

from __future__ import annotations

import os
import re
import signal
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest
from std_srvs.srv import Empty, SetBool, Trigger

from course_pkg.chapters.ch08_use_existing_services.programs.add_two_ints_server import LARGEST
from course_pkg.chapters.ch08_use_existing_services.programs.switch import Switch
from course_pkg.ros import BoundedProxy, MasterClient, NodeProcess, PrivateMaster
from course_pkg.types import service_type
from tests.support import eventually, program, terminal

pytestmark = pytest.mark.usefixtures("master")


@pytest.fixture
def adder() -> Iterator[NodeProcess]:
    """Start `rosrun course_pkg add_two_ints_server`, and wait until its service is available."""
    with NodeProcess(["rosrun", "course_pkg", "add_two_ints_server"]) as process:
        process.wait_for_service("/add_two_ints")
        yield process


@pytest.mark.usefixtures("adder")
@pytest.mark.parametrize(
    ("numbers", "printed"),
    [
        (["20", "22"], "20 + 22 = 42\n"),
        (["-20", "-22"], "-20 + -22 = -42\n"),
        ([str(LARGEST), "-1"], f"{LARGEST} + -1 = {LARGEST - 1}\n"),
    ],
)
def test_adder_client_prints_the_sum(numbers: list[str], printed: str) -> None:
    """The client prints only the sum, even for negative and very large numbers."""
    done = program("add_two_ints_client", *numbers)
    assert (done.returncode, done.stdout, done.stderr) == (0, printed, "")


@pytest.mark.usefixtures("adder")
@pytest.mark.parametrize(("a", "b"), [(LARGEST, 1), (-LARGEST - 1, -1)])
def test_sum_outside_of_int64_is_refused(a: int, b: int) -> None:
    """The server refuses a sum outside of int64, and the client prints the error message."""
    done = program("add_two_ints_client", str(a), str(b))
    assert done.returncode == 1
    assert f"cannot process request: {a + b} is more than an int64 can hold" in done.stderr


@pytest.mark.parametrize("words", [[], ["1"], ["1", "2", "3"], ["1", "2.5"], ["1", str(LARGEST + 1)]])
def test_adder_client_with_wrong_arguments(words: list[str]) -> None:
    """If the arguments are wrong, the client prints its usage, and its exit status is 2."""
    done = program("add_two_ints_client", *words)
    assert done.returncode == 2
    assert done.stderr.startswith("usage: add_two_ints_client A B")


def test_client_of_another_definition_is_refused(adder: NodeProcess) -> None:
    """A client with another service definition prints an error message with both MD5 sums."""
    done = program("add_two_floats_client", "20", "22")
    ours = service_type("course_pkg/AddTwoInts").md5
    assert (done.returncode, done.stdout) == (1, "")
    refusal = "remote error reported: request from [/add_two_floats_client]: md5sums do not match: ["
    assert refusal in done.stderr
    assert f"vs. [{ours}]" in done.stderr
    assert "Traceback" not in done.stderr
    eventually(lambda: "md5sums do not match" in adder.output())
    assert terminal("rosservice", "call", "/add_two_ints", "1", "2").stdout == "sum: 3\n"


def test_client_of_another_definition_with_wrong_arguments() -> None:
    """If the arguments are wrong, the client with another service definition prints its own usage."""
    done = program("add_two_floats_client", "one", "2")
    assert done.returncode == 2
    assert done.stderr.startswith("usage: add_two_floats_client A B")


@pytest.fixture
def on_off() -> Iterator[NodeProcess]:
    """Start `rosrun course_pkg on_off_server`, and wait until its service is available."""
    with NodeProcess(["rosrun", "course_pkg", "on_off_server"]) as process:
        process.wait_for_service("/on_off")
        yield process


@pytest.mark.parametrize(("number", "state"), [("0", "OFF"), ("1", "ON")])
def test_on_off_returns_the_state(on_off: NodeProcess, number: str, state: str) -> None:
    """The response is OFF for 0, and ON for 1."""
    assert terminal("rosservice", "call", "/on_off", number).stdout == f'state: "{state}"\n'


def test_on_off_refuses_other_numbers(on_off: NodeProcess) -> None:
    """If the number is not 0 or 1, the error message contains this number and the allowed numbers."""
    for number in ("2", "-1", "2147483647"):
        done = terminal("rosservice", "call", "/on_off", "--", number)
        assert done.returncode == 2
        assert f"cannot process request: {number} is neither 0 (OFF) nor 1 (ON)" in done.stderr
    assert "Traceback" not in on_off.output()
    assert terminal("rosservice", "call", "/on_off", "1").returncode == 0


def test_on_off_client_sends_either_number(on_off: NodeProcess) -> None:
    """The client sends 0 or 1, and prints the number and the state."""
    seen: set[str] = set()

    def both() -> bool:
        done = program("on_off_client")
        assert (done.returncode, done.stderr) == (0, "")
        seen.add(done.stdout)
        return len(seen) > 1

    eventually(both, timeout=60)
    assert seen == {"0: OFF\n", "1: ON\n"}


def test_on_off_client_takes_no_arguments() -> None:
    """If the client gets an argument, the client prints its usage and exits with status 2."""
    done = program("on_off_client", "1")
    assert done.returncode == 2
    assert done.stderr.startswith("usage: on_off_client")


def test_on_off_client_without_a_server() -> None:
    """Without a server, the client prints one line after 5 s, and its exit status is 1."""
    done = program("on_off_client")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "timeout exceeded while waiting for service /on_off\n"


def test_on_off_client_without_a_master() -> None:
    """Without a master, the client prints one line, and its exit status is 1."""
    done = program("on_off_client", ROS_MASTER_URI="http://localhost:1")
    assert (done.returncode, done.stdout) == (1, "")
    assert "No ROS master at http://localhost:1" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.fixture
def switch(master: PrivateMaster) -> Iterator[NodeProcess]:
    """Start `rosrun course_pkg switch`, and wait until its service is available."""
    with NodeProcess(["rosrun", "course_pkg", "switch"]) as process:
        process.wait_for_service("/switch/reset")
        yield process


def move(to_open: bool) -> tuple[bool, str]:
    """Call /switch/set once, and return the `success` and `message` of the response."""
    response = BoundedProxy("/switch/set", SetBool)(to_open)
    return response.success, response.message


def trigger(name: str) -> tuple[bool, str]:
    """Call the switch's Trigger service once, and return the `success` and `message` of the response."""
    response = BoundedProxy(f"/switch/{name}", Trigger)()
    return response.success, response.message


@pytest.mark.usefixtures("switch")
def test_set_moves_the_switch() -> None:
    """A call moves the switch to the requested position, and the response's message contains the position."""
    assert trigger("report") == (True, "closed")
    assert move(True) == (True, "opened")
    assert trigger("report") == (True, "open")
    assert move(False) == (True, "closed")


@pytest.mark.usefixtures("switch")
def test_set_to_the_present_position_does_not_move() -> None:
    """If the switch already has the requested position, the field `success` is False."""
    assert move(False) == (False, "already closed")
    move(True)
    assert move(True) == (False, "already open")
    assert trigger("report") == (True, "open")


@pytest.mark.usefixtures("switch")
def test_toggle_moves_the_switch_each_time() -> None:
    """After two toggles, the switch has its first position again."""
    assert [trigger("toggle") for _ in range(3)] == [(True, "opened"), (True, "closed"), (True, "opened")]


@pytest.mark.usefixtures("switch")
def test_reset_closes_the_switch_with_an_empty_response() -> None:
    """After a reset, the switch is closed, and the response is empty."""
    move(True)
    BoundedProxy("/switch/reset", Empty)()
    assert trigger("report") == (True, "closed")


def test_log_level_debug_shows_calls_without_effect(switch: NodeProcess) -> None:
    """If a call does not move the switch, the node logs this call only at the log level debug."""
    move(True)
    move(True)
    eventually(lambda: "Opened" in switch.output())
    assert "already open" not in switch.output()
    done = terminal("rosservice", "call", "/switch/set_logger_level", "rosout", "debug")
    assert done.returncode == 0
    move(True)
    pattern = r"\[DEBUG\] \[.*\]: A request to move had no effect: already open"
    eventually(lambda: re.search(pattern, switch.output()))


def test_services_are_in_the_namespace_of_the_node(master: PrivateMaster) -> None:
    """Two switches with different node names offer different services."""
    command = ["rosrun", "course_pkg", "switch"]
    with NodeProcess([*command, "__name:=left"]) as left, NodeProcess([*command, "__name:=right"]) as right:
        left.wait_for_service("/left/reset")
        right.wait_for_service("/right/reset")
        BoundedProxy("/left/set", SetBool)(True)
        assert BoundedProxy("/right/report", Trigger)().message == "closed"


def test_simultaneous_toggles_are_all_counted() -> None:
    """After 101 simultaneous toggles, 51 responses are "opened" and 50 are "closed"."""
    switch = Switch()
    with ThreadPoolExecutor(8) as pool:
        told = list(pool.map(switch.handle_toggle, range(101)))
    assert sorted(words for _, words in told) == ["closed"] * 50 + ["opened"] * 51
    assert switch.handle_report(None) == (True, "open")


@pytest.mark.parametrize(
    ("program", "service"),
    [("switch", "/switch/reset"), ("on_off_server", "/on_off"), ("add_two_ints_server", "/add_two_ints")],
)
def test_servers_end_after_ctrl_c(program: str, service: str, master: PrivateMaster) -> None:
    """After Ctrl-C, each server unregisters and exits without a traceback."""
    with NodeProcess(["rosrun", "course_pkg", program]) as process:
        process.wait_for_service(service)
        os.kill(process.pid, signal.SIGINT)
        assert process.wait(5) == 0
        assert "Traceback" not in process.output()
    assert MasterClient(master.uri).system_state().nodes == ()


@pytest.mark.parametrize("attempt", range(4))
def test_an_end_that_comes_during_the_start(attempt: int, master: PrivateMaster) -> None:
    """If Ctrl-C arrives during the start, a server exits and is not registered."""
    with NodeProcess(["rosrun", "course_pkg", "switch"]) as process:
        eventually(lambda: "Serving" in process.output(), interval=0.001)
        os.kill(process.pid, signal.SIGINT)
        assert process.wait(5) == 0
        assert MasterClient(master.uri).system_state().nodes == ()


@pytest.mark.parametrize("program", ["switch", "on_off_server", "add_two_ints_server"])
def test_servers_wait_for_a_master(program: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a master, a server waits and prints a message, and Ctrl-C ends the server."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    with NodeProcess(["rosrun", "course_pkg", program]) as process:
        eventually(lambda: "The program waits for a master" in process.output())
        process.interrupt()
        assert process.wait(5) == 0
        assert "Traceback" not in process.output()
