"""The programs of chapter 08: the adder, its clients, the server of two states, and the switch."""

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
    """`rosrun course_pkg add_two_ints_server`, answering."""
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
    """The client prints the sum and nothing else, for numbers below zero and for the largest, too."""
    done = program("add_two_ints_client", *numbers)
    assert (done.returncode, done.stdout, done.stderr) == (0, printed, "")


@pytest.mark.usefixtures("adder")
@pytest.mark.parametrize(("a", "b"), [(LARGEST, 1), (-LARGEST - 1, -1)])
def test_sum_that_no_int64_holds(a: int, b: int) -> None:
    """A sum that cannot be sent is refused in words, and is no fault of the server."""
    done = program("add_two_ints_client", str(a), str(b))
    assert done.returncode == 1
    assert f"cannot process request: {a + b} is more than an int64 can hold" in done.stderr


@pytest.mark.parametrize("words", [[], ["1"], ["1", "2", "3"], ["1", "2.5"], ["1", str(LARGEST + 1)]])
def test_adder_client_with_wrong_arguments(words: list[str]) -> None:
    """What are not two numbers that an int64 holds is the usage text and exit status 2, without a server."""
    done = program("add_two_ints_client", *words)
    assert done.returncode == 2
    assert done.stderr.startswith("usage: add_two_ints_client A B")


def test_client_of_another_definition_is_refused(adder: NodeProcess) -> None:
    """Client and server compare MD5 sums, and the client gets both of them, and no sum."""
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
    """Its usage is its own, and comes without a server."""
    done = program("add_two_floats_client", "one", "2")
    assert done.returncode == 2
    assert done.stderr.startswith("usage: add_two_floats_client A B")


@pytest.fixture
def on_off() -> Iterator[NodeProcess]:
    """`rosrun course_pkg on_off_server`, answering."""
    with NodeProcess(["rosrun", "course_pkg", "on_off_server"]) as process:
        process.wait_for_service("/on_off")
        yield process


@pytest.mark.parametrize(("number", "state"), [("0", "OFF"), ("1", "ON")])
def test_on_off_two_numbers_have_an_answer(on_off: NodeProcess, number: str, state: str) -> None:
    """0 is OFF, 1 is ON."""
    assert terminal("rosservice", "call", "/on_off", number).stdout == f'state: "{state}"\n'


@pytest.mark.parametrize("number", ["2", "-1", "2147483647"])
def test_on_off_refuses_other_numbers(on_off: NodeProcess, number: str) -> None:
    """Any other number is refused in words that name it and say what would be right; the server goes on."""
    done = terminal("rosservice", "call", "/on_off", "--", number)
    assert done.returncode == 2
    assert f"cannot process request: {number} is neither 0 (OFF) nor 1 (ON)" in done.stderr
    assert "Traceback" not in on_off.output()
    assert terminal("rosservice", "call", "/on_off", "1").returncode == 0


def test_on_off_client_sends_either_number(on_off: NodeProcess) -> None:
    """The client prints what it sent and what it got, and sends now the one, now the other."""
    seen: set[str] = set()

    def both() -> bool:
        done = program("on_off_client")
        assert (done.returncode, done.stderr) == (0, "")
        seen.add(done.stdout)
        return len(seen) > 1

    eventually(both, timeout=60)
    assert seen == {"0: OFF\n", "1: ON\n"}


def test_on_off_client_takes_no_arguments() -> None:
    """A number on the command line is a wrong line: usage, and exit status 2, at once."""
    done = program("on_off_client", "1")
    assert done.returncode == 2
    assert done.stderr.startswith("usage: on_off_client")


def test_on_off_client_without_a_server() -> None:
    """Without a server the client gives up after 5 s, in one line, with exit status 1."""
    done = program("on_off_client")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "timeout exceeded while waiting for service /on_off\n"


def test_on_off_client_without_a_master() -> None:
    """Without a master the client says so, in one line, with exit status 1."""
    done = program("on_off_client", ROS_MASTER_URI="http://localhost:1")
    assert (done.returncode, done.stdout) == (1, "")
    assert "No ROS master at http://localhost:1" in done.stderr
    assert "Traceback" not in done.stderr


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
    pattern = r"\[DEBUG\] \[.*\]: A request to move, without effect: already open"
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
