"""Tests of the topic panel's model with a fake topic process."""

from __future__ import annotations

import json

import pytest

from course_pkg.errors import NotATopic
from course_pkg.panels.topic.model import BURST, TopicModel
from course_pkg.panels.topic.reports import mismatches, published
from course_pkg.panels.topic.settings import Settings
from course_pkg.ros.topic.reports import Connections, MessageReport, PublisherReport
from course_pkg.types import MessageType, Plain, compile_message, message_type

FLOAT = message_type("std_msgs/Float64")
STRING = message_type("std_msgs/String")
EMPTY: Connections = {"type": "", "publishers": [], "subscribers": [], "sources": []}


class FakeProcess:
    """Replaces the topic process, and stores the commands and the state that the model sends."""

    def __init__(self, kind: MessageType | None = FLOAT, topic: str = "/speed") -> None:
        self.state: dict[str, Plain] = {}
        self.commands: list[tuple[str, dict[str, Plain]]] = []
        self.model = TopicModel(topic, kind, lambda **parts: self.state.update(parts), self._take)

    def _take(self, do: str, **what: Plain) -> None:
        self.commands.append((do, what))


def message(number: int, data: str, kind: MessageType = FLOAT, **other: Plain) -> MessageReport:
    """Return a message in the format in which the topic process reports it."""
    about = {"number": number, "ago": 0.1, "peer": "/talker", "size": 8, "type": kind.name, "md5": kind.md5}
    return {**about, "texts": {"data": data}, **other}


def test_a_form_and_its_commands_are_there_at_once() -> None:
    """The model shows the fields and commands without a ROS graph."""
    state = FakeProcess().state
    assert [field["name"] for field in state["about"]["message"]["fields"]] == ["data"]
    assert state["about"]["numbers"] == ["data"]
    assert state["about"]["listen"] == ["rostopic echo /speed", "rostopic hz /speed", "rostopic info /speed"]
    assert state["check"]["once"] == "rostopic pub --once /speed std_msgs/Float64 0.0"
    assert state["settings"]["path"] == "data"


def test_a_measurement_is_drawn_first() -> None:
    """By default, the panel plots the first measured value, and not header.seq."""
    process = FakeProcess(message_type("sensor_msgs/JointState"), "/joint_states")
    assert process.state["about"]["numbers"][0] == "header.seq"
    assert process.state["settings"]["path"] == "position[0]"
    assert process.commands[-1] == ("plot", {"path": "position[0]"})


@pytest.mark.parametrize("name", ["speed", "/", "/a//b", "/my speed", "~speed", "/1", "/a\nb", ""])
def test_an_invalid_name_is_refused(name: str) -> None:
    """If the topic name is invalid, the error message describes valid names."""
    with pytest.raises(NotATopic, match="Use a full name"):
        FakeProcess(topic=name)


def test_a_topic_without_a_type_waits_for_one() -> None:
    """A panel without a type uses the type of a publisher, and not the type of a subscriber."""
    process = FakeProcess(None)
    assert "No node publishes /speed yet" in process.state["about"]["problem"]
    process.model.see({**EMPTY, "subscribers": [{"node": "/listener", "type": "*"}]})
    assert "message" not in process.state["about"]
    talker = {"node": "/talker", "type": "std_msgs/String"}
    process.model.see({**EMPTY, "type": "std_msgs/Float64", "publishers": [talker]})
    assert process.state["about"]["message"]["name"] == "std_msgs/String"
    assert process.commands == [("type", {"name": "std_msgs/String", "text": ""}), ("plot", {"path": ""})]


def test_the_first_message_gives_the_type() -> None:
    """If no type is known, the first message determines the type."""
    process = FakeProcess(None)
    process.model.report({"messages": [message(1, "2.5")]})
    assert process.state["messages"][0]["line"] == "data 2.5"
    assert process.state["about"]["message"]["name"] == "std_msgs/Float64"


def test_an_unknown_type_is_reported() -> None:
    """If a topic's type is not installed on this machine, the panel shows a message."""
    process = FakeProcess(None)
    process.model.see({**EMPTY, "publishers": [{"node": "/talker", "type": "their_pkg/Thing"}]})
    assert "their_pkg/Thing" in process.state["about"]["problem"]


def test_a_new_process_gets_the_type_and_the_path() -> None:
    """A new topic process receives the type and the plot settings of the page."""
    kind = compile_message("demo/Two", "float64 a\nfloat64 b\n")
    process = FakeProcess(kind)
    process.model.set(Settings(path="b"))
    process.commands.clear()
    process.model.process_began()
    assert process.commands == [("type", {"name": "demo/Two", "text": kind.text}), ("plot", {"path": "b"})]


