"""A node of its own for one topic: it publishes, hears, sees who is there, and ends with its owner."""

from __future__ import annotations

import math
import os
import signal
import socket
import threading
from collections.abc import Iterator
from io import BytesIO
from typing import Any

import pytest

from course_pkg.graph import MasterClient, PrivateMaster, look
from course_pkg.graph.station import paths
from course_pkg.graph.station.curve import SPAN, STEP, Curve
from course_pkg.graph.station.metronome import CATCH_UP, Metronome
from course_pkg.graph.station.neighbours import Neighbour, look_around
from course_pkg.graph.station.pace import FEW, MOST, Pace
from course_pkg.graph.station.paths import extractor, numbers
from course_pkg.graph.station.process import TopicStation
from course_pkg.graph.station.wire import Wire
from course_pkg.interfaces import compile_message, message_type
from tests.kernel import Kernel
from tests.support import eventually, process_state, stopped

NUMBER = {"name": "std_msgs/Float64", "text": ""}


class Told:
    """What a station has reported: the latest of each part, and all that it heard."""

    def __init__(self, topic: str = "/speed") -> None:
        self.parts: dict[str, Any] = {}
        self.echo: list[dict[str, Any]] = []
        self.lost = ""
        self.station = TopicStation(topic, self._hear, self._lose)

    def spoken(self, part: str) -> Any:  # noqa: ANN401 - plain data
        """Return a part of what became of what was published."""
        return self.parts.get("spoken", {}).get(part)

    def _hear(self, _station: TopicStation, report: dict[str, Any]) -> None:
        self.echo += report.pop("echo", [])
        self.parts |= report

    def _lose(self, _station: TopicStation, words: str) -> None:
        self.lost = words


@pytest.fixture
def told(master: PrivateMaster) -> Iterator[Told]:
    """A station on /speed that sees the graph."""
    assert master.uri
    told = Told()
    eventually(lambda: told.parts.get("around"), timeout=20)
    yield told
    told.station.end(wait=True)


def publish(told: Told, text: str, **how: Any) -> None:  # noqa: ANN401
    """Have a number published."""
    told.station.tell("publish", **{"texts": {"data": text}, "latch": False, "queue": 10, "count": 1, **how})


def test_pace_is_that_of_what_goes_on() -> None:
    """Rate, jitter and longest gap of what came lately; nothing of what has stopped."""
    pace = Pace()
    assert pace.figures(0.0) == {}
    for at in (0.0, 0.1, 0.2, 0.4):
        pace.beat(at)
    figures = pace.figures(0.5)
    assert figures["rate"] == pytest.approx(7.5)
    assert figures["longest"] == pytest.approx(0.2)
    assert figures["jitter"] == pytest.approx(0.0471, abs=1e-4)
    assert pace.figures(5.0) == {}


def test_pace_holds_for_rare_and_for_frequent_events() -> None:
    """One in ten seconds has a rate, and ten thousand a second do not fill the memory."""
    slow, fast = Pace(), Pace()
    for number in range(10):
        slow.beat(10.0 * number)
    assert slow.figures(95.0) == pytest.approx({"rate": 0.1, "jitter": 0, "longest": 10, "gaps": FEW - 1})
    for number in range(3 * MOST):
        fast.beat(number / 10_000)
    assert fast.figures(3 * MOST / 10_000)["gaps"] == MOST - 1


def test_a_curve_keeps_what_can_be_seen() -> None:
    """Of each step the first, smallest, largest and last value remain, and of all only the last 20 s."""
    curve = Curve()
    for at, value in ((0.01, 5.0), (0.02, 9.0), (0.03, 1.0), (0.04, 4.0), (0.05, 3.0), (STEP * 1.5, 2.0)):
        curve.add(at, value)
    assert curve.points(1.0) == [(0.01, 5.0), (0.02, 9.0), (0.03, 1.0), (0.05, 3.0), (STEP * 1.5, 2.0)]
    for number in range(100_000):
        curve.add(1 + number / 1000, number % 7)
    assert len(curve.points(101.0)) <= 4 * (SPAN / STEP + 1)
    assert curve.points(101.0)[0][0] >= 81.0 - STEP


