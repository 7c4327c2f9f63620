"""Tests that the course's programs meet the specification in chapter 15."""

from __future__ import annotations

import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest
import rospy
from course_pkg.srv import AwaitCustomer, LetIn, LetInResponse, TillSet, TillTotal
from std_srvs.srv import Trigger

from course_pkg.ros import BoundedProxy, NodeProcess
from tests.kernel import Kernel
from tests.support import eventually, terminal

pytestmark = pytest.mark.usefixtures("master")

LISTEN = """
from course_pkg import join
from sensor_msgs.msg import JointState
from std_msgs.msg import String
node = join("student")
"""
FOR_GOOD = 600.0  # A customer stays this time in s, which is longer than any test.
LAUNCH = ("course_pkg", "robot_cashier.launch")


def run(name: str, service: str) -> NodeProcess:
    """Start a program, wait until its service is available, and return the process."""
    process = NodeProcess(["rosrun", "course_pkg", name])
    process.wait_for_service(service)
    return process


@pytest.fixture
def camera() -> Iterator[NodeProcess]:
    """Run the camera without customers."""
    with run("counter_camera", "/let_in") as process:
        yield process


@pytest.fixture
def detector(camera: NodeProcess) -> Iterator[NodeProcess]:
    """Run the detector with a running camera and the node `vision`."""
    with (
        run("vision", "/vision/get_loggers"),
        run("customer_detector", "/detect_customer") as process,
    ):
        eventually(lambda: answered() is False)
        yield process


@pytest.fixture
def till() -> Iterator[NodeProcess]:
    """Run the till (the node of the cash register) with a printer that has paper for twelve lines."""
    with (
        NodeProcess(["rosrun", "course_pkg", "receipt_printer", "_paper:=12"]) as printer,
        run("till", "/till/reset") as process,
    ):
        printer.wait_for_service("/print_line")
        yield process


def let_in(*after: float, stay: float = FOR_GOOD) -> LetInResponse:
    """Let customers enter the shop."""
    return BoundedProxy("/let_in", LetIn)(after=after, stay=stay)


def detect(patience: float = 0.0) -> bool:
    """Call the detector."""
    return bool(BoundedProxy("/detect_customer", AwaitCustomer, timeout=70.0)(patience).found)


def answered() -> bool | None:
    """Return whether the detector sees a customer, or None if the detector refuses the call."""
    try:
        return detect()
    except rospy.ServiceException:
        return None


@pytest.mark.usefixtures("detector")
def test_all_waiting_calls_find_a_customer() -> None:
    """When a customer comes, all waiting calls return."""
    assert not detect()
    with ThreadPoolExecutor(5) as pool:
        waits = [pool.submit(detect, 30.0) for _ in range(5)]
        let_in(0.3)
        assert [wait.result(40) for wait in waits] == [True] * 5
    assert detect()


@pytest.mark.usefixtures("detector")
def test_a_call_ends_when_its_patience_is_over() -> None:
    """Without a customer, the call returns False after the requested time."""
    started = time.monotonic()
    assert not detect(0.5)
    assert 0.5 <= time.monotonic() - started < 10.0


@pytest.mark.usefixtures("detector")
def test_impossible_patience_is_refused() -> None:
    """If the waiting time is impossible, the error message contains the field's name "patience"."""
    for patience in (-0.1, 60.1, float("nan"), float("inf")):
        with pytest.raises(rospy.ServiceException, match="cannot process request: patience"):
            detect(patience)


@pytest.mark.usefixtures("detector")
def test_a_dead_camera_leads_to_a_refusal(camera: NodeProcess) -> None:
    """One second after the camera's last picture, the detector refuses calls."""
    let_in(0.0)
    eventually(detect)
    camera.kill()
    eventually(lambda: answered() is None)
    with pytest.raises(rospy.ServiceException, match=r"cannot process request: .*camera"):
        detect(0.2)


@pytest.mark.usefixtures("till")
def test_a_till_adds_up_and_refuses() -> None:
    """A new price of an item replaces the old price, and the till refuses an invalid item."""
    put = BoundedProxy("/till/set", TillSet)
    assert [put(item, cents).total for item, cents in (("milk", 120), ("bread", 340), ("milk", 110))] == [
        120,
        460,
        450,
    ]
    for item, cents, words in (("milk", -5, "milk: -5"), ("", 5, "name")):
        with pytest.raises(rospy.ServiceException, match=f"cannot process request: .*{words}"):
            put(item, cents)
    total = BoundedProxy("/till/total", TillTotal)()
    assert (total.cents, total.items) == (450, 2)


@pytest.mark.usefixtures("till")
def test_parallel_calls_add_up_and_a_reset_is_idempotent() -> None:
    """The till adds the items of simultaneous calls, and a second reset also succeeds."""
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda number: BoundedProxy("/till/set", TillSet)(str(number), number), range(1, 9)))
    reset = BoundedProxy("/till/reset", Trigger)
    answers = [reset(), reset()]
    assert [answer.success for answer in answers] == [True, True]
    assert [answer.message for answer in answers] == ["paid 36 cents", "already empty"]
    assert BoundedProxy("/till/total", TillTotal)().items == 0


@pytest.mark.usefixtures("till")
def test_an_item_that_is_not_printed_does_not_count() -> None:
    """When the printer has no more paper, the till refuses the item, and the total does not change."""
    put = BoundedProxy("/till/set", TillSet)
    for number in range(12):
        put(str(number), 1)
    with pytest.raises(rospy.ServiceException, match=r"cannot process request: .*out of paper"):
        put("bread", 340)
    assert BoundedProxy("/till/total", TillTotal)().cents == 12


def test_the_launch_file_leaves_the_hardware_out() -> None:
    """With hardware:=false, the launch file starts no camera, no arm and no printer."""
    nodes = [
        set(terminal("roslaunch", "--nodes", *LAUNCH, *more).stdout.split())
        for more in ([], ["hardware:=false"])
    ]
    assert nodes[0] - nodes[1] == {"/counter_camera", "/robot", "/receipt_printer"}
    assert nodes[1] == {"/vision", "/customer_detector", "/robot_cashier", "/till"}


def test_whole_system_greets_once_and_mirrors_at_the_same_time(kernel: Kernel) -> None:
    """The system greets each customer once, and the arm moves while a call waits."""
    kernel.run(LISTEN)
    with NodeProcess.roslaunch(*LAUNCH, "wait:=20") as system:
        for service in ("/detect_customer", "/let_in", "/till/reset", "/robot_cashier/get_loggers"):
            system.wait_for_service(service)
        kernel.run("mirrored = node.subscribe('/mirrored_joints', JointState)")
        kernel.run("greetings = node.subscribe('/greetings', String)")
        kernel.run("mirrored.wait(20, timeout=20)")
        eventually(lambda: answered() is False)
        eventually(lambda: BoundedProxy("/till/set", TillSet)("milk", 120).total == 120)
        let_in(0.0, stay=1.0)
        kernel.run("greetings.wait(1, timeout=20)")
        eventually(lambda: BoundedProxy("/till/total", TillTotal)().items == 0)
        kernel.run("mirrored.wait(mirrored.count + 20, timeout=20)")
        assert kernel.run("result = greetings.count") == 1
