"""Tests of the separate process that publishes and subscribes for a topic panel."""

from __future__ import annotations

import math
import os
import signal
import socket
import threading
from collections.abc import Iterator
from io import BytesIO

import pytest

from course_pkg.errors import ChannelClosed, ChannelTimeout
from course_pkg.ros import MasterClient, PrivateMaster, look
from course_pkg.ros.protocol.json_channel import JsonChannel
from course_pkg.ros.topic import field_paths
from course_pkg.ros.topic.connections import find_connections
from course_pkg.ros.topic.field_paths import extractor, measurement, numbers
from course_pkg.ros.topic.publishing import CATCH_UP, Timer
from course_pkg.ros.topic.reports import MessageReport, Report
from course_pkg.ros.topic.statistics import FEW, MOST, SPAN, STEP, DownsampledSeries, RateStatistics
from course_pkg.ros.topic.topic_process import TopicProcess
from course_pkg.types import Plain, compile_message, message_type
from tests.kernel import Kernel
from tests.support import eventually, process_state, stopped

NUMBER = {"name": "std_msgs/Float64", "text": ""}


class Reports:
    """The reports that a topic process has sent: the latest values, and all received messages."""

    def __init__(self, topic: str = "/speed") -> None:
        self.parts: Report = {}
        self.messages: list[MessageReport] = []
        self.lost = ""
        self.process = TopicProcess(topic, self._report, self._lose)

    def published(self, part: str) -> Plain:
        """Return a value from the latest report about the publisher; `part` is the name of the value."""
        return self.parts.get("publisher", {}).get(part)

    def _report(self, _process: TopicProcess, report: Report) -> None:
        self.messages += report.pop("messages", [])
        self.parts |= report

    def _lose(self, _process: TopicProcess, message: str) -> None:
        self.lost = message


@pytest.fixture
def reports(master: PrivateMaster) -> Iterator[Reports]:
    """Start a topic process for the topic /speed, and wait until the process has found the graph."""
    assert master.uri
    reports = Reports()
    eventually(lambda: reports.parts.get("connections"), timeout=20)
    yield reports
    reports.process.end(wait=True)


def publish(reports: Reports, text: str, **how: Plain) -> None:
    """Publish a number."""
    reports.process.tell(
        "publish", **{"texts": {"data": text}, "latch": False, "queue": 10, "count": 1, **how}
    )


def test_rate_of_recent_messages() -> None:
    """The rate, the jitter and the longest gap are calculated from recent messages."""
    statistics = RateStatistics()
    assert statistics.figures(0.0) == {}
    for at in (0.0, 0.1, 0.2, 0.4):
        statistics.beat(at)
    figures = statistics.figures(0.5)
    assert figures["rate"] == pytest.approx(7.5)
    assert figures["longest"] == pytest.approx(0.2)
    assert figures["jitter"] == pytest.approx(0.0471, abs=1e-4)
    assert statistics.figures(5.0) == {}


def test_rate_of_rare_and_of_frequent_messages() -> None:
    """The rate is right for one message per 10 s, and for 10,000 messages per second."""
    slow, fast = RateStatistics(), RateStatistics()
    for number in range(10):
        slow.beat(10.0 * number)
    assert slow.figures(95.0) == pytest.approx({"rate": 0.1, "jitter": 0, "longest": 10, "gaps": FEW - 1})
    for number in range(3 * MOST):
        fast.beat(number / 10_000)
    assert fast.figures(3 * MOST / 10_000)["gaps"] == MOST - 1


def test_a_curve_keeps_extreme_values() -> None:
    """The curve contains the first, smallest, largest and last value of each time step.

    The curve does not contain values that are older than 20 s.
    """
    curve = DownsampledSeries()
    for at, value in ((0.01, 5.0), (0.02, 9.0), (0.03, 1.0), (0.04, 4.0), (0.05, 3.0), (STEP * 1.5, 2.0)):
        curve.add(at, value)
    assert curve.points(1.0) == [(0.01, 5.0), (0.02, 9.0), (0.03, 1.0), (0.05, 3.0), (STEP * 1.5, 2.0)]
    for number in range(100_000):
        curve.add(1 + number / 1000, number % 7)
    assert len(curve.points(101.0)) <= 4 * (SPAN / STEP + 1)
    assert curve.points(101.0)[0][0] >= 81.0 - STEP


def test_a_curve_counts_invalid_numbers() -> None:
    """The curve counts NaN and infinity, but does not store these values."""
    curve = DownsampledSeries()
    for value in (1.0, float("nan"), float("inf")):
        curve.add(0.0, value)
    assert (curve.points(0.1), curve.count, curve.left_out) == ([(0.0, 1.0)], 3, 2)


