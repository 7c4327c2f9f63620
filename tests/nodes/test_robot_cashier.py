"""The robot cashier: a detector, an arm and a till, started by one launch file, as its page asks for."""

from __future__ import annotations

import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
import rospy
from course_pkg.srv import AwaitCustomer, LetIn, TillSet, TillTotal
from std_srvs.srv import Trigger

from course_pkg.graph import BoundedProxy, NodeProcess
from tests.kernel import Kernel
from tests.nodes.terminals import terminal
from tests.support import eventually

pytestmark = pytest.mark.usefixtures("master")

LISTEN = """
from course_pkg import join
from sensor_msgs.msg import JointState
from std_msgs.msg import String
node = join("student")
"""
Response = Any  # a class that catkin generates
FOR_GOOD = 600.0  # s that a customer stays, longer than any test
LAUNCH = ("course_pkg", "robot_cashier.launch")


def run(name: str, service: str) -> NodeProcess:
    """Run a program of the system, and return it once it answers."""
    process = NodeProcess(["rosrun", "course_pkg", name])
    process.wait_for_service(service)
    return process


@pytest.fixture
def camera() -> Iterator[NodeProcess]:
    """`rosrun course_pkg counter_camera`, with nobody at the counter."""
    with run("counter_camera", "/let_in") as process:
        yield process


@pytest.fixture
def detector(camera: NodeProcess) -> Iterator[NodeProcess]:
    """`rosrun course_pkg customer_detector`, with a camera that it hears."""
    with run("customer_detector", "/detect_customer") as process:
        eventually(lambda: answered() is False)
        yield process


@pytest.fixture
def till() -> Iterator[NodeProcess]:
    """`rosrun course_pkg till`."""
    with run("till", "/till/reset") as process:
        yield process


def let_in(*after: float, stay: float = FOR_GOOD) -> Response:
    """Let customers in."""
    return BoundedProxy("/let_in", LetIn)(after=after, stay=stay)


def detect(patience: float = 0.0) -> bool:
    """Ask the detector."""
    return bool(BoundedProxy("/detect_customer", AwaitCustomer, timeout=70.0)(patience).found)


def answered() -> bool | None:
    """Return what a look says, None where it is refused."""
    try:
        return detect()
    except rospy.ServiceException:
        return None


@pytest.mark.usefixtures("detector")
def test_who_comes_is_found_by_everybody_who_waits() -> None:
    """One customer answers all questions that stand; with nobody there a look says so."""
    assert not detect()
    with ThreadPoolExecutor(5) as pool:
        waits = [pool.submit(detect, 30.0) for _ in range(5)]
        let_in(0.3)
        assert [wait.result(40) for wait in waits] == [True] * 5
    assert detect()


@pytest.mark.usefixtures("detector")
def test_patience_ends() -> None:
    """Where nobody comes, the answer is no, after the time that was given."""
    started = time.monotonic()
    assert not detect(0.5)
    assert 0.5 <= time.monotonic() - started < 10.0


@pytest.mark.usefixtures("detector")
@pytest.mark.parametrize("patience", [-0.1, 60.1, float("nan"), float("inf")])
def test_patience_that_cannot_be_is_refused(patience: float) -> None:
    """At once, and in words that name it."""
    with pytest.raises(rospy.ServiceException, match="cannot process request: patience"):
        detect(patience)


@pytest.mark.usefixtures("detector")
def test_a_camera_that_dies_is_no_answer_of_no(camera: NodeProcess) -> None:
    """The customer of its last frame is a memory after a second."""
    let_in(0.0)
    eventually(detect)
    camera.kill()
    eventually(lambda: answered() is None)
    with pytest.raises(rospy.ServiceException, match="cannot process request: the camera"):
        detect(0.2)


@pytest.mark.usefixtures("till")
def test_a_till_adds_up_and_refuses() -> None:
    """A price set again counts once; what cannot be is refused by name, and changes nothing."""
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
def test_many_at_once_add_up_and_a_reset_is_idempotent() -> None:
    """Whoever asks twice does no harm, and is told that there was nothing left to do."""
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda number: BoundedProxy("/till/set", TillSet)(str(number), number), range(1, 9)))
    reset = BoundedProxy("/till/reset", Trigger)
    answers = [reset(), reset()]
    assert [answer.success for answer in answers] == [True, True]
    assert [answer.message for answer in answers] == ["paid 36 cents", "already empty"]
    assert BoundedProxy("/till/total", TillTotal)().items == 0


def test_the_launch_file_leaves_the_till_out_where_it_is_told_to() -> None:
    """The rest is there in any case."""
    nodes = [
        set(terminal("roslaunch", "--nodes", *LAUNCH, *more).stdout.split()) for more in ([], ["till:=false"])
    ]
    assert nodes[0] - nodes[1] == {"/till"}
    assert nodes[1] == {"/counter_camera", "/robot", "/customer_detector", "/robot_cashier"}


def test_the_whole_system_greets_once_and_mirrors_meanwhile(kernel: Kernel) -> None:
    """The arm is mirrored while the cashier's question stands, and a customer is greeted a single time."""
    kernel.run(LISTEN)
    with NodeProcess.roslaunch(*LAUNCH, "till:=false", "wait:=20") as system:
        for service in ("/detect_customer", "/let_in", "/robot_cashier/get_loggers"):
            system.wait_for_service(service)
        kernel.run("mirrored = node.subscribe('/mirrored_joints', JointState)")
        kernel.run("greetings = node.subscribe('/greetings', String)")
        kernel.run("mirrored.wait(20, timeout=20)")
        eventually(lambda: answered() is False)
        let_in(0.0, stay=1.0)
        kernel.run("greetings.wait(1, timeout=20)")
        eventually(lambda: answered() is False)
        kernel.run("mirrored.wait(mirrored.count + 20, timeout=20)")
        assert kernel.run("result = greetings.count") == 1
