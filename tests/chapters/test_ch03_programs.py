"""Tests of the programs of chapter 03: the camera, the detector of customers, and the cashier."""

from __future__ import annotations

import math
import os
import signal
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from xmlrpc.client import ServerProxy

import pytest
import rospy
from course_pkg.srv import (
    CashierReport,
    CashierReportResponse,
    DetectCustomer,
    DetectCustomerResponse,
    LetIn,
    LetInResponse,
)

from course_pkg.ros import BoundedProxy, MasterClient, NodeProcess, PrivateMaster
from tests.kernel import Kernel
from tests.support import eventually, program, usual

pytestmark = pytest.mark.usefixtures("master")

FOR_GOOD = 600.0  # A customer stays this time in s, which is longer than any test.
SERVES = {"shop_camera": "/let_in", "detector": "/detect_customer", "cashier": "/cashier/report"}


def run(name: str, *arguments: str) -> NodeProcess:
    """Start a program of the shop, wait until its service is available, and return the process."""
    process = NodeProcess(["rosrun", "course_pkg", name, *arguments])
    process.wait_for_service(SERVES[name])
    return process


@pytest.fixture(autouse=True)
def without_parameters(master: PrivateMaster) -> None:
    """Remove the parameters of earlier programs from the master."""
    with ServerProxy(master.uri) as parameters:
        for node in SERVES:
            parameters.deleteParam("/tests", f"/{node}")


@pytest.fixture
def camera() -> Iterator[NodeProcess]:
    """Run the camera without customers."""
    with run("shop_camera") as process:
        yield process


@pytest.fixture
def detector(camera: NodeProcess) -> Iterator[NodeProcess]:
    """Run the detector with a running camera."""
    with run("detector") as process:
        yield process


def let_in(*after: float, stay: float = FOR_GOOD) -> LetInResponse:
    """Let customers enter the shop."""
    return BoundedProxy("/let_in", LetIn)(after=after, stay=stay)


def detect(after: int = 0, patience: float = 0.0) -> DetectCustomerResponse:
    """Call the detector."""
    return BoundedProxy("/detect_customer", DetectCustomer, timeout=70.0)(after, patience)


def report() -> CashierReportResponse:
    """Return the cashier's report."""
    return BoundedProxy("/cashier/report", CashierReport)()


@pytest.mark.usefixtures("detector")
def test_call_with_patience_0() -> None:
    """If the field `patience` is 0, the call returns immediately."""
    assert (detect().detected, detect().number) == (False, 0)
    came = let_in(0.0)
    answer = detect(patience=10.0)
    assert (answer.detected, answer.number) == (True, came.first)
    assert 0.0 <= answer.arrived.to_sec() - came.comes[0].to_sec() < 5.0
    assert detect().number == came.first
    assert not detect(after=came.first).detected


@pytest.mark.usefixtures("detector")
def test_waiting_call_ends_when_a_customer_comes() -> None:
    """A waiting call returns soon after a customer has arrived."""
    came = let_in(0.5)
    answer = detect(patience=30.0)
    assert came.comes[0].to_sec() <= time.time() < came.comes[0].to_sec() + 10.0
    assert answer.number == came.first


@pytest.mark.usefixtures("detector")
def test_call_without_a_customer_ends_after_its_patience() -> None:
    """If no customer comes, the call returns detected=False after the given time."""
    started = time.monotonic()
    assert not detect(patience=0.5).detected
    assert 0.5 <= time.monotonic() - started < 5.0


@pytest.mark.usefixtures("detector")
def test_customers_who_come_together_are_returned_one_by_one() -> None:
    """Each call returns the first customer with a higher number than the number in the request."""
    first = let_in(0.0, 0.0, 0.0).first
    numbers = [first - 1]
    for _ in range(3):
        numbers.append(detect(after=numbers[-1], patience=10.0).number)
    assert numbers == [first - 1, first, first + 1, first + 2]


@pytest.mark.usefixtures("detector")
def test_all_waiting_calls_return_the_customer() -> None:
    """Ten waiting calls all return the same customer."""
    with ThreadPoolExecutor(10) as pool:
        answers = [pool.submit(detect, patience=30.0) for _ in range(10)]
        first = let_in(0.5).first
        assert {answer.result(20).number for answer in answers} == {first}


@pytest.mark.usefixtures("detector")
def test_impossible_patience_is_refused_with_the_range() -> None:
    """If the waiting time in the request is impossible, the error message contains the allowed range."""
    words = (
        "cannot process request: patience: a wait of .* s is not possible; "
        "expected a number of seconds from 0 to 60"
    )
    for patience in (-1.0, math.nan, math.inf, 61.0):
        with pytest.raises(rospy.ServiceException, match=words):
            detect(patience=patience)
        assert not detect().detected


