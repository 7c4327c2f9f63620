"""The course's node behaves like the turtlesim of ROS."""

from __future__ import annotations

import os
import subprocess

import pytest

from course_pkg.ros import NodeProcess, PrivateMaster, look
from course_pkg.types import message_type, service_type
from tests.kernel import Kernel
from tests.support import eventually

MD5 = {
    "Color": "353891e354491c51aabe32df673fb446",
    "Pose": "863b248d5016ca62ea2e895ae5265cf9",
    "Spawn": "0b2d2e872a8e2887d5ed626f2bf2c561",
    "Kill": "c1f3d28f1b044c871e6eff2e9fc3c667",
    "SetPen": "9f452acce566bf0c0954594f69a8e41b",
    "TeleportAbsolute": "a130bc60ee6513855dc62ea83fcc5b20",
    "TeleportRelative": "9d5c2dcd348ac8f76ce2a4307bd63a13",
}
CLIENT = """
import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty
from turtlesim.msg import Color, Pose
from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative
from course_pkg import join

node = join("client")
def words(name, kind, *values):
    try:
        return node.call(name, kind, *values)
    except rospy.ServiceException as error:
        return str(error)
def pose(name="turtle1", after=0):
    with node.subscribe(f"/{name}/pose", Pose) as heard:
        return heard.wait(1 + after)[-1]
"""


@pytest.fixture
def client(kernel: Kernel, simulator: NodeProcess) -> Kernel:
    """Return a kernel that runs a node.

    The fixture resets the simulator, so that it contains only turtle1.
    """
    kernel.run(CLIENT + "node.call('/reset', Empty)")
    return kernel


def terminal(*command: str) -> str:
    """Run a command, and return its output."""
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=30, env=dict(os.environ), check=False
    )
    return done.stdout + done.stderr


@pytest.mark.parametrize("name", MD5)
def test_the_types_are_those_of_the_real_package(name: str) -> None:
    """The types have the same MD5 sums as in ROS."""
    kind = message_type if name in ("Color", "Pose") else service_type
    assert kind(f"turtlesim/{name}").cls._md5sum == MD5[name]


def test_the_node_has_the_topics_and_services_of_turtlesim(simulator: NodeProcess) -> None:
    """The topics and services have the names and types of turtlesim."""
    seen = eventually(lambda: look() if look().service("/turtle1/teleport_absolute") else None)
    own = [each for each in seen.services if each.node == "/turtlesim"]
    services = {each.name: each.type for each in own if "logger" not in each.name}
    assert services == {
        "/clear": "std_srvs/Empty",
        "/kill": "turtlesim/Kill",
        "/reset": "std_srvs/Empty",
        "/spawn": "turtlesim/Spawn",
        "/turtle1/set_pen": "turtlesim/SetPen",
        "/turtle1/teleport_absolute": "turtlesim/TeleportAbsolute",
        "/turtle1/teleport_relative": "turtlesim/TeleportRelative",
    }
    topics = {each.name: each for each in seen.topics}
    assert topics["/turtle1/pose"].type == "turtlesim/Pose"
    assert topics["/turtle1/color_sensor"].type == "turtlesim/Color"
    assert topics["/turtle1/cmd_vel"].subscribers == ("/turtlesim",)


def test_parameters(simulator: NodeProcess) -> None:
    """Three private parameters of the simulator contain the background colour."""
    shown = [terminal("rosparam", "get", f"/turtlesim/background_{each}").strip() for each in "rgb"]
    assert shown == ["69", "86", "255"]


def test_a_used_name_is_refused(client: Kernel, simulator: NodeProcess) -> None:
    """A second spawn with the same name fails, and the node's log contains the reason."""
    client.run("node.call('/spawn', Spawn, 3, 3, 0, 'MyTurtle')")
    said = client.run("result = words('/spawn', Spawn, 3, 3, 0, 'MyTurtle')")
    assert said == "service [/spawn] responded with an error: b''"
    eventually(lambda: "A turtled named [MyTurtle] already exists" in simulator.output())