def test_a_timer_ticks_until_it_is_stopped() -> None:
    """After stop(), the timer does not call its function any more."""
    ticks: list[int] = []
    timer = Timer(1000.0, lambda: ticks.append(1), lambda _: None)
    eventually(lambda: len(ticks) > 20)
    timer.stop()
    count = len(ticks)
    assert not any(thread.name == "publish-timer" for thread in threading.enumerate())
    assert len(ticks) == count


def test_a_timer_skips_late_ticks() -> None:
    """If a call takes too long, the timer skips and counts the missed calls."""
    held = threading.Event()
    ticks: list[int] = []

    def tick() -> None:
        ticks.append(1)
        if len(ticks) == 3:
            held.wait(4 * CATCH_UP)

    timer = Timer(100.0, tick, lambda _: None)
    eventually(lambda: timer.skipped > 0)
    timer.stop()
    assert timer.skipped >= 100 * 2 * CATCH_UP


def test_a_failing_timer_reports_the_error() -> None:
    """If the timer's function raises an error, the timer passes the error to the callback for errors."""
    errors: list[Exception] = []

    def tick() -> None:
        raise ValueError("no more")

    Timer(10.0, tick, errors.append)
    assert str(eventually(lambda: errors)[0]) == "no more"


def test_a_channel_transfers_whole_messages() -> None:
    """A channel transfers long messages unchanged."""
    one, other = map(JsonChannel, socket.socketpair())
    long = {"texts": ["x" * 1000] * 300, "nan": None}
    sender = threading.Thread(target=lambda: [one.send(each) for each in (long, {"n": 1})])
    sender.start()
    assert [other.receive(5.0), other.receive(5.0)] == [long, {"n": 1}]
    sender.join()
    with pytest.raises(ChannelTimeout):
        other.receive(0.0)
    one.close()
    for act in (other.receive, lambda: [other.send({}) for _ in range(3)]):
        with pytest.raises(ChannelClosed):
            act()
    other.close()


def test_the_numbers_of_a_message_have_paths() -> None:
    """numbers() returns the paths of at most `MOST` number fields, even in nested messages and arrays."""
    assert numbers(message_type("std_msgs/Float64")) == ["data"]
    assert numbers(message_type("std_msgs/String")) == []
    assert numbers(message_type("geometry_msgs/Twist"))[:2] == ["linear.x", "linear.y"]
    joints = numbers(message_type("sensor_msgs/JointState"))
    assert joints[:2] == ["header.seq", "position[0]"]
    fixed = compile_message("demo/Fixed", "bool[2] flags\nfloat32[40] many\n")
    assert numbers(fixed)[:2] == ["flags[0]", "flags[1]"]
    assert len(numbers(fixed)) == 2 + 8
    deep = compile_message("demo/Deep", "geometry_msgs/PoseArray[] poses\n")
    assert len(numbers(deep)) == field_paths.MOST


@pytest.mark.parametrize(
    ("name", "path"),
    [
        ("std_msgs/Float64", "data"),
        ("std_msgs/String", ""),
        ("std_msgs/Header", "seq"),
        ("std_msgs/UInt32", "data"),
        ("sensor_msgs/JointState", "position[0]"),
        ("sensor_msgs/LaserScan", "ranges[0]"),
        ("sensor_msgs/Range", "range"),
        ("sensor_msgs/Imu", "orientation.x"),
        ("sensor_msgs/NavSatFix", "latitude"),
        ("sensor_msgs/Joy", "axes[0]"),
    ],
)
def test_the_first_measurement_of_a_message(name: str, path: str) -> None:
    """measurement() ignores numbers in a header and settings of the sensor, such as range_min."""
    assert measurement(message_type(name)) == path


def test_a_whole_number_is_a_measurement_if_the_message_has_no_float() -> None:
    """If a message has no float, measurement() returns the first integer or bool."""
    counted = compile_message("demo/Counted", "std_msgs/Header header\nbool on\nint32 parts\n")
    switched = compile_message("demo/Switched", "std_msgs/Header header\nbool on\n")
    assert (measurement(counted), measurement(switched)) == ("parts", "on")
    stamped = compile_message("demo/Stamped", "geometry_msgs/PoseStamped[] poses\n")
    assert measurement(stamped) == "poses[0].pose.position.x"