def test_a_curve_counts_what_is_no_number() -> None:
    """NaN and infinity are left out, and counted."""
    curve = Curve()
    for value in (1.0, float("nan"), float("inf")):
        curve.add(0.0, value)
    assert (curve.points(0.1), curve.count, curve.left_out) == ([(0.0, 1.0)], 3, 2)


def test_a_metronome_ticks_until_it_is_stopped() -> None:
    """After stop() has returned, no tick comes."""
    ticks: list[int] = []
    metronome = Metronome(1000.0, lambda: ticks.append(1), lambda _: None)
    eventually(lambda: len(ticks) > 20)
    metronome.stop()
    count = len(ticks)
    assert not any(thread.name == "metronome" for thread in threading.enumerate())
    assert len(ticks) == count


def test_a_metronome_leaves_out_what_is_long_past() -> None:
    """A tick that takes long is not made up for by a flood."""
    held = threading.Event()
    ticks: list[int] = []

    def tick() -> None:
        ticks.append(1)
        if len(ticks) == 3:
            held.wait(4 * CATCH_UP)

    metronome = Metronome(100.0, tick, lambda _: None)
    eventually(lambda: metronome.skipped > 0)
    metronome.stop()
    assert metronome.skipped >= 100 * 2 * CATCH_UP


def test_a_metronome_that_fails_says_so() -> None:
    """An error ends it, and its owner hears of it."""
    errors: list[Exception] = []

    def tick() -> None:
        raise ValueError("no more")

    Metronome(10.0, tick, errors.append)
    assert str(eventually(lambda: errors)[0]) == "no more"


def test_a_wire_carries_messages_whole() -> None:
    """Long ones and several at once arrive as they were sent; silence is None, an end is an EOFError."""
    one, other = map(Wire, socket.socketpair())
    long = {"texts": ["x" * 1000] * 300, "nan": None}
    sender = threading.Thread(target=lambda: [one.send(each) for each in (long, {"n": 1})])
    sender.start()
    assert [other.receive(5.0), other.receive(5.0)] == [long, {"n": 1}]
    sender.join()
    assert other.receive(0.0) is None
    one.close()
    for act in (other.receive, lambda: [other.send({}) for _ in range(3)]):
        with pytest.raises(EOFError):
            act()
    other.close()


def test_the_numbers_of_a_message_have_paths() -> None:
    """Fields, fields of fields and the first elements of arrays; no texts and no times."""
    assert numbers(message_type("std_msgs/Float64")) == ["data"]
    assert numbers(message_type("std_msgs/String")) == []
    assert numbers(message_type("geometry_msgs/Twist"))[:2] == ["linear.x", "linear.y"]
    joints = numbers(message_type("sensor_msgs/JointState"))
    assert joints[:2] == ["header.seq", "position[0]"]
    fixed = compile_message("demo/Fixed", "bool[2] flags\nfloat32[40] many\n")
    assert numbers(fixed)[:2] == ["flags[0]", "flags[1]"]
    assert len(numbers(fixed)) == 2 + 8
    deep = compile_message("demo/Deep", "geometry_msgs/PoseArray[] poses\n")
    assert len(numbers(deep)) == paths.MOST


def test_a_number_is_found_in_the_bytes() -> None:
    """What is not there is NaN; a path that the type does not have is refused."""
    kind = message_type("sensor_msgs/JointState")
    buffer = BytesIO()
    kind.to_message({**kind.default(), "position": [1.5, -2.5]}).serialize(buffer)
    assert extractor(kind, "position[1]")(buffer.getvalue()) == -2.5
    assert math.isnan(extractor(kind, "position[2]")(buffer.getvalue()))
    assert math.isnan(extractor(kind, "position[0]")(b""))
    with pytest.raises(ValueError, match="no number 'effort'"):
        extractor(kind, "effort")


