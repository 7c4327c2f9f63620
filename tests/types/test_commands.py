"""Tests of the commands that the panels show for a request or message."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.errors import FieldError
from course_pkg.ros import PrivateMaster
from course_pkg.types import (
    Plain,
    compile_message,
    compile_service,
    message_type,
    publisher_lines,
    rospy_line,
    rosservice_line,
    rostopic_line,
    service_type,
)
from tests.kernel import Kernel
from tests.types.random_values import AWKWARD


def line(text: str, **values: object) -> str:
    """Return the shell command for a request; `text` is the definition of the service."""
    return rosservice_line("/x", compile_service("course_pkg/Demo", f"{text}\n---\n"), values)


@pytest.mark.parametrize(
    ("text", "values", "expected"),
    [
        ("", {}, "rosservice call /x"),
        ("float32 a\nfloat32 b", {"a": 1.2, "b": 5.2}, "rosservice call /x 1.2 5.2"),
        ("float32 a\nint8 b", {"a": -1.0, "b": 2}, "rosservice call /x -- -1.0 2"),
        ("float64 a", {"a": 1e20}, "rosservice call /x 1.0e+20"),
        ("bool a\nstring b", {"a": True, "b": "hello"}, "rosservice call /x true hello"),
        ("string a", {"a": "two words"}, "rosservice call /x 'two words'"),
        ("string a", {"a": "yes"}, "rosservice call /x '\"yes\"'"),
        ("string a", {"a": ""}, "rosservice call /x ''"),
        ("string a", {"a": "a:=b"}, "rosservice call /x '\"a:\\x3Db\"'"),
        ("int8[] a", {"a": [1, 2]}, "rosservice call /x '{a: [1, 2]}'"),
        ("time a", {"a": {"secs": 1, "nsecs": 2}}, "rosservice call /x '{a: {secs: 1, nsecs: 2}}'"),
        ("int8[] on", {"on": [1]}, "rosservice call /x '{\"on\": [1]}'"),
    ],
)
def test_the_line_is_the_one_to_type(text: str, values: dict[str, object], expected: str) -> None:
    """In the shell command, each number or string is one argument, and ambiguous strings have quotes."""
    assert line(text, **values) == expected


def test_bash_passes_the_same_arguments() -> None:
    """Bash passes one unchanged argument per field to rosservice."""
    fields = "\n".join(f"string f{index}" for index in range(len(AWKWARD)))
    command = line(fields, **{f"f{index}": text for index, text in enumerate(AWKWARD)})
    assert "\n" not in command
    shown = subprocess.run(
        ["bash", "-c", f"rosservice() {{ echo $#; }}; {command}"], capture_output=True, check=True
    )
    assert int(shown.stdout) == len(["call", "/x", "--", *AWKWARD])


def test_values_that_do_not_fit_make_no_command() -> None:
    """If a value does not fit the type of its field, rosservice_line() raises a FieldError."""
    with pytest.raises(FieldError, match="length"):
        rosservice_line("/x", service_type("course_pkg/geometry"), {"length": 1e39, "width": 1, "height": 1})


def test_python_is_written_as_a_person_would() -> None:
    """The Python code contains the imports, the proxy, and one call with the fields as keywords."""
    values = {"length": 1.2, "width": 5.2, "height": 8.9}
    assert rospy_line("/getGeometry", service_type("course_pkg/geometry"), values) == (
        "import rospy\n"
        "from course_pkg.srv import geometry\n"
        "\n"
        'call = rospy.ServiceProxy("/getGeometry", geometry)\n'
        "response = call(length=1.2, width=5.2, height=8.9)"
    )


def test_python_keeps_types_of_one_name_apart() -> None:
    """If two types have the same short name, the Python code also contains the packages of the types."""
    kind = compile_service("course_pkg/Point", "geometry_msgs/Point p\n---\n")
    lines = rospy_line("/x", kind, kind.request.default())
    assert "import geometry_msgs.msg\n" in lines
    assert "call(p=geometry_msgs.msg.Point(x=0.0, y=0.0, z=0.0))" in lines


def test_python_of_unbuilt_parts_runs(packages: Path) -> None:
    """If types are not built, the Python code creates the types from their definitions."""
    assert packages.is_dir()
    kind = service_type("raw_pkg/Pack")
    value = {"crate": {"parts": [{"size": 2.0, "label": "nut"}]}}
    lines = rospy_line("/x", kind, value)
    names: dict[str, object] = {}
    exec(lines.rpartition("\nresponse")[0], names)  # noqa: S102 - the test asserts that they run
    assert {"Pack", "Crate", "Part"} <= set(names)


SERVER = """
import rospy
from odd_pkg.srv import Everything, EverythingResponse, Scalars, ScalarsResponse
from course_pkg.types import compile_service, service_type
rospy.init_node("odd", disable_signals=True)
heard = []
def keep(response):
    def handler(request):
        heard.append(service_type("odd_pkg/" + type(request).__name__[:-7]).request.to_values(request))
        return response
    return handler