def test_a_click_publishes_the_values_of_the_form() -> None:
    """A click sends the values, the latch setting and the queue size to the topic process."""
    process = FakeProcess()
    process.commands.clear()
    for action in ("publish", "burst", "repeat"):
        process.model.act(action, {"data": "-1.5"}, Settings(rate="20", queue="3", latch=True, path="data"))
    how = {"texts": {"data": "-1.5"}, "latch": True, "queue": 3}
    assert process.commands == [
        ("publish", {**how, "count": 1}),
        ("publish", {**how, "count": BURST}),
        ("repeat", {**how, "rate": 20.0}),
    ]
    assert process.state["check"]["once"] == "rostopic pub /speed std_msgs/Float64 -- -1.5"
    assert process.state["check"]["often"] == "rostopic pub -r 20 --latch /speed std_msgs/Float64 -- -1.5"
    assert "queue_size=3, latch=True" in process.state["check"]["python"]


@pytest.mark.parametrize(
    ("settings", "draft", "wrong"),
    [
        (Settings(rate="0.05"), {}, "@rate"),
        (Settings(rate="101"), {}, "@rate"),
        (Settings(rate="nan"), {}, "@rate"),
        (Settings(queue="-1"), {}, "@queue"),
        (Settings(queue="1.5"), {}, "@queue"),
        (Settings(queue=""), {}, "@queue"),
        (Settings(), {"data": "fast"}, "data"),
    ],
)
def test_nothing_is_published_while_something_is_wrong(
    settings: Settings, draft: dict[str, str], wrong: str
) -> None:
    """While a field is wrong, a click publishes nothing, and the page shows the mistake at the field."""
    process = FakeProcess()
    process.commands.clear()
    process.model.act("repeat", draft, settings)
    assert list(process.state["check"]["errors"]) == [wrong]
    assert "Give" in process.state["check"]["errors"][wrong]
    assert process.state["check"]["refused"] == 1
    assert not [do for do, _ in process.commands if do != "plot"]


def test_a_wrong_rate_does_not_prevent_a_single_message() -> None:
    """A wrong rate does not prevent the publication of a single message."""
    process = FakeProcess()
    process.model.act("publish", {"data": "1"}, Settings(rate="often", path="data"))
    assert process.commands[-1][0] == "publish"


def test_messages_are_listed_the_latest_first_and_bounded() -> None:
    """The panel lists the latest ten messages, with the newest message first."""
    process = FakeProcess()
    process.model.report({"messages": [message(number, f"{number}.5") for number in range(1, 31)]})
    messages = process.state["messages"]
    assert [each["number"] for each in messages] == list(range(30, 20, -1))
    assert messages[0]["line"] == "data 30.5"
    assert process.state["latest"] == [{"depth": 0, "name": "data", "type": "float64", "text": "30.5"}]


def test_messages_that_cannot_be_read_are_named() -> None:
    """If the panel cannot read a message, the list contains the message with a note."""
    process = FakeProcess()
    process.model.report(
        {"messages": [message(1, "", STRING, texts=None), message(2, "", texts=None, size=1_000_000)]}
    )
    lines = [each["line"] for each in process.state["messages"]]
    assert lines == ["1,000,000 bytes, too long to be shown here", "another type: std_msgs/String, 8 bytes"]
    assert [each["understood"] for each in process.state["messages"]] == [False, False]


def test_a_message_without_fields_is_a_message() -> None:
    """The panel lists a message without fields, and shows no plot."""
    empty = message_type("std_msgs/Empty")
    process = FakeProcess(empty)
    assert process.state["about"]["numbers"] == []
    assert process.state["check"]["once"] == "rostopic pub --once /speed std_msgs/Empty"
    process.model.report({"messages": [message(1, "", empty, texts={})]})
    assert process.state["messages"][0]["line"] == "no fields"


def test_reports_come_in_parts() -> None:
    """If a report contains only some values, the panel does not change the other values."""
    process = FakeProcess()
    process.model.report({"count": 3, "trouble": "No master."})
    process.model.report({"statistics": {"rate": 10.0}})
    assert process.state["subscription"] == {"count": 3, "statistics": {"rate": 10.0}}
    assert process.state["trouble"] == "No master."
    process.model.report({"curve": {"points": [[0.1, 2.0]], "count": 1, "left_out": 0}})
    assert json.loads(process.state["curve"])["points"] == [[0.1, 2.0]]