@pytest.mark.usefixtures("detector")
def test_number_of_waiting_calls_is_limited() -> None:
    """At most 64 calls can wait, and the server refuses further calls immediately."""
    with ThreadPoolExecutor(80) as pool:
        waiting = [pool.submit(detect, patience=60.0) for _ in range(80)]
        eventually(lambda: sum(future.done() for future in waiting) >= 16, timeout=20)
        refused = [str(future.exception()) for future in waiting if future.done()]
        assert [error for error in refused if "64 other clients are waiting" not in error] == []
        assert len(refused) == 16
        let_in(0.0)
        assert sum(future.exception(20) is None for future in waiting) == 64


def test_calls_fail_without_a_camera_and_recover(camera: NodeProcess, detector: NodeProcess) -> None:
    """Calls fail after the camera is killed, and succeed again with a new camera.

    After the camera starts again, new customers have higher numbers than all earlier customers.
    """
    first = let_in(0.0).first
    assert detect(patience=10.0).number == first
    with ThreadPoolExecutor(1) as pool:
        waiting = pool.submit(detect, first, 60.0)
        camera.kill()
        assert "no message from the camera for 2 s" in str(waiting.exception(15))
    with pytest.raises(
        rospy.ServiceException, match="customers cannot be detected: check that shop_camera is running"
    ):
        detect()
    with run("shop_camera"):
        eventually(lambda: _answers() and not detect().detected)
        assert let_in(0.0).first == first + 1
        assert detect(after=first, patience=10.0).number == first + 1


def _answers() -> bool:
    try:
        detect()
    except rospy.ServiceException:
        return False
    return True


def test_detector_refuses_without_a_camera() -> None:
    """Without a camera, the detector refuses the call."""
    with run("detector"), pytest.raises(rospy.ServiceException, match="customers cannot be detected"):
        detect()


@pytest.mark.parametrize(
    ("after", "stay", "words"),
    [
        ([0.0, math.nan], 1.0, r"after\[1\]: nan s is not a valid waiting time"),
        ([-1.0], 1.0, r"after\[0\]: -1 s is not a valid waiting time"),
        ([0.0], math.inf, "stay: inf s"),
        ([0.0] * 1001, 1.0, "1001 customers are too many"),
    ],
)
@pytest.mark.usefixtures("camera")
def test_impossible_customers_are_refused(after: list[float], stay: float, words: str) -> None:
    """If a field of the request is invalid, the error message contains the name of the field."""
    with pytest.raises(rospy.ServiceException, match=words):
        let_in(*after, stay=stay)
    assert len(let_in(5.0, 1.0).comes) == 2


@pytest.mark.usefixtures("detector")
def test_each_customer_is_published_once(master: PrivateMaster, kernel: Kernel) -> None:
    """The detector publishes the number of each customer once."""
    kernel.run("from course_pkg import join\nfrom std_msgs.msg import UInt32\nnode = join('listener')")
    kernel.run("heard = node.subscribe('/customers', UInt32)")
    with ServerProxy(MasterClient(master.uri).lookup_node("/detector") or "") as node:
        eventually(lambda: any("/customers" in row for row in node.getBusInfo("/tests")[2]))
    first = let_in(0.0, 0.0, 0.3, 0.6).first
    heard = kernel.run("result = [message.data for message in heard.wait(4, timeout=15)]")
    assert heard == [first, first + 1, first + 2, first + 3]
    eventually(lambda: not detect(after=first + 3).detected)
    assert kernel.run("result = heard.count") == 4


SETTINGS = {
    "poll": ["_design:=poll", "_rate:=20"],
    "topic": ["_design:=topic"],
    "wait": ["_design:=wait", "_patience:=0.5"],
    "default": [],
}


@pytest.mark.parametrize("settings", usual(3, SETTINGS))
@pytest.mark.usefixtures("detector")
def test_cashier_greets_each_customer_once(settings: list[str]) -> None:
    """Each version of the cashier greets the customers once and in the right order."""
    with run("cashier", *settings) as cashier:
        came = let_in(0.2, 0.2, 0.9)
        eventually(lambda: len(report().greeted) >= 3, timeout=20)
        said = report()
        assert list(said.greeted) == [came.first, came.first + 1, came.first + 2]
        waits = [at.to_sec() - comes.to_sec() for at, comes in zip(said.greeted_at, came.comes, strict=True)]
        assert min(waits) >= 0.0
        assert len(said.learnt_at) >= 3
        assert (said.asked > 0, said.heard) == ((False, 3) if "_design:=topic" in settings else (True, 0))
        assert cashier.running


