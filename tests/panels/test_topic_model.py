"""What a topic panel knows, with a station of paper."""

from __future__ import annotations

import json
from typing import Any

import pytest

from course_pkg.errors import NotATopic
from course_pkg.interfaces import MessageType, compile_message, message_type
from course_pkg.panels.topic.model import BURST, TopicModel
from course_pkg.panels.topic.settings import Settings
from course_pkg.panels.topic.words import mismatches, published

FLOAT = message_type("std_msgs/Float64")
STRING = message_type("std_msgs/String")
EMPTY: dict[str, Any] = {"type": "", "publishers": [], "subscribers": [], "sources": []}


class Desk:
    """A model, what it said, and what it told its station."""

    def __init__(self, kind: MessageType | None = FLOAT, topic: str = "/speed") -> None:
        self.state: dict[str, Any] = {}
        self.told: list[tuple[str, dict[str, Any]]] = []
        self.model = TopicModel(topic, kind, lambda **parts: self.state.update(parts), self._tell)

    def _tell(self, do: str, **what: Any) -> None:  # noqa: ANN401 - plain data
        self.told.append((do, what))


def heard(number: int, data: str, kind: MessageType = FLOAT, **other: Any) -> dict[str, Any]:  # noqa: ANN401
    """Make a message as a station reports it."""
    about = {"number": number, "ago": 0.1, "peer": "/talker", "size": 8, "type": kind.name, "md5": kind.md5}
    return {**about, "texts": {"data": data}, **other}


def test_a_form_and_its_commands_are_there_at_once() -> None:
    """Fields, numbers and lines need neither a graph nor a station."""
    state = Desk().state
    assert [field["name"] for field in state["about"]["message"]["fields"]] == ["data"]
    assert state["about"]["numbers"] == ["data"]
    assert state["about"]["listen"] == ["rostopic echo /speed", "rostopic hz /speed", "rostopic info /speed"]
    assert state["check"]["once"] == "rostopic pub --once /speed std_msgs/Float64 0.0"
    assert state["settings"]["path"] == "data"


@pytest.mark.parametrize("name", ["speed", "/", "/a//b", "/my speed", "~speed", "/1", "/a\nb", ""])
def test_what_is_no_name_is_refused(name: str) -> None:
    """A name with a slip would be another topic, and nobody would say so."""
    with pytest.raises(NotATopic, match="Give a full name"):
        Desk(topic=name)


def test_a_topic_without_a_type_waits_for_one() -> None:
    """The panel takes the type of the publisher, and not that which a subscriber has told the master."""
    desk = Desk(None)
    assert "Nobody publishes /speed yet" in desk.state["about"]["problem"]
    desk.model.see({**EMPTY, "subscribers": [{"node": "/listener", "type": "*"}]})
    assert "message" not in desk.state["about"]
    talker = {"node": "/talker", "type": "std_msgs/String"}
    desk.model.see({**EMPTY, "type": "std_msgs/Float64", "publishers": [talker]})
    assert desk.state["about"]["message"]["name"] == "std_msgs/String"
    assert desk.told == [("type", {"name": "std_msgs/String", "text": ""}), ("plot", {"path": ""})]


def test_the_first_message_tells_the_type() -> None:
    """A latched message may come before anybody has looked around, and is read all the same."""
    desk = Desk(None)
    desk.model.report({"echo": [heard(1, "2.5")]})
    assert desk.state["echo"][0]["line"] == "data 2.5"
    assert desk.state["about"]["message"]["name"] == "std_msgs/Float64"


def test_a_type_that_is_not_known_here_is_said() -> None:
    """Somebody publishes what this machine has no definition of."""
    desk = Desk(None)
    desk.model.see({**EMPTY, "publishers": [{"node": "/talker", "type": "their_pkg/Thing"}]})
    assert "their_pkg/Thing" in desk.state["about"]["problem"]