def test_a_number_is_found_in_the_bytes() -> None:
    """extractor() reads a number from the bytes of a message, and an unknown path raises ValueError."""
    kind = message_type("sensor_msgs/JointState")
    buffer = BytesIO()
    kind.to_message({**kind.default(), "position": [1.5, -2.5]}).serialize(buffer)
    assert extractor(kind, "position[1]")(buffer.getvalue()) == -2.5
    assert math.isnan(extractor(kind, "position[2]")(buffer.getvalue()))
    assert math.isnan(extractor(kind, "position[0]")(b""))
    with pytest.raises(ValueError, match="no number at the path 'effort'"):
        extractor(kind, "effort")


def test_nodes_of_a_topic_and_their_types(master: PrivateMaster) -> None:
    """find_connections() returns the type of each node that publishes or subscribes to the topic."""
    with Kernel() as one, Kernel() as other:
        one.run("""
            import rospy
            from std_msgs.msg import String
            from course_pkg.ros import join
            node = join("talker")
            publisher = rospy.Publisher("/mixed", String, queue_size=10)
        """)
        other.run("""
            from course_pkg.ros import join
            node = join("listener")
            heard = node.subscribe("/mixed", "std_msgs/Float64")
        """)
        found = find_connections(MasterClient(master.uri), "/mixed")
    assert found["type"] == "std_msgs/String"
    assert found["publishers"] == [{"node": "/talker", "type": "std_msgs/String"}]
    assert found["subscribers"] == [{"node": "/listener", "type": "std_msgs/Float64"}]


def test_a_first_message_is_lost_and_a_second_is_reported(reports: Reports) -> None:
    """`unheard` counts the first message, which has no connected subscriber; the second one is received."""
    reports.process.tell("type", **NUMBER)
    publish(reports, "1.5")
    eventually(lambda: reports.published("deliveries"))
    publish(reports, "-2.5")
    messages = eventually(lambda: reports.messages)
    assert [each["texts"] for each in messages] == [{"data": "-2.5"}]
    assert messages[0]["peer"] == reports.parts["node"]
    eventually(lambda: reports.published("sent") == 1)
    assert (reports.published("published"), reports.published("unheard"), reports.published("reached")) == (
        2,
        1,
        1,
    )


def test_a_latched_message_is_kept_for_its_subscriber(reports: Reports) -> None:
    """A latched message reaches a later subscriber."""
    reports.process.tell("type", **NUMBER)
    publish(reports, "7", latch=True)
    assert eventually(lambda: reports.messages)[0]["texts"] == {"data": "7.0"}
    assert (reports.published("unheard"), reports.published("reached")) == (1, 0)


def test_a_publisher_ends_when_it_is_stopped_or_changed(reports: Reports, master: PrivateMaster) -> None:
    """If the queue size changes, a publisher with the new queue size replaces the old publisher.

    The command `withdraw` unregisters the publisher from the topic.
    """
    reports.process.tell("type", **NUMBER)
    publish(reports, "1")
    eventually(lambda: reports.published("published") == 1)
    publish(reports, "1", queue=1, count=3)
    eventually(lambda: reports.published("published") == 3)
    assert reports.published("queue") == 1
    reports.process.tell("withdraw")
    eventually(lambda: reports.published("advertised") is False)
    assert not find_connections(MasterClient(master.uri), "/speed")["publishers"]


def test_repeated_messages_until_stop(reports: Reports) -> None:
    """After the command `repeat`, the process publishes messages until the command `stop`."""
    reports.process.tell("type", **NUMBER)
    reports.process.tell("plot", path="data")
    reports.process.tell("repeat", texts={"data": "4"}, latch=False, queue=10, rate=50.0)
    eventually(lambda: reports.parts.get("count", 0) > 20, timeout=20)
    assert eventually(lambda: reports.parts["statistics"].get("rate"))
    assert {point[1] for point in eventually(lambda: reports.parts["curve"]["points"])} == {4.0}
    reports.process.tell("stop")
    eventually(lambda: reports.published("rate") == 0)
    published = reports.published("published")
    publish(reports, "5")
    eventually(lambda: reports.published("published") == published + 1)


def test_an_invalid_command_is_reported_and_the_process_continues(reports: Reports) -> None:
    """The topic process reports an invalid command, and continues."""
    publish(reports, "1")
    assert "the topic has no type yet" in eventually(lambda: reports.published("problem"))
    reports.process.tell("type", **NUMBER)
    publish(reports, "fast")
    eventually(lambda: "'fast' is not a number" in reports.published("problem"))
    reports.process.tell("plot", path="speed")
    eventually(lambda: "no number at the path 'speed'" in reports.published("problem"))
    publish(reports, "1")
    eventually(lambda: reports.published("published") == 1)
    assert eventually(lambda: reports.published("problem") == "")