def test_cashier_continues_without_a_detector(camera: NodeProcess) -> None:
    """After the detector starts again, the cashier greets customers again."""
    with run("cashier", "_design:=poll", "_rate:=50") as cashier:
        eventually(lambda: "The call failed, so the cashier soon calls again" in cashier.output())
        with run("detector"):
            first = let_in(0.0).first
            eventually(lambda: list(report().greeted) == [first])
        assert cashier.output().count("so the cashier soon calls again") == 1


@pytest.mark.parametrize("answer", ["(True, 1, rospy.Time())", "(False, 0, rospy.Time())"])
@pytest.mark.parametrize("settings", [["_design:=wait", "_patience:=0.5"], ["_design:=poll", "_rate:=2"]])
def test_cashier_limits_its_rate_of_calls(kernel: Kernel, answer: str, settings: list[str]) -> None:
    """The cashier makes at most two calls per second, even if the responses come immediately."""
    kernel.run("import rospy\nfrom course_pkg import join\nfrom course_pkg.srv import DetectCustomer")
    kernel.run(
        f"join('student'); rospy.Service('/detect_customer', DetectCustomer, lambda request: {answer})"
    )
    started = time.monotonic()
    with run("cashier", *settings):
        eventually(lambda: report().asked >= 4)
        asked, seconds = report().asked, time.monotonic() - started
        assert asked <= 2 * seconds + 3
        assert len(report().greeted) == answer.startswith("(True")


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (["_design:=hope"], "~design is 'hope', but it has to be one of poll, topic, wait"),
        (["_rate:=0"], "/cashier/rate is 0, but it has to be a number from 0.01 to 1000"),
        (["_rate:=often"], "/cashier/rate is 'often'"),
        (["_patience:=-1"], "/cashier/patience is -1"),
    ],
)
def test_cashier_with_a_wrong_parameter_ends_with_a_message(settings: list[str], words: str) -> None:
    """If a parameter is wrong, the program prints the allowed values, and its exit status is 1."""
    done = program("cashier", *settings)
    assert done.returncode == 1
    assert words in done.stderr
    assert "Traceback" not in done.stderr


def test_random_customers_come() -> None:
    """With the parameter _every:=0.1, the camera sees customers at random times."""
    with run("shop_camera", "_every:=0.1"), run("detector"):
        assert detect(patience=20.0).detected


def test_the_launch_file_runs_the_whole_shop() -> None:
    """The launch file starts a camera, a detector and a cashier, and the cashier greets customers."""
    with NodeProcess.roslaunch("course_pkg", "shop.launch", "every:=0.2", "design:=topic") as process:
        process.wait_for_service("/cashier/report", timeout=20)
        eventually(lambda: report().greeted, timeout=20)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_nodes_end_after_a_signal(
    number: signal.Signals, detector: NodeProcess, camera: NodeProcess, master: PrivateMaster
) -> None:
    """After SIGINT or SIGTERM, each node unregisters and exits without a traceback."""
    with ThreadPoolExecutor(2) as pool, run("cashier", "_design:=wait", "_patience:=60") as cashier:
        waiting = pool.submit(detect, patience=60.0)
        eventually(lambda: report().asked)
        for process in (cashier, detector, camera):
            os.kill(process.pid, number)
            assert process.wait(20) == 0
            assert "Traceback" not in process.output()
        assert isinstance(waiting.exception(10), rospy.ServiceException)
    assert MasterClient(master.uri).system_state().nodes == ()


@pytest.mark.parametrize("name", ["shop_camera", "detector", "cashier", "polled_camera"])
def test_the_nodes_wait_for_a_master(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a master, a node waits and prints a message, and Ctrl-C ends the node."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    with NodeProcess(["rosrun", "course_pkg", name]) as process:
        eventually(lambda: "The program waits for a master" in process.output())
        process.interrupt()
        assert process.wait(20) == 0
        assert "Traceback" not in process.output()


@pytest.mark.parametrize("name", ["shop_camera", "detector", "cashier", "polled_camera"])
def test_an_end_that_comes_during_the_start(name: str, master: PrivateMaster) -> None:
    """If Ctrl-C arrives during the start, a node exits and is not registered."""
    client = MasterClient(master.uri)
    with NodeProcess(["rosrun", "course_pkg", name, f"__name:=new_{name}"]) as process:
        # The node registers at the master during init_node(), so SIGINT arrives during the start.
        eventually(partial(client.lookup_node, f"/new_{name}"), interval=0.001)
        os.kill(process.pid, signal.SIGINT)
        assert process.wait(20) == 0
        assert "Traceback" not in process.output()
    assert client.system_state().nodes == ()