def test_a_new_station_is_told_the_type_and_the_path() -> None:
    """What the page had chosen holds for the next station, too; a type from a notebook brings its text."""
    kind = compile_message("demo/Two", "float64 a\nfloat64 b\n")
    desk = Desk(kind)
    desk.model.set(Settings(path="b"))
    desk.told.clear()
    desk.model.station_began()
    assert desk.told == [("type", {"name": "demo/Two", "text": kind.text}), ("plot", {"path": "b"})]


def test_a_click_publishes_what_stands_in_the_form() -> None:
    """Texts, latch and queue go to the station; a burst says how many, a repetition how often."""
    desk = Desk()
    desk.told.clear()
    for action in ("publish", "burst", "repeat"):
        desk.model.act(action, {"data": "-1.5"}, Settings(rate="20", queue="3", latch=True, path="data"))
    how = {"texts": {"data": "-1.5"}, "latch": True, "queue": 3}
    assert desk.told == [
        ("publish", {**how, "count": 1}),
        ("publish", {**how, "count": BURST}),
        ("repeat", {**how, "rate": 20.0}),
    ]
    assert desk.state["check"]["once"] == "rostopic pub /speed std_msgs/Float64 -- -1.5"
    assert desk.state["check"]["often"] == "rostopic pub -r 20 --latch /speed std_msgs/Float64 -- -1.5"
    assert "queue_size=3, latch=True" in desk.state["check"]["python"]


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
    """Each mistake is said at its field, and the page hears that the click was refused."""
    desk = Desk()
    desk.told.clear()
    desk.model.act("repeat", draft, settings)
    assert list(desk.state["check"]["errors"]) == [wrong]
    assert "Give" in desk.state["check"]["errors"][wrong]
    assert desk.state["check"]["refused"] == 1
    assert not [do for do, _ in desk.told if do != "plot"]


def test_a_wrong_rate_does_not_keep_one_from_publishing_once() -> None:
    """Only what the click needs has to be right."""
    desk = Desk()
    desk.model.act("publish", {"data": "1"}, Settings(rate="often", path="data"))
    assert desk.told[-1][0] == "publish"


def test_messages_are_listed_the_latest_first_and_bounded() -> None:
    """Ten of them, each in a line; the latest in full."""
    desk = Desk()
    desk.model.report({"echo": [heard(number, f"{number}.5") for number in range(1, 31)]})
    echo = desk.state["echo"]
    assert [each["number"] for each in echo] == list(range(30, 20, -1))
    assert echo[0]["line"] == "data 30.5"
    assert desk.state["latest"] == [{"depth": 0, "name": "data", "type": "float64", "text": "30.5"}]


def test_messages_that_cannot_be_read_are_named() -> None:
    """Another type, and a message too long to be shown."""
    desk = Desk()
    desk.model.report({"echo": [heard(1, "", STRING, texts=None), heard(2, "", texts=None, size=1_000_000)]})
    lines = [each["line"] for each in desk.state["echo"]]
    assert lines == ["1,000,000 bytes, too long to be shown here", "another type: std_msgs/String, 8 bytes"]
    assert [each["understood"] for each in desk.state["echo"]] == [False, False]


def test_a_message_without_fields_is_a_message() -> None:
    """That it came is all there is to show; there is nothing to draw."""
    empty = message_type("std_msgs/Empty")
    desk = Desk(empty)
    assert desk.state["about"]["numbers"] == []
    assert desk.state["check"]["once"] == "rostopic pub --once /speed std_msgs/Empty"
    desk.model.report({"echo": [heard(1, "", empty, texts={})]})
    assert desk.state["echo"][0]["line"] == "no fields"


def test_reports_come_in_parts() -> None:
    """What a report does not name stays as it was."""
    desk = Desk()
    desk.model.report({"count": 3, "trouble": "No master."})
    desk.model.report({"pace": {"rate": 10.0}})
    assert desk.state["heard"] == {"count": 3, "pace": {"rate": 10.0}}
    assert desk.state["trouble"] == "No master."
    desk.model.report({"curve": {"points": [[0.1, 2.0]], "count": 1, "left_out": 0}})
    assert json.loads(desk.state["curve"])["points"] == [[0.1, 2.0]]