def test_messages_of_another_type_are_reported_without_values(reports: Reports, kernel: Kernel) -> None:
    """The topic process reports a message of another type without its values."""
    reports.process.tell("type", **NUMBER)
    kernel.run("""
        import rospy
        from std_msgs.msg import String
        from course_pkg.ros import join
        node = join("talker")
        publisher = rospy.Publisher("/speed", String, queue_size=10, latch=True)
        publisher.publish("fast")
    """)
    messages = eventually(lambda: reports.messages)
    seen = messages[0]["type"], messages[0]["texts"], messages[0]["peer"]
    assert seen == ("std_msgs/String", None, "/talker")
    source = eventually(lambda: reports.parts["connections"]["sources"])[0]
    assert (source["node"], source["type"]) == ("/talker", "std_msgs/String")


def test_a_type_that_was_made_in_a_notebook(reports: Reports) -> None:
    """The topic process can use a message type that a notebook has compiled from text."""
    kind = compile_message("demo/Spot", "float64 x\nstring what\n")
    reports.process.tell("type", name=kind.name, text=kind.text)
    texts = {"x": "1", "what": "a"}
    reports.process.tell("publish", texts=texts, latch=True, queue=1, count=1)
    assert eventually(lambda: reports.messages)[0]["texts"] == {"x": "1.0", "what": "a"}


def test_end_removes_the_process_and_its_registrations(reports: Reports, master: PrivateMaster) -> None:
    """After end(), the process has exited and has no registrations."""
    reports.process.tell("type", **NUMBER)
    publish(reports, "1")
    eventually(lambda: reports.published("published") == 1)
    reports.process.end(wait=True)
    assert process_state(reports.process.pid) == "Z"
    assert look(master.uri).nodes == ()
    assert reports.lost == ""


def test_a_killed_process_is_reported(reports: Reports, master: PrivateMaster) -> None:
    """If the topic process is killed, TopicProcess reports an error and unregisters the node."""
    os.kill(reports.process.pid, signal.SIGKILL)
    assert "The panel's node has ended." in eventually(lambda: reports.lost)
    assert look(master.uri).nodes == ()
    publish(reports, "1")


def test_a_stopped_process_is_killed(reports: Reports, master: PrivateMaster) -> None:
    """end() kills a topic process that is suspended with SIGSTOP, and unregisters its node."""
    eventually(lambda: reports.parts.get("node"))
    with stopped(reports.process.pid):
        for _ in range(100):
            publish(reports, "1")
        reports.process.end(wait=True)
        assert look(master.uri).nodes == ()


def test_messages_are_read_before_a_type_is_set(reports: Reports, kernel: Kernel) -> None:
    """Before the command `type`, the topic process uses the message type of the publisher."""
    kernel.run("""
        import rospy
        from std_msgs.msg import String
        from course_pkg.ros import join
        node = join("talker")
        publisher = rospy.Publisher("/speed", String, queue_size=10, latch=True)
        publisher.publish("fast")
    """)
    assert eventually(lambda: reports.messages)[0]["texts"] == {"data": "fast"}


def test_it_ends_with_its_owner(kernel: Kernel, master: PrivateMaster) -> None:
    """If the parent process of a topic process is killed, the topic process exits and is unregistered."""
    pid = kernel.run("""
        from course_pkg.ros.topic.topic_process import TopicProcess
        reports = []
        process = TopicProcess("/speed", lambda _, report: reports.append(report), print)
        process.tell("type", name="std_msgs/Float64", text="")
        process.tell("repeat", texts={"data": "1"}, latch=False, queue=1, rate=10.0)
        result = process.pid
    """)
    eventually(lambda: find_connections(MasterClient(master.uri), "/speed")["publishers"], timeout=20)
    kernel.kill()
    eventually(lambda: process_state(pid) == "Z")
    eventually(lambda: not look(master.uri).nodes)


def test_it_waits_for_a_master_and_registers_again(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Without a master, the topic process reports the reason, and registers when a master has started."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_LOG_DIR", str(tmp_path_factory.mktemp("ros")))
        patch.setenv("ROS_HOSTNAME", "localhost")
        master = PrivateMaster().start()
        master.stop()
        patch.setenv("ROS_MASTER_URI", master.uri)
        reports = Reports()
        try:
            assert "No ROS master" in eventually(lambda: reports.parts.get("trouble"), timeout=20)
            for _ in range(2):
                with PrivateMaster(master.port):
                    eventually(lambda: reports.parts.get("trouble") == "", timeout=20)
                    client = MasterClient(master.uri)
                    eventually(lambda: find_connections(client, "/speed")["subscribers"], timeout=20)  # noqa: B023
                eventually(lambda: reports.parts.get("trouble"), timeout=20)
        finally:
            reports.process.end(wait=True)