def test_who_is_on_a_topic_and_of_which_type(master: PrivateMaster) -> None:
    """Each node is asked itself: the master knows one type only."""
    with Kernel() as one, Kernel() as other:
        one.run("""
            from course_pkg.graph import join
            node = join("talker")
            spoken = node.advertise("/mixed", "std_msgs/String")
        """)
        other.run("""
            from course_pkg.graph import join
            node = join("listener")
            heard = node.subscribe("/mixed", "std_msgs/Float64")
        """)
        around = look_around(MasterClient(master.uri), "/mixed")
    assert around.type == "std_msgs/String"
    assert around.publishers == (Neighbour("/talker", "std_msgs/String"),)
    assert around.subscribers == (Neighbour("/listener", "std_msgs/Float64"),)


def test_a_first_message_is_lost_and_a_second_heard(told: Told) -> None:
    """What is published before the connection stands is counted as unheard; the next comes back as text."""
    told.station.tell("type", **NUMBER)
    publish(told, "1.5")
    eventually(lambda: told.spoken("deliveries"))
    publish(told, "-2.5")
    echo = eventually(lambda: told.echo)
    assert [each["texts"] for each in echo] == [{"data": "-2.5"}]
    assert echo[0]["peer"] == told.parts["node"]
    eventually(lambda: told.spoken("sent") == 1)
    assert (told.spoken("published"), told.spoken("unheard"), told.spoken("reached")) == (2, 1, 1)


def test_a_latched_message_is_kept_for_its_subscriber(told: Told) -> None:
    """The first message reaches who connects after it."""
    told.station.tell("type", **NUMBER)
    publish(told, "7", latch=True)
    assert eventually(lambda: told.echo)[0]["texts"] == {"data": "7.0"}
    assert (told.spoken("unheard"), told.spoken("reached")) == (1, 0)


def test_a_publisher_ends_when_it_is_withdrawn_or_changed(told: Told, master: PrivateMaster) -> None:
    """Another queue size makes a new publisher, which counts anew; withdrawing leaves none on the graph."""
    told.station.tell("type", **NUMBER)
    publish(told, "1")
    eventually(lambda: told.spoken("published") == 1)
    publish(told, "1", queue=1, count=3)
    eventually(lambda: told.spoken("published") == 3)
    assert told.spoken("queue") == 1
    told.station.tell("withdraw")
    eventually(lambda: told.spoken("advertised") is False)
    assert not look_around(MasterClient(master.uri), "/speed").publishers


def test_a_rate_goes_on_until_it_is_stopped(told: Told) -> None:
    """Messages come again and again, are drawn, and end with the word stop."""
    told.station.tell("type", **NUMBER)
    told.station.tell("plot", path="data")
    told.station.tell("repeat", texts={"data": "4"}, latch=False, queue=10, rate=50.0)
    eventually(lambda: told.parts.get("count", 0) > 20, timeout=20)
    assert eventually(lambda: told.parts["pace"].get("rate"))
    assert {point[1] for point in eventually(lambda: told.parts["curve"]["points"])} == {4.0}
    told.station.tell("stop")
    eventually(lambda: told.spoken("rate") == 0)
    published = told.spoken("published")
    publish(told, "5")
    eventually(lambda: told.spoken("published") == published + 1)


def test_what_cannot_be_done_is_a_problem_and_no_end(told: Told) -> None:
    """Without a type, with a wrong value, with a path that is not there: the station goes on."""
    publish(told, "1")
    assert "type of the topic is not known" in eventually(lambda: told.spoken("problem"))
    told.station.tell("type", **NUMBER)
    publish(told, "fast")
    eventually(lambda: "'fast' is not a number" in told.spoken("problem"))
    told.station.tell("plot", path="speed")
    eventually(lambda: "no number 'speed'" in told.spoken("problem"))
    publish(told, "1")
    eventually(lambda: told.spoken("published") == 1)
    assert eventually(lambda: told.spoken("problem") == "")


def test_messages_of_another_type_are_heard_but_not_read(told: Told, kernel: Kernel) -> None:
    """The station hears whatever there is, and says of which type; it reads what is of its own."""
    told.station.tell("type", **NUMBER)
    kernel.run("""
        from course_pkg.graph import join
        node = join("talker")
        spoken = node.advertise("/speed", "std_msgs/String", latch=True)
        spoken.publish("fast")
    """)
    echo = eventually(lambda: told.echo)
    assert (echo[0]["type"], echo[0]["texts"], echo[0]["peer"]) == ("std_msgs/String", None, "/talker")
    source = eventually(lambda: told.parts["around"]["sources"])[0]
    assert (source["node"], source["type"]) == ("/talker", "std_msgs/String")