def test_an_unknown_turtle_cannot_be_killed(client: Kernel, simulator: NodeProcess) -> None:
    """Killing an unknown turtle fails, and the node's log contains the reason."""
    said = client.run("result = words('/kill', Kill, 'nobody')")
    assert said == "service [/kill] responded with an error: b''"
    eventually(lambda: "Tried to kill turtle [nobody], which does not exist" in simulator.output())


def test_an_illegal_name(client: Kernel) -> None:
    """The error message for an invalid turtle name contains the invalid character and its position."""
    said = client.run("result = words('/spawn', Spawn, 3, 3, 0, 'my turtle')")
    assert "Character [ ] at element [2] is not valid in Graph Resource Name [my turtle]" in said
    assert not [topic for topic in look().topics if topic.name.startswith("/my")]


def test_a_name_in_a_namespace(client: Kernel) -> None:
    """The name a/b is valid, and the turtle's topics begin with a/b."""
    client.run("node.call('/spawn', Spawn, 3, 3, 0, 'a/b')")
    assert client.run("result = round(pose('a/b').x, 3)") == 3.0


def test_a_killed_turtle_leaves_the_graph(client: Kernel) -> None:
    """A killed turtle has no services, and a new turtle can use its name."""
    client.run("node.call('/spawn', Spawn, 3, 3, 0, 'brief')")
    client.run("node.call('/kill', Kill, 'brief')")
    assert not look().service("/brief/set_pen")
    assert client.run("result = node.call('/spawn', Spawn, 3, 3, 0, 'brief').name") == "brief"


def test_driving(client: Kernel) -> None:
    """One message with linear.x = 1 moves the turtle by about 1.008 m."""
    client.run("order = Twist(); order.linear.x = 1.0; before = pose().x")
    client.run("publisher = rospy.Publisher('/turtle1/cmd_vel', Twist, queue_size=1)")
    client.run(
        "import time\nuntil = time.monotonic() + 10\n"
        "while not publisher.get_num_connections() and time.monotonic() < until: time.sleep(0.01)\n"
        "publisher.publish(order)"
    )
    moved = eventually(
        lambda: client.run("last = pose(after=5); result = last.linear_velocity == 0 and last.x - before")
    )
    assert moved == pytest.approx(1.008, abs=0.033)


def test_teleport_and_colour(client: Kernel) -> None:
    """After two teleports, the colour sensor reads the colour of the line."""
    client.run("node.call('/turtle1/set_pen', SetPen, 200, 100, 50, 9, 0)")
    client.run("node.call('/turtle1/teleport_absolute', TeleportAbsolute, 8, 8, 0)")
    client.run("node.call('/turtle1/teleport_relative', TeleportRelative, -0.5, 0)")
    seen = client.run(
        "with node.subscribe('/turtle1/color_sensor', Color) as heard:\n"
        "    colour = heard.wait(3)[-1]\nresult = [colour.r, colour.g, colour.b]"
    )
    assert seen == [200, 100, 50]


def test_subscribers_keep_their_connection_after_a_reset(client: Kernel) -> None:
    """After a reset, a subscriber of turtle1 still receives poses."""
    client.run("heard = node.subscribe('/turtle1/pose', Pose)")
    client.run("node.call('/turtle1/teleport_absolute', TeleportAbsolute, 1, 1, 0); heard.wait()")
    client.run("node.call('/reset', Empty); count = heard.count")
    eventually(
        lambda: client.run("result = heard.count > count + 5 and round(heard.messages[-1].x, 3) == 5.544")
    )
    client.run("heard.stop()")


def test_reset_brings_a_killed_first_turtle_back(client: Kernel) -> None:
    """After turtle1 was killed, a reset creates turtle1 again."""
    client.run("node.call('/kill', Kill, 'turtle1'); node.call('/reset', Empty)")
    assert client.run("result = round(pose().x, 3)") == 5.544