PUBLISHER: PublisherReport = {
    "problem": "",
    "rate": 0,
    "skipped": 0,
    "statistics": {},
    "advertised": True,
    "latch": False,
    "queue": 10,
    "published": 3,
    "unheard": 1,
    "sent": 2,
    "dropped": 0,
    "reached": 2,
    "deliveries": [
        {"peer": "/panel", "sent": 2, "waiting": 0, "dropped": 0},
        {"peer": "/listener", "sent": 2, "waiting": 0, "dropped": 0},
    ],
}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"published": 0}, "Nothing is published yet. The first message creates the publisher."),
        ({}, "Message 3 was sent to this panel and /listener."),
        ({"reached": 1}, "Message 3 was sent to 1 subscriber."),
        (
            {"reached": 0},
            "Message 3 reached no subscriber, because no subscriber was connected at that time.",
        ),
        (
            {"reached": 0, "latch": True, "deliveries": []},
            "Message 3 has reached no subscriber yet. The message is latched, so the next subscriber gets "
            "it.",
        ),
        (
            {"reached": 0, "latch": True, "deliveries": PUBLISHER["deliveries"][:1]},
            "Message 3 was stored until the first connection, and was then sent to this panel.",
        ),
        ({"advertised": False}, "The publisher was unregistered. The next message creates a new publisher."),
        ({"rate": 10.0, "statistics": {"rate": 9.987}}, "Publishing at 10 Hz (measured: 9.987 Hz)."),
        (
            {"rate": 10.0, "statistics": {}, "skipped": 2},
            "Publishing at 10 Hz. 2 messages could not be sent in time.",
        ),
    ],
)
def test_the_sentence_about_a_message(change: PublisherReport, words: str) -> None:
    """published() returns a sentence that says what happened to the published message."""
    assert published({**PUBLISHER, **change}, "/panel") == words


def seen(publisher: str = "", subscriber: str = "", md5: str = "") -> Connections:
    """Return the connections of a topic with at most one publisher and one subscriber.

    `publisher` and `subscriber` are the types of the two nodes. If a type is "", this node does not exist. If
    `md5` is not empty, the panel is connected to the publisher, and the publisher's type has this MD5 sum.
    """
    sources = [{"node": "/talker", "type": publisher, "md5": md5}] if md5 else []
    publishers = [{"node": "/talker", "type": publisher}] if publisher else []
    subscribers = [{"node": "/listener", "type": subscriber}] if subscriber else []
    return {"publishers": publishers, "subscribers": subscribers, "sources": sources}


def test_different_types_are_reported_for_each_node() -> None:
    """For each node with another type, there is a warning with the name of the node and the MD5 sums."""
    said = mismatches(FLOAT, seen("std_msgs/String", "std_msgs/UInt32"), "/panel", message_type)
    assert [words.split()[0] for words in said] == ["/talker", "/listener"]
    assert f"std_msgs/String (MD5 {STRING.md5[:8]}…)" in said[0]
    assert f"std_msgs/Float64 (MD5 {FLOAT.md5[:8]}…)" in said[0]
    assert "no error message" in said[1]


@pytest.mark.parametrize(
    "seen",
    [
        seen("std_msgs/Float64", "std_msgs/Float64"),
        seen("std_msgs/Float64", "*", FLOAT.md5),
        seen("", ""),
        seen("std_msgs/Float64", "their_pkg/Other") | {"subscribers": [{"node": "/panel", "type": "x/Y"}]},
    ],
)
def test_equal_types_cause_no_warning(seen: Connections) -> None:
    """A node that accepts any type, or that does not respond, causes no warning."""
    assert mismatches(FLOAT, seen, "/panel", message_type) == []


def test_one_name_with_two_definitions_is_a_mismatch() -> None:
    """If a publisher has reported an MD5 sum, the panel compares the MD5 sums."""
    said = mismatches(FLOAT, seen("std_msgs/Float64", md5="0" * 32), "/panel", message_type)
    assert "std_msgs/Float64 (MD5 00000000…)" in said[0]


def test_a_type_that_is_unknown_here_is_a_mismatch_by_name() -> None:
    """If the MD5 sum is unknown, the panel compares the names of the types."""
    said = mismatches(FLOAT, seen(subscriber="their_pkg/Other"), "/panel", message_type)
    assert "subscribes to their_pkg/Other, but this panel" in said[0]