def test_a_type_that_was_made_in_a_notebook(told: Told) -> None:
    """Its text travels along."""
    kind = compile_message("demo/Spot", "float64 x\nstring what\n")
    told.station.tell("type", name=kind.name, text=kind.text)
    texts = {"x": "1", "what": "a"}
    told.station.tell("publish", texts=texts, latch=True, queue=1, count=1)
    assert eventually(lambda: told.echo)[0]["texts"] == {"x": "1.0", "what": "a"}


def test_it_leaves_nothing_behind(told: Told, master: PrivateMaster) -> None:
    """After end() its process and all its registrations are gone."""
    told.station.tell("type", **NUMBER)
    publish(told, "1")
    eventually(lambda: told.spoken("published") == 1)
    told.station.end(wait=True)
    assert process_state(told.station.pid) == "Z"
    assert look(master.uri).nodes == ()
    assert told.lost == ""


def test_one_that_dies_is_said_to_have_ended(told: Told, master: PrivateMaster) -> None:
    """Whoever uses it hears of it in a sentence, and the master of its end."""
    os.kill(told.station.pid, signal.SIGKILL)
    assert "The panel's node has ended." in eventually(lambda: told.lost)
    assert look(master.uri).nodes == ()
    publish(told, "1")


def test_one_that_is_stopped_ends_all_the_same(told: Told, master: PrivateMaster) -> None:
    """It cannot sign off, is killed, and is signed off by its owner; telling it something does not block."""
    eventually(lambda: told.parts.get("node"))
    with stopped(told.station.pid):
        for _ in range(100):
            publish(told, "1")
        told.station.end(wait=True)
        assert look(master.uri).nodes == ()


def test_messages_are_read_before_a_type_is_told(told: Told, kernel: Kernel) -> None:
    """As long as nobody has said which type the topic is to have, the sender's holds."""
    kernel.run("""
        from course_pkg.graph import join
        node = join("talker")
        spoken = node.advertise("/speed", "std_msgs/String", latch=True)
        spoken.publish("fast")
    """)
    assert eventually(lambda: told.echo)[0]["texts"] == {"data": "fast"}


def test_it_ends_with_its_owner(kernel: Kernel, master: PrivateMaster) -> None:
    """Also when the owner is killed: nothing of it stays on the graph."""
    pid = kernel.run("""
        from course_pkg.graph.station.process import TopicStation
        reports = []
        station = TopicStation("/speed", lambda _, report: reports.append(report), print)
        station.tell("type", name="std_msgs/Float64", text="")
        station.tell("repeat", texts={"data": "1"}, latch=False, queue=1, rate=10.0)
        result = station.pid
    """)
    eventually(lambda: look_around(MasterClient(master.uri), "/speed").publishers, timeout=20)
    kernel.kill()
    eventually(lambda: process_state(pid) == "Z")
    eventually(lambda: not look(master.uri).nodes)


def test_it_waits_for_a_master_and_comes_back_to_one(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Without a master it says why it does nothing; on one that was started again it registers again."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_LOG_DIR", str(tmp_path_factory.mktemp("ros")))
        patch.setenv("ROS_HOSTNAME", "localhost")
        master = PrivateMaster().start()
        master.stop()
        patch.setenv("ROS_MASTER_URI", master.uri)
        told = Told()
        try:
            assert "No ROS master" in eventually(lambda: told.parts.get("trouble"), timeout=20)
            for _ in range(2):
                with PrivateMaster(master.port):
                    eventually(lambda: told.parts.get("trouble") == "", timeout=20)
                    around = MasterClient(master.uri)
                    eventually(lambda: look_around(around, "/speed").subscribers, timeout=20)  # noqa: B023
                eventually(lambda: told.parts.get("trouble"), timeout=20)
        finally:
            told.station.end(wait=True)