SPOKEN: dict[str, Any] = {
    "problem": "",
    "rate": 0,
    "skipped": 0,
    "pace": {},
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
        ({"published": 0}, "Nothing is published yet. The first message makes the publisher."),
        ({}, "Message 3 went to this panel and /listener."),
        ({"reached": 1}, "Message 3 went to 1 subscriber."),
        (
            {"reached": 0},
            "Message 3 went to nobody: no subscriber was connected when it was published.",
        ),
        (
            {"reached": 0, "latch": True, "deliveries": []},
            "Message 3 went to nobody yet. Latched, it is kept for the next subscriber that connects.",
        ),
        (
            {"reached": 0, "latch": True, "deliveries": SPOKEN["deliveries"][:1]},
            "Message 3 was kept, and went to this panel as soon as it was connected.",
        ),
        ({"advertised": False}, "The publisher is withdrawn. The next message makes a new one."),
        ({"rate": 10.0, "pace": {"rate": 9.987}}, "Publishing at 10 Hz, really 9.987 Hz."),
        (
            {"rate": 10.0, "pace": {}, "skipped": 2},
            "Publishing at 10 Hz. 2 messages had to be left out.",
        ),
    ],
)
def test_what_became_of_a_message_in_words(change: dict[str, Any], words: str) -> None:
    """Only what was counted is said."""
    assert published({**SPOKEN, **change}, "/panel") == words


def around(publisher: str = "", subscriber: str = "", md5: str = "") -> dict[str, Any]:
    """Make a neighbourhood of at most two nodes, of which the publisher is connected if it has an MD5."""
    sources = [{"node": "/talker", "type": publisher, "md5": md5}] if md5 else []
    publishers = [{"node": "/talker", "type": publisher}] if publisher else []
    subscribers = [{"node": "/listener", "type": subscriber}] if subscriber else []
    return {"publishers": publishers, "subscribers": subscribers, "sources": sources}


def test_types_that_differ_are_said_for_each_node() -> None:
    """The names and the MD5s of both, and who hears nothing."""
    said = mismatches(FLOAT, around("std_msgs/String", "std_msgs/UInt32"), "/panel", message_type)
    assert [words.split()[0] for words in said] == ["/talker", "/listener"]
    assert f"std_msgs/String (MD5 {STRING.md5[:8]}…)" in said[0]
    assert f"std_msgs/Float64 (MD5 {FLOAT.md5[:8]}…)" in said[0]
    assert "is not told" in said[1]


@pytest.mark.parametrize(
    "seen",
    [
        around("std_msgs/Float64", "std_msgs/Float64"),
        around("std_msgs/Float64", "*", FLOAT.md5),
        around("", ""),
        around("std_msgs/Float64", "their_pkg/Other") | {"subscribers": [{"node": "/panel", "type": "x/Y"}]},
    ],
)
def test_types_that_agree_need_no_words(seen: dict[str, Any]) -> None:
    """Neither do nodes that take any type, do not answer, or are the panel itself."""
    assert mismatches(FLOAT, seen, "/panel", message_type) == []


def test_one_name_with_two_definitions_is_a_mismatch() -> None:
    """The MD5 decides, where a publisher is connected and has told it."""
    said = mismatches(FLOAT, around("std_msgs/Float64", md5="0" * 32), "/panel", message_type)
    assert "std_msgs/Float64 (MD5 00000000…)" in said[0]


def test_a_type_that_is_unknown_here_is_a_mismatch_by_name() -> None:
    """Its MD5 cannot be told."""
    said = mismatches(FLOAT, around(subscriber="their_pkg/Other"), "/panel", message_type)
    assert "subscribes to their_pkg/Other, this panel" in said[0]
