"""Tests of the robot's joint states, and of the simulator's mirrored joint states."""

from __future__ import annotations

import math
import os
import signal
from collections.abc import Iterator

import pytest
from sensor_msgs.msg import JointState

from course_pkg.nodes.robot import ARM, joint_state
from course_pkg.nodes.simulator import mirrored
from course_pkg.ros import MasterClient, NodeProcess, PrivateMaster
from tests.kernel import Kernel
from tests.support import eventually

pytestmark = pytest.mark.usefixtures("master")

LISTEN = """
import time
import rospy
from course_pkg import join
from sensor_msgs.msg import JointState
from std_msgs.msg import UInt32
node = join("student")

def connected(publisher):
    while not publisher.get_num_connections():
        time.sleep(0.01)
"""


@pytest.fixture
def simulator() -> Iterator[NodeProcess]:
    """Run `rosrun course_pkg simulator`, and wait until the simulator is registered."""
    with NodeProcess(["rosrun", "course_pkg", "simulator"]) as process:
        process.wait_for_service("/simulator/get_loggers")
        yield process


def test_a_joint_state_has_matching_positions_and_velocities() -> None:
    """Each velocity is the derivative of the position, and each position is within the joint's limits."""
    step = 1e-5
    for at in (0.0, 0.7, 3.1, 100.0):
        now, soon = joint_state(at), joint_state(at + step)
        assert list(now.name) == ["base", "shoulder", "elbow", "wrist"]
        for joint, here, there, speed in zip(ARM, now.position, soon.position, now.velocity, strict=True):
            assert (there - here) / step == pytest.approx(speed, abs=1e-3)
            assert abs(here - joint.middle) <= joint.reach


def test_the_mirror_image_has_the_opposite_signs() -> None:
    """A mirrored state has the same time and names, but opposite positions and velocities."""
    message = JointState(name=["a", "b"], position=[0.5, -1.0], velocity=[0.0, 2.0], effort=[1.0, 1.0])
    message.header.stamp.secs = 7
    shown = mirrored(message)
    assert (shown.position, shown.velocity) == ([-0.5, 1.0], [0.0, -2.0])
    assert (shown.header.stamp.secs, shown.name, shown.effort) == (7, ["a", "b"], [1.0, 1.0])
    assert (message.position, message.velocity) == ([0.5, -1.0], [0.0, 2.0])


@pytest.mark.parametrize(
    ("odd", "message"),
    [
        (JointState(name=["a", "b"], position=[1.0]), "1 positions for 2 joints"),
        (JointState(name=[], position=[1.0]), "1 positions for 0 joints"),
        (JointState(name=["a"], position=[math.nan]), "one of the positions is not a finite number"),
        (JointState(name=["a"], position=[math.inf]), "one of the positions is not a finite number"),
        (JointState(name=["a"], position=[1.0], velocity=[1.0, 2.0]), "2 velocities for 1 joints"),
        (
            JointState(name=["a"], position=[1.0], velocity=[math.nan]),
            "one of the velocities is not a finite",
        ),
    ],
)
def test_an_invalid_joint_state_is_refused(odd: JointState, message: str) -> None:
    """Lists of different lengths, and infinite or NaN values, raise an error."""
    with pytest.raises(ValueError, match=message):
        mirrored(odd)


@pytest.mark.parametrize("fine", [JointState(), JointState(name=["a"], position=[1.0], velocity=[])])
def test_a_joint_state_may_have_no_joints_or_no_velocities(fine: JointState) -> None:
    """The node accepts a joint state without joints, or without velocities."""
    assert len(mirrored(fine).position) == len(fine.name)


def test_the_robot_publishes_at_its_rate(kernel: Kernel) -> None:
    """The robot publishes joint states at the given rate."""
    kernel.run(LISTEN)
    with NodeProcess(["rosrun", "course_pkg", "robot", "_rate:=100"]):
        kernel.run("heard = node.subscribe('/joint_states', JointState).wait(50, timeout=20)")
    stamps = kernel.run("result = [message.header.stamp.to_sec() for message in heard]")
    assert stamps == sorted(stamps)
    # The period at 100 Hz is 0.01 s, and the period at the default rate of 20 Hz is 0.05 s.
    assert 0.009 < (stamps[-1] - stamps[0]) / (len(stamps) - 1) < 0.05
    jumps = kernel.run(
        "result = [max(abs(b - a) for a, b in zip(one.position, next.position))"
        " for one, next in zip(heard, heard[1:])]"
    )
    assert 0 < max(jumps) < 0.5


