"""The switch that says what it did."""

from __future__ import annotations

import os
import re
import signal
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest
from std_srvs.srv import Empty, SetBool, Trigger

from course_pkg.graph import BoundedProxy, MasterClient, NodeProcess, PrivateMaster
from course_pkg.nodes.switch import Switch
from tests.nodes.terminals import terminal
from tests.support import eventually


@pytest.fixture
def switch(master: PrivateMaster) -> Iterator[NodeProcess]:
    """`rosrun course_pkg switch`, answering."""
    with NodeProcess(["rosrun", "course_pkg", "switch"]) as process:
        process.wait_for_service("/switch/reset")
        yield process


def move(to_open: bool) -> tuple[bool, str]:
    """Return success and message of one call of /switch/set."""
    response = BoundedProxy("/switch/set", SetBool)(to_open)
    return response.success, response.message


def trigger(name: str) -> tuple[bool, str]:
    """Return success and message of one call of a Trigger of the switch."""
    response = BoundedProxy(f"/switch/{name}", Trigger)()
    return response.success, response.message


@pytest.mark.usefixtures("switch")
def test_it_moves_and_says_so() -> None:
    """It starts closed, goes where it is told, and says what it did."""
    assert trigger("report") == (True, "closed")
    assert move(True) == (True, "opened")
    assert trigger("report") == (True, "open")
    assert move(False) == (True, "closed")


@pytest.mark.usefixtures("switch")
def test_asked_twice_it_says_that_it_is_there() -> None:
    """A switch that stands where it is told to go does not move: no success, and no error."""
    assert move(False) == (False, "already closed")
    move(True)
    assert move(True) == (False, "already open")
    assert trigger("report") == (True, "open")


@pytest.mark.usefixtures("switch")
def test_a_toggle_moves_it_each_time() -> None:
    """A toggle sent twice leaves it where it was, which set does not."""
    assert [trigger("toggle") for _ in range(3)] == [(True, "opened"), (True, "closed"), (True, "opened")]


@pytest.mark.usefixtures("switch")
def test_a_reset_closes_it_without_a_word() -> None:
    """The answer to a reset is empty, and the switch is closed after it."""
    move(True)
    BoundedProxy("/switch/reset", Empty)()
    assert trigger("report") == (True, "closed")


def test_its_log_tells_more_when_it_is_asked_to(switch: NodeProcess) -> None:
    """Moves are logged as they are; what changed nothing only at the level debug."""
    move(True)
    move(True)
    eventually(lambda: "Opened" in switch.output())
    assert "already open" not in switch.output()
    done = terminal("rosservice", "call", "/switch/set_logger_level", "rosout", "debug")
    assert done.returncode == 0
    move(True)
    pattern = r"\[DEBUG\] \[.*\]: Asked to move, and did not: already open"
    eventually(lambda: re.search(pattern, switch.output()))


def test_its_services_go_by_its_name(master: PrivateMaster) -> None:
    """Two switches of different names do not meet."""
    command = ["rosrun", "course_pkg", "switch"]
    with NodeProcess([*command, "__name:=left"]) as left, NodeProcess([*command, "__name:=right"]) as right:
        left.wait_for_service("/left/reset")
        right.wait_for_service("/right/reset")
        BoundedProxy("/left/set", SetBool)(True)
        assert BoundedProxy("/right/report", Trigger)().message == "closed"


def test_many_toggles_at_once_are_all_counted() -> None:
    """Callers who come at the same moment move it one after the other."""
    switch = Switch()
    with ThreadPoolExecutor(8) as pool:
        told = list(pool.map(switch.handle_toggle, range(101)))
    assert sorted(words for _, words in told) == ["closed"] * 50 + ["opened"] * 51
    assert switch.handle_report(None) == (True, "open")


@pytest.mark.parametrize(
    ("program", "service"),
    [("switch", "/switch/reset"), ("on_off_server", "/on_off"), ("add_two_ints_server", "/add_two_ints")],
)
def test_servers_end_when_told(program: str, service: str, master: PrivateMaster) -> None:
    """Ctrl-C ends a server of this chapter without a traceback and without a registration left."""
    with NodeProcess(["rosrun", "course_pkg", program]) as process:
        process.wait_for_service(service)
        os.kill(process.pid, signal.SIGINT)
        assert process.wait(5) == 0
        assert "Traceback" not in process.output()
    assert MasterClient(master.uri).system_state().nodes == ()


@pytest.mark.parametrize("attempt", range(4))
def test_an_end_that_comes_during_the_start(attempt: int, master: PrivateMaster) -> None:
    """Ctrl-C between the first registration and the last ends a server too, every time."""
    with NodeProcess(["rosrun", "course_pkg", "switch"]) as process:
        eventually(lambda: "Serving" in process.output(), interval=0.001)
        os.kill(process.pid, signal.SIGINT)
        assert process.wait(5) == 0
        assert MasterClient(master.uri).system_state().nodes == ()


@pytest.mark.parametrize("program", ["switch", "on_off_server", "add_two_ints_server"])
def test_servers_wait_for_a_master(program: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a master a server says that it waits for one, and Ctrl-C ends the wait."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    with NodeProcess(["rosrun", "course_pkg", program]) as process:
        eventually(lambda: "Waiting for one" in process.output())
        process.interrupt()
        assert process.wait(5) == 0
        assert "Traceback" not in process.output()
