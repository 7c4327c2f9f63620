"""Tests of topic rates and service callers on the graph."""

from __future__ import annotations

import random

import pytest

from course_pkg.panels.graph.activity import LONG, SHOWN, RateMeter, Rates, plainest, rate_text
from course_pkg.panels.graph.model import GraphModel
from course_pkg.ros import Activity, NodeSeen, ServiceCaller, ServiceSeen, Snapshot, TopicSeen, Traffic
from course_pkg.types import Plain

TOPICS = (
    TopicSeen("/chatter", "std_msgs/String", ("/talker",), ("/listener",)),
    TopicSeen("/unheard", "std_msgs/String", ("/talker",), ()),
    TopicSeen("/unsaid", "std_msgs/String", (), ("/listener",)),
)
SERVICES = (
    ServiceSeen("/robot/ask", "std_srvs/Trigger", "/server", "rosrpc://localhost:1", "answered"),
    ServiceSeen("/robot/tell", "std_srvs/Trigger", "/server", "rosrpc://localhost:1", "answered"),
)


def graph(*, dead: str = "", topics: tuple[TopicSeen, ...] = TOPICS) -> Snapshot:
    """Return a snapshot of a graph with four nodes.

    If the name of a dead node is given, this node is registered, but its process does not run.
    """
    names = ("/client", "/listener", "/server", "/talker")
    nodes = tuple(
        NodeSeen(name, "http://localhost:1/", "refused" if name == dead else "answered") for name in names
    )
    return Snapshot("http://localhost:11311", nodes, topics, SERVICES)


class Wall:
    """Stores the messages that the model of a graph panel sends."""

    def __init__(self, snapshot: Snapshot | None = None) -> None:
        self.said: list[dict[str, Plain]] = []
        self.drawn = 0
        self.model = GraphModel(self.hear)
        self.model.see(snapshot or graph())

    def hear(self, **parts: Plain) -> None:
        """Store the state."""
        self.said.append(parts)
        self.drawn += "drawing" in parts

    @property
    def now(self) -> dict[str, Plain]:
        """Return the latest activity (rates and callers) that the model has sent."""
        return next(each for each in reversed(self.said) if "activity" in each)["activity"]


def counts(*messages: int, every: float = 2.0) -> list[Activity]:
    """Return one Activity object for each of the given message counts of the topic /chatter.

    The time between two consecutive Activity objects is constant, with a default of 2 s.
    """
    return [
        Activity(turn * every, (Traffic("/chatter", "/talker", "/listener", 7, count),))
        for turn, count in enumerate(messages)
    ]


def test_a_rate_is_shown_for_its_topic_and_for_each_connection() -> None:
    """The topic's rate is shown below its name, and the details contain the rate of each connection."""
    wall = Wall()
    for activity in counts(100, 120, 140):
        wall.model.count(activity)
    assert wall.now["notes"]["topic /chatter"] == "10 Hz"
    assert wall.now["details"]["topic /chatter"] == [["/talker → /listener", "10 Hz"]]


def test_a_topic_without_publisher_or_subscriber_has_no_rate() -> None:
    """Without a publisher or a subscriber, the topic has no rate."""
    wall = Wall()
    wall.model.count(Activity(0.0))
    assert wall.now["notes"]["topic /unheard"] == "not received"
    assert wall.now["details"]["topic /unheard"] == [["rate", "no subscriber, so nothing is sent"]]
    assert wall.now["notes"]["topic /unsaid"] == "no publisher"


def test_before_the_second_count_there_is_no_rate() -> None:
    """After the first count, the details contain the number of messages, but no rate."""
    wall = Wall()
    wall.model.count(counts(1)[0])
    assert wall.now["notes"]["topic /chatter"] == ""
    assert wall.now["details"]["topic /chatter"] == [["/talker → /listener", "1 message since it connected"]]


def test_a_topic_without_new_messages_has_a_rate_of_zero() -> None:
    """If the number of messages does not change, the details contain 0 Hz."""
    wall = Wall()
    for activity in counts(3, 3, 3):
        wall.model.count(activity)
    assert wall.now["details"]["topic /chatter"] == [
        ["/talker → /listener", "0 Hz, 3 messages since it connected"]
    ]


def test_nodes_that_are_not_connected() -> None:
    """If a publisher and a subscriber have different types, the details say that the types differ."""
    wall = Wall()
    wall.model.count(Activity(0.0))
    assert wall.now["notes"]["topic /chatter"] == "unconnected"
    assert "same type" in wall.now["details"]["topic /chatter"][0][1]


def test_a_publisher_that_does_not_report_counts() -> None:
    """If a publisher does not report its message counts, the panel shows no rate and no error."""
    wall = Wall()
    wall.model.count(Activity(0.0, silent=frozenset({"/talker"})))
    assert wall.now["notes"]["topic /chatter"] == "not counted"
    assert wall.now["details"]["topic /chatter"][0][1] == "the publisher does not report its message counts"