def test_the_simulator_mirrors_every_state_while_it_draws(simulator: NodeProcess, kernel: Kernel) -> None:
    """The simulator publishes all mirrored states in order while it draws pictures."""
    kernel.run(LISTEN)
    kernel.run(
        "shown, pictures = node.subscribe('/mirrored_joints', JointState),"
        " node.subscribe('/simulator/pictures', UInt32)\n"
        "say = rospy.Publisher('/joint_states', JointState, queue_size=100)\n"
        "connected(say); pictures.wait(1, timeout=10)"
    )
    kernel.run("for n in range(60): say.publish(JointState(name=['a'], position=[n])); time.sleep(0.02)")
    assert kernel.run("result = [message.position[0] for message in shown.wait(60)]") == [
        -float(number) for number in range(60)
    ]
    assert kernel.run("result = pictures.wait(3, timeout=10)[2].data") >= 3


def test_an_invalid_message_is_ignored(simulator: NodeProcess, kernel: Kernel) -> None:
    """The node prints one warning about the invalid states, and mirrors the next valid state."""
    kernel.run(LISTEN)
    kernel.run(
        "shown = node.subscribe('/mirrored_joints', JointState); connected(shown._subscriber)\n"
        "say = rospy.Publisher('/joint_states', JointState, queue_size=100); connected(say)\n"
        "for position in ([], [1.0, 2.0], [float('nan')], [float('inf')], [3.0]):\n"
        "    say.publish(JointState(name=['a'], position=position))"
    )
    assert kernel.run("result = [list(message.position) for message in shown.wait(1)]") == [[-3.0]]
    eventually(lambda: simulator.output().count("joint state: 0 positions for 1 joints") == 1)
    assert "Traceback" not in simulator.output()


def test_the_launch_file_starts_both(kernel: Kernel) -> None:
    """The launch file starts the robot and the simulator."""
    kernel.run(LISTEN)
    with NodeProcess.roslaunch("course_pkg", "mirror.launch", "rate:=50"):
        kernel.run("shown = node.subscribe('/mirrored_joints', JointState).wait(20, timeout=20)")
    apart = kernel.run("result = (shown[-1].header.stamp - shown[0].header.stamp).to_sec()")
    assert 0.018 < apart / 19 < 0.05
    with NodeProcess.roslaunch("course_pkg", "mirror.launch", "simulator:=false") as process:
        process.wait_for_service("/robot/get_loggers")
        assert kernel.run("from course_pkg.ros import look; result = look().node('/simulator')") is None


@pytest.mark.parametrize("program", ["robot", "simulator"])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_each_node(program: str, number: signal.Signals, master: PrivateMaster) -> None:
    """After SIGINT or SIGTERM, each node unregisters and exits without a traceback."""
    with NodeProcess(["rosrun", "course_pkg", program]) as process:
        process.wait_for_service(f"/{program}/get_loggers")
        os.kill(process.pid, number)
        assert process.wait(10) == 0
        assert "Traceback" not in process.output()
    assert MasterClient(master.uri).lookup_node(f"/{program}") is None


@pytest.mark.parametrize(
    ("command", "message"),
    [
        (("robot", "_rate:=fast"), "/robot/rate is 'fast'"),
        (("simulator", "_drawing:=0"), "/simulator/drawing is 0"),
    ],
)
def test_an_invalid_parameter_is_refused(command: tuple[str, ...], message: str) -> None:
    """If a parameter is invalid, the error message contains its name and value, and the exit status is 1."""
    with NodeProcess(["rosrun", "course_pkg", *command]) as process:
        assert process.wait(10) == 1
        assert message in process.output()
        assert "Traceback" not in process.output()