services = [
    rospy.Service("/everything", Everything, keep(EverythingResponse())),
    rospy.Service("/scalars", Scalars, keep(ScalarsResponse("well"))),
]
"""


@pytest.fixture
def server(packages: Path, master: PrivateMaster) -> Iterator[Kernel]:
    """Run a node that serves the built types and stores the requests."""
    assert packages.is_dir()
    assert master.running
    with Kernel() as kernel:
        kernel.run(SERVER)
        yield kernel


def shell(command: str) -> str:
    """Run a command in bash, and return its output."""
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_lines_call_a_running_service(server: Kernel) -> None:
    """The shell command and the Python code send the same values to a server."""
    scalars, everything = service_type("odd_pkg/Scalars"), service_type("odd_pkg/Everything")
    one = {"a": -1.5, "b": -7, "c": True, "d": "it's 'yes': a:=b\n$HOME 🐢", "e": 2**64 - 1}
    many = {
        **everything.request.default(),
        # rospy overwrites each `seq` in a request with the number of the call.
        "header": {"seq": 1, "stamp": {"secs": 1, "nsecs": 5}, "frame_id": "map"},
        "data": [0, 255],
        "signed": [-128, 127],
        "names": ["no", "1.0", "", "a, b"],
        "times": [{"secs": 4, "nsecs": 5}],
        "waited": {"secs": -1, "nsecs": 5},
        "parts": [{"size": 0.1, "label": "{x}"}],
    }
    assert "well" in shell(rosservice_line("/scalars", scalars, one))
    shell(rosservice_line("/everything", everything, many))
    python = rospy_line("/everything", everything, many)
    subprocess.run([sys.executable, "-c", python], env=os.environ, timeout=60, check=True)
    assert server.run("result = heard") == [one, many, many]


def test_a_compiled_type_serves_a_built_one(server: Kernel) -> None:
    """A client with the built class can call a service with a class that was made from text."""
    told = server.run("""