def test_several_publishers_add_up_and_several_listeners_do_not() -> None:
    """A topic's rate is the sum of the rates of its publishers."""
    topic = TopicSeen("/chatter", "std_msgs/String", ("/talker", "/server"), ("/listener", "/client"))
    wall = Wall(graph(topics=(topic,)))
    for turn in range(3):
        ends = [(who, whom) for who in topic.publishers for whom in topic.subscribers]
        carried = tuple(Traffic("/chatter", *each, 1, 20 * turn) for each in ends)
        wall.model.count(Activity(2.0 * turn, carried))
    assert wall.now["notes"]["topic /chatter"] == "20 Hz"


def test_counts_never_draw_again_and_are_sent_only_if_they_change() -> None:
    """If the rates do not change, the panel's model sends no message to the page."""
    wall = Wall()
    for activity in counts(*range(0, 800, 20)):
        wall.model.count(activity)
    assert wall.drawn == 1
    assert len(wall.said) < 5


def test_notes_fit_below_the_name_of_a_topic() -> None:
    """The text below a topic's name has at most 12 characters."""
    wall = Wall()
    for activity in [*counts(0, 20, 40), Activity(6.0), Activity(8.0, silent=frozenset({"/talker"}))]:
        wall.model.count(activity)
    notes = {note for each in wall.said for note in each["activity"]["notes"].values()}
    assert {"10 Hz", "unconnected", "not counted", "not received", "no publisher"} <= notes
    assert max(map(len, notes)) <= 12


def test_many_connections_are_shortened() -> None:
    """If a topic has a hundred connections, the details end with the row "89 more connections"."""
    listeners = tuple(f"/listener_{number}" for number in range(100))
    wall = Wall(graph(topics=(TopicSeen("/chatter", "a/B", ("/talker",), listeners),)))
    wall.model.count(Activity(0.0))
    details = wall.now["details"]["topic /chatter"]
    assert len(details) == SHOWN
    assert details[-1] == ["…", "89 more connections"]


CALLERS = {
    "/robot/ask": (ServiceCaller("/client", 12, 1000.04, 0), ServiceCaller("/gone_1", 1, 990.0, 0)),
    "/robot/tell": (),
}


def test_callers_are_listed_and_ended_callers_are_marked() -> None:
    """The latest caller is first in the list of callers, and the list marks callers that have ended."""
    wall = Wall()
    wall.model.count(Activity(0.0, callers=CALLERS))
    assert wall.now["callers"]["service /robot/ask"] == [
        {"node": "/client", "calls": 12, "last": 1000.0, "running": 0, "gone": False},
        {"node": "/gone_1", "calls": 1, "last": 990.0, "running": 0, "gone": True},
    ]
    assert wall.now["callers"]["service /robot/tell"] == []
    assert wall.now["calls"] == [
        {"tail": "node /client", "head": "service /robot/ask", "last": 1000.0, "running": 0}
    ]


def test_a_killed_caller_is_gone() -> None:
    """If the process of a caller was killed, the panel marks this caller as gone."""
    wall = Wall(graph(dead="/client"))
    wall.model.count(Activity(0.0, callers=CALLERS))
    assert [each["gone"] for each in wall.now["callers"]["service /robot/ask"]] == [True, True]
    assert wall.now["calls"] == []


def test_a_server_that_does_not_report_callers_is_left_out() -> None:
    """If a server does not report its callers, the server's service is not in the list of callers."""
    wall = Wall()
    wall.model.count(Activity(0.0, callers={"/robot/tell": ()}))
    assert set(wall.now["callers"]) == {"service /robot/tell"}


def test_the_line_of_a_call_leads_to_the_folded_box_of_its_service() -> None:
    """A folded namespace has one line for the calls of all its services."""
    wall = Wall()
    later = {**CALLERS, "/robot/tell": (ServiceCaller("/client", 1, 2000.0, 1),)}
    wall.model.count(Activity(0.0, callers=later))
    assert [each["head"] for each in wall.now["calls"]] == ["service /robot/ask", "service /robot/tell"]
    wall.model.fold("/robot/", fold=True)
    assert wall.now["calls"] == [
        {"tail": "node /client", "head": "namespace /robot/", "last": 2000.0, "running": 1}
    ]


def test_a_hidden_caller_is_not_gone() -> None:
    """If the kernel's own node is hidden, the panel still lists the calls of this node."""
    said: list[dict[str, Plain]] = []
    model = GraphModel(lambda **parts: said.append(parts), own="/client")
    model.see(graph())
    model.choose(noise=False, show_own=False)
    model.count(Activity(0.0, callers=CALLERS))
    assert not said[-1]["activity"]["callers"]["service /robot/ask"][0]["gone"]


def test_the_details_contain_the_fields_of_a_type() -> None:
    """The details of a topic or a service contain the fields of its type."""
    wall = Wall()
    facts = {each["key"]: dict(each["facts"]) for each in wall.said[-1]["facts"]}
    assert facts["topic /chatter"]["fields"] == "string data"
    assert (facts["service /robot/ask"]["request"], facts["service /robot/ask"]["response"]) == (
        "none",
        "bool success, string message",
    )
    assert facts["node /talker"]["publishes"] == "/chatter, /unheard"