@pytest.mark.parametrize(
    ("name", "kind", "values"),
    [
        ("/spawn", "Spawn", "float('nan'), 1, 0, 'odd'"),
        ("/turtle1/teleport_absolute", "TeleportAbsolute", "1, float('inf'), 0"),
        ("/turtle1/teleport_relative", "TeleportRelative", "float('-inf'), 0"),
    ],
)
def test_numbers_that_are_not_finite_are_refused(client: Kernel, name: str, kind: str, values: str) -> None:
    """If a number in a call is NaN or infinity, the call fails, and turtle1 does not move."""
    said = client.run(f"result = words('{name}', {kind}, {values})")
    assert "not finite" in said
    assert client.run("result = round(pose().x, 3)") == 5.544


def test_a_velocity_that_is_not_finite_is_ignored(client: Kernel) -> None:
    """A velocity message with NaN does not move the turtle."""
    client.run(
        "import time\norder = Twist(); order.angular.z = float('nan')\n"
        "publisher = rospy.Publisher('/turtle1/cmd_vel', Twist, queue_size=1)\n"
        "until = time.monotonic() + 10\n"
        "while not publisher.get_num_connections() and time.monotonic() < until: time.sleep(0.01)\n"
        "publisher.publish(order)"
    )
    assert client.run("last = pose(after=5); result = [round(last.x, 3), last.theta]") == [5.544, 0.0]


def test_two_simulators_side_by_side(master: PrivateMaster, simulator: NodeProcess) -> None:
    """If a simulator runs in a namespace, all its names begin with the namespace."""
    with NodeProcess(["rosrun", "turtlesim", "turtlesim_node", "__ns:=/left"]) as left:
        left.wait_for_service("/left/spawn")
        eventually(lambda: look().service("/left/turtle1/set_pen"))


def test_an_invalid_background_colour_is_ignored(client: Kernel) -> None:
    """If a parameter of the background colour is not a number, /clear uses the default colour."""
    terminal("rosparam", "set", "/turtlesim/background_r", "blue")
    assert "ERROR" not in terminal("rosservice", "call", "/clear")
    seen = client.run(
        "with node.subscribe('/turtle1/color_sensor', Color) as heard:\n"
        "    colour = heard.wait(3)[-1]\nresult = [colour.r, colour.g, colour.b]"
    )
    terminal("rosparam", "set", "/turtlesim/background_r", "69")
    assert seen == [69, 86, 255]


def test_a_request_may_have_a_field_called_name(client: Kernel) -> None:
    """node.call accepts a field called `name`."""
    made = client.run("result = node.call('/spawn', Spawn, x=2, y=2, theta=0, name='Named').name")
    assert made == "Named"


def test_calls_of_the_simulator_are_recorded(client: Kernel) -> None:
    """A recording contains the events of the simulator's handler and of the waiting client."""
    kinds = client.run(
        "with node.record() as recording:\n"
        "    node.call('/turtle1/teleport_absolute', TeleportAbsolute, 4, 4, 0)\n"
        "events = [each for each in recording.events if each.name == '/turtle1/teleport_absolute']\n"
        "result = sorted({(str(each.kind), each.node) for each in events})"
    )
    assert ["handler", "/turtlesim"] in kinds
    assert ["wait", "/client"] in kinds


@pytest.mark.parametrize("seed", [1, 2])
def test_bad_clients_do_no_harm(seed: int, master: PrivateMaster, kernel: Kernel) -> None:
    """After 400 random actions of a client, the services of turtle1 still work."""
    with NodeProcess(["rosrun", "turtlesim", "turtlesim_node"]) as simulator:
        simulator.wait_for_service("/spawn")
        refused = kernel.run(
            f"""
            from course_pkg import join
            from tests.turtlesim.fuzz import Fuzzer, sane
            node = join("fuzz")
            fuzzer = Fuzzer(node, {seed})
            for _ in range(400):
                fuzzer.step()
            sane(node)
            result = fuzzer.refused
            """,
            timeout=100,
        )
        assert refused > 20
        assert simulator.running