text = service_type("odd_pkg/Scalars").text
compiled = compile_service("odd_pkg/Scalars", text).cls
services[1].shutdown()
again = rospy.Service("/again", compiled, lambda request: (request.d * 2,))
result = rospy.ServiceProxy("/again", Scalars)(d="ab").told
result += rospy.ServiceProxy("/again", compiled)(d="cd").told
""")
    assert told == "ababcdcd"


@pytest.mark.parametrize(
    ("kind", "values", "how", "expected"),
    [
        ("Float64", {"data": 1.5}, {}, "rostopic pub --once /x std_msgs/Float64 1.5"),
        ("Float64", {"data": -1.5}, {"rate": 10.0}, "rostopic pub -r 10 /x std_msgs/Float64 -- -1.5"),
        ("Float64", {"data": 1.0}, {"latch": True}, "rostopic pub /x std_msgs/Float64 1.0"),
        ("Int8", {"data": 1}, {"rate": 0.5, "latch": True}, "rostopic pub -r 0.5 --latch /x std_msgs/Int8 1"),
        ("String", {"data": ""}, {}, "rostopic pub --once /x std_msgs/String '\"\"'"),
        ("String", {"data": "it's"}, {}, "rostopic pub --once /x std_msgs/String 'it'\"'\"'s'"),
        ("Empty", {}, {}, "rostopic pub --once /x std_msgs/Empty"),
        (
            "Time",
            {"data": {"secs": 1, "nsecs": 2}},
            {},
            "rostopic pub --once /x std_msgs/Time '{data: {secs: 1, nsecs: 2}}'",
        ),
    ],
)
def test_the_publishing_line_is_the_one_to_type(
    kind: str, values: dict[str, object], how: dict[str, Plain], expected: str
) -> None:
    """In `rostopic pub`, the options are before the topic, and negative numbers are after "--"."""
    assert rostopic_line("/x", message_type(f"std_msgs/{kind}"), values, **how) == expected


def test_a_publisher_is_written_as_a_person_would() -> None:
    """The Python code contains the imports and the publisher, and publishes once or at the given rate."""
    kind = message_type("std_msgs/Float64")
    once = publisher_lines("/x", kind, {"data": -1.0}, queue_size=1, latch=True)
    assert once == (
        "import rospy\n"
        "from std_msgs.msg import Float64\n"
        "\n"
        'publisher = rospy.Publisher("/x", Float64, queue_size=1, latch=True)\n'
        "publisher.publish(data=-1.0)"
    )
    often = publisher_lines("/x", kind, {"data": -1.0}, rate=10.0)
    assert often.endswith(
        "rate = rospy.Rate(10)\n"
        "while not rospy.is_shutdown():\n"
        "    publisher.publish(data=-1.0)\n"
        "    rate.sleep()"
    )


def test_a_publisher_of_a_type_that_is_not_built_comes_from_its_text() -> None:
    """If a type is not built, the Python code makes the class from the definition's text."""
    kind = compile_message("demo/Spot", "geometry_msgs/Point at\nstring what\n")
    lines = publisher_lines("/x", kind, {"at": {"x": 1.0, "y": 2.0, "z": 3.0}, "what": "a"})
    names: dict[str, object] = {}
    exec(lines.partition("\npublisher")[0], names)  # noqa: S102 - the test asserts that they run
    assert {"Spot", "Point"} <= set(names)
    assert 'publisher.publish(at=Point(x=1.0, y=2.0, z=3.0), what="a")' in lines


LISTENER = """
import time
from course_pkg.types import message_type
from course_pkg.ros import join
node = join("listener")
joints = node.subscribe("/joints", "sensor_msgs/JointState")
words = node.subscribe("/words", "std_msgs/String")
"""


def test_lines_publish_to_a_running_subscriber(master: PrivateMaster) -> None:
    """The shell command and the Python code publish the same values."""
    assert master.running
    joint, text = message_type("sensor_msgs/JointState"), message_type("std_msgs/String")
    moved = {
        **joint.default(),
        "header": {"seq": 1, "stamp": {"secs": 1, "nsecs": 5}, "frame_id": "it's"},
        "name": ["no", "", "a, b"],
        "position": [-0.1, 1e20],
    }
    awkward = "it's 'yes': a:=b\n$HOME \U0001f422"
    with Kernel() as kernel:
        kernel.run(LISTENER)
        shell(rostopic_line("/words", text, {"data": awkward}))
        assert kernel.run("result = words.wait(1)[0].data") == awkward
        shell(rostopic_line("/joints", joint, moved))
        python = publisher_lines("/joints", joint, moved, latch=True)
        start = python.replace("import rospy", "import rospy\nrospy.init_node('talker')", 1)
        ends = "\nrospy.sleep(1)"
        subprocess.run([sys.executable, "-c", start + ends], env=os.environ, timeout=60, check=True)
        kernel.run("kind = message_type('sensor_msgs/JointState')")
        heard = kernel.run("result = [kind.to_values(message) for message in joints.wait(2)]")
        assert heard == [moved, moved]