@pytest.mark.parametrize("kind", ["nowhere/Thing", "nonsense", ""])
def test_a_type_that_is_not_here(kind: str) -> None:
    """If the type of a topic is unknown, the topic's details cause no error."""
    wall = Wall(graph(topics=(TopicSeen("/t", kind, ("/talker",), ()),)))
    facts = dict(next(each for each in wall.said[-1]["facts"] if each["key"] == "topic /t")["facts"])
    assert facts.get("fields", "").startswith("nowhere/Thing: no message type" if "/" in kind else "")


def test_a_still_picture_contains_its_colours_rates_and_texts() -> None:
    """A saved picture contains its style sheet, the rates and the text of the graph, but no buttons."""
    wall = Wall()
    for activity in counts(100, 120, 140):
        wall.model.count(activity)
    drawn = wall.model.still()
    assert ">10 Hz<" in drawn
    assert "@media print" in drawn
    assert 'role="img"' in drawn
    assert 'aria-label="The ROS graph: 4 nodes, 3 topics, 2 services"' in drawn
    assert "/talker\n  publishes  /chatter  (std_msgs/String)" in drawn
    assert "tabindex" not in drawn


def counted(rate: float, seconds: float, *, late: float = 0.0, seed: int = 1) -> RateMeter:
    """Return a rate meter that has read the message count of a steady publisher every 2 s.

    Each reading happens up to `late` s after its planned time.
    """
    meter, chance = RateMeter(), random.Random(seed)  # noqa: S311 - a test's own dice
    for turn in range(int(seconds / 2) + 1):
        meter.read(2.0 * turn + chance.uniform(0, late), int(rate * 2 * turn))
    return meter


@pytest.mark.parametrize("rate", [0.2, 0.5, 1, 5, 10, 15, 62, 100, 1000])
def test_a_steady_rate_is_found_and_does_not_change(rate: float) -> None:
    """After 30 s, the meter's rate is the rate of the publisher, and does not change."""
    seen = {counted(rate, seconds, late=0.03).rate for seconds in range(34, 60, 2)}
    assert len(seen) == 1
    assert seen.pop() == pytest.approx(rate, rel=0.06 if rate > 1 else 0.2)


def test_two_counts_are_enough_for_a_first_number() -> None:
    """The panel shows a rate after two counts."""
    assert counted(10, 0).rate is None
    assert counted(10, 2).rate == pytest.approx(10, abs=1)


def test_the_end_of_messages_and_a_new_rate_are_noticed_soon() -> None:
    """If the publisher stops or changes its rate, the panel soon shows the new rate."""
    meter = counted(10, 30)
    for at in (32.0, 34.0, 36.0):
        meter.read(at, 300)
    assert meter.rate == 0
    for turn in range(1, 4):
        meter.read(36.0 + 2 * turn, 300 + 80 * turn)
    assert meter.rate == pytest.approx(40, rel=0.05)


def test_a_restarted_publisher_is_counted_from_its_start() -> None:
    """If a count decreases, the meter ignores all earlier counts."""
    meter = counted(10, 30)
    meter.read(32.0, 4)
    assert meter.rate is not None
    assert meter.rate >= 0
    meter.read(34.0, 24)
    assert meter.rate == pytest.approx(10, abs=1)


def test_the_memory_is_bounded() -> None:
    """The meter deletes counts that are older than 30 s."""
    meter = counted(10, 600)
    assert len(meter._counts) <= LONG / 2 + 1


@pytest.mark.parametrize(
    ("rate", "doubt", "shown"),
    [
        (9.75, 0.25, 10),
        (10.25, 0.25, 10),
        (12.3, 0.05, 12.3),
        (12.3, 0.5, 12),
        (0.033, 0.03, 0.03),
        (0, 1, 0),
    ],
)
def test_no_more_digits_than_the_counts_can_tell(rate: float, doubt: float, shown: float) -> None:
    """plainest() rounds a rate to as few digits as its uncertainty allows."""
    assert plainest(rate, doubt) == pytest.approx(shown)


@pytest.mark.parametrize(
    ("rate", "shown"),
    [
        (0, "0 Hz"),
        (0.03, "< 0.1 Hz"),
        (0.5, "0.5 Hz"),
        (10.0, "10 Hz"),
        (999.7, "1 kHz"),
        (12300, "12.3 kHz"),
    ],
)
def test_a_rate_as_text(rate: float, shown: str) -> None:
    """The text of a rate has a unit, and at most 12 characters."""
    assert rate_text(rate) == shown
    assert len(shown) <= 12


def test_a_connection_that_has_ended_has_no_rate() -> None:
    """A topic without a connection has no rate."""
    rates, carried = Rates(), Traffic("/t", "/a", "/b", 1, 10)
    rates.read(Activity(0.0, (carried,)))
    rates.read(Activity(2.0, (Traffic("/t", "/a", "/b", 1, 30),)))
    assert rates.of(carried) == pytest.approx(10, abs=1)
    rates.read(Activity(4.0))
    assert rates.of(carried) is None
