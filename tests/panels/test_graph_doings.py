"""What happens on the graph, in words: rates of topics, callers of services, and never a made-up number."""

from __future__ import annotations

from typing import Any

import pytest

from course_pkg.graph import Activity, Carried, NodeSeen, ServiceCaller, ServiceSeen, Snapshot, TopicSeen
from course_pkg.panels.graph.doings import SHOWN
from course_pkg.panels.graph.model import GraphModel

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
    """Make a snapshot in which one node may be dead."""
    names = ("/client", "/listener", "/server", "/talker")
    nodes = tuple(
        NodeSeen(name, "http://localhost:1/", "refused" if name == dead else "answered") for name in names
    )
    return Snapshot("http://localhost:11311", nodes, topics, SERVICES)


class Wall:
    """A model that sees a graph, and what it says."""

    def __init__(self, snapshot: Snapshot | None = None) -> None:
        self.said: list[dict[str, Any]] = []
        self.drawn = 0
        self.model = GraphModel(self.hear)
        self.model.see(snapshot or graph())

    def hear(self, **parts: Any) -> None:  # noqa: ANN401 - traits
        """Take note."""
        self.said.append(parts)
        self.drawn += "drawing" in parts

    @property
    def now(self) -> dict[str, Any]:
        """What the page shows now."""
        latest: dict[str, Any] = next(each for each in reversed(self.said) if "activity" in each)["activity"]
        return latest


def counts(*messages: int, every: float = 2.0, **options: Any) -> list[Activity]:  # noqa: ANN401 - passed on
    """Make what is counted of /chatter at one time after the other."""
    return [
        Activity(turn * every, (Carried("/chatter", "/talker", "/listener", 7, count),), **options)
        for turn, count in enumerate(messages)
    ]


def test_a_rate_is_told_at_its_topic_and_by_connection() -> None:
    """The note stands below the name, the details say who sends to whom."""
    wall = Wall()
    for activity in counts(100, 120, 140):
        wall.model.hear(activity)
    assert wall.now["notes"]["topic /chatter"] == "10 Hz"
    assert wall.now["details"]["topic /chatter"] == [["/talker → /listener", "10 Hz"]]


def test_nobody_listens_and_nobody_speaks() -> None:
    """Without one of the two ends there is no rate, and the reason is said."""
    wall = Wall()
    wall.model.hear(Activity(0.0))
    assert wall.now["notes"]["topic /unheard"] == "no listener"
    assert wall.now["details"]["topic /unheard"] == [["rate", "no listener, nothing is sent"]]
    assert wall.now["notes"]["topic /unsaid"] == "no publisher"


def test_before_the_second_count_there_is_no_rate() -> None:
    """One count says how many messages there were, and nothing about how often."""
    wall = Wall()
    wall.model.hear(counts(1)[0])
    assert wall.now["notes"]["topic /chatter"] == ""
    assert wall.now["details"]["topic /chatter"] == [["/talker → /listener", "1 message since it connected"]]


def test_silence_is_told_with_what_was_sent() -> None:
    """A topic on which nothing comes is at 0 Hz."""
    wall = Wall()
    for activity in counts(3, 3, 3):
        wall.model.hear(activity)
    assert wall.now["details"]["topic /chatter"] == [
        ["/talker → /listener", "0 Hz, 3 messages since it connected"]
    ]


def test_ends_that_are_not_connected() -> None:
    """A publisher and a subscriber of different types never connect: that is said, as what it may be."""
    wall = Wall()
    wall.model.hear(Activity(0.0))
    assert wall.now["notes"]["topic /chatter"] == "unconnected"
    assert "same type?" in wall.now["details"]["topic /chatter"][0][1]


def test_a_publisher_that_does_not_tell() -> None:
    """A node that does not count has no rate, and is not taken for silent."""
    wall = Wall()
    wall.model.hear(Activity(0.0, mute=frozenset({"/talker"})))
    assert wall.now["notes"]["topic /chatter"] == "not counted"
    assert wall.now["details"]["topic /chatter"][0][1] == "its publisher does not tell what it sends"


def test_several_publishers_add_up_and_several_listeners_do_not() -> None:
    """A topic's rate is what the listener hears who hears most."""
    topic = TopicSeen("/chatter", "std_msgs/String", ("/talker", "/server"), ("/listener", "/client"))
    wall = Wall(graph(topics=(topic,)))
    for turn in range(3):
        ends = [(who, whom) for who in topic.publishers for whom in topic.subscribers]
        carried = tuple(Carried("/chatter", *each, 1, 20 * turn) for each in ends)
        wall.model.hear(Activity(2.0 * turn, carried))
    assert wall.now["notes"]["topic /chatter"] == "20 Hz"


def test_numbers_never_draw_anew_and_are_told_only_when_they_change() -> None:
    """A steady graph says nothing more after its rates are known, however long it runs."""
    wall = Wall()
    for activity in counts(*range(0, 800, 20)):
        wall.model.hear(activity)
    assert wall.drawn == 1
    assert len(wall.said) < 5


def test_notes_are_short_enough_for_their_place() -> None:
    """Whatever stands below the name of a topic is at most 12 letters."""
    wall = Wall()
    for activity in [*counts(0, 20, 40), Activity(6.0), Activity(8.0, mute=frozenset({"/talker"}))]:
        wall.model.hear(activity)
    notes = {note for each in wall.said for note in each["activity"]["notes"].values()}
    assert {"10 Hz", "unconnected", "not counted", "no listener", "no publisher"} <= notes
    assert max(map(len, notes)) <= 12


def test_a_topic_of_many_is_shortened() -> None:
    """A hundred connections are not a hundred lines."""
    listeners = tuple(f"/listener_{number}" for number in range(100))
    wall = Wall(graph(topics=(TopicSeen("/chatter", "a/B", ("/talker",), listeners),)))
    wall.model.hear(Activity(0.0))
    details = wall.now["details"]["topic /chatter"]
    assert len(details) == SHOWN
    assert details[-1] == ["…", "89 more connections"]


CALLERS = {
    "/robot/ask": (ServiceCaller("/client", 12, 1000.04, 0), ServiceCaller("/gone_1", 1, 990.0, 0)),
    "/robot/tell": (),
}


def test_callers_are_told_and_those_who_are_gone() -> None:
    """Each service has its callers, the latest first; who is no longer on the graph is marked."""
    wall = Wall()
    wall.model.hear(Activity(0.0, callers=CALLERS))
    assert wall.now["callers"]["service /robot/ask"] == [
        {"node": "/client", "calls": 12, "last": 1000.0, "running": 0, "gone": False},
        {"node": "/gone_1", "calls": 1, "last": 990.0, "running": 0, "gone": True},
    ]
    assert wall.now["callers"]["service /robot/tell"] == []
    assert wall.now["calls"] == [
        {"tail": "node /client", "head": "service /robot/ask", "last": 1000.0, "running": 0}
    ]


def test_a_killed_caller_is_gone() -> None:
    """A node that is only still registered has ended."""
    wall = Wall(graph(dead="/client"))
    wall.model.hear(Activity(0.0, callers=CALLERS))
    assert [each["gone"] for each in wall.now["callers"]["service /robot/ask"]] == [True, True]
    assert wall.now["calls"] == []


def test_a_server_that_does_not_tell_is_not_one_that_nobody_calls() -> None:
    """A service that is missing from the count is missing from what is told."""
    wall = Wall()
    wall.model.hear(Activity(0.0, callers={"/robot/tell": ()}))
    assert set(wall.now["callers"]) == {"service /robot/tell"}


def test_the_line_of_a_call_leads_to_the_box_that_its_service_is_in() -> None:
    """In a folded namespace there is one line for all its services, that of the latest call."""
    wall = Wall()
    later = {**CALLERS, "/robot/tell": (ServiceCaller("/client", 1, 2000.0, 1),)}
    wall.model.hear(Activity(0.0, callers=later))
    assert [each["head"] for each in wall.now["calls"]] == ["service /robot/ask", "service /robot/tell"]
    wall.model.fold("/robot/", fold=True)
    assert wall.now["calls"] == [
        {"tail": "node /client", "head": "namespace /robot/", "last": 2000.0, "running": 1}
    ]


def test_a_hidden_caller_is_not_gone() -> None:
    """The kernel's own node may be hidden from the picture, and is on the graph all the same."""
    said: list[dict[str, Any]] = []
    model = GraphModel(lambda **parts: said.append(parts), own="/client")
    model.see(graph())
    model.choose(noise=False, show_own=False)
    model.hear(Activity(0.0, callers=CALLERS))
    assert not said[-1]["activity"]["callers"]["service /robot/ask"][0]["gone"]


def test_a_type_is_told_with_its_fields() -> None:
    """A click on a topic or a service shows what its messages are made of."""
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
    """A type of another machine, or one that nobody has said, is no error."""
    wall = Wall(graph(topics=(TopicSeen("/t", kind, ("/talker",), ()),)))
    facts = dict(next(each for each in wall.said[-1]["facts"] if each["key"] == "topic /t")["facts"])
    assert facts.get("fields", "").startswith("nowhere/Thing: no message type" if "/" in kind else "")


def test_a_still_picture_has_its_colours_its_rates_and_its_words_in_it() -> None:
    """A file needs nothing else, and has no buttons."""
    wall = Wall()
    for activity in counts(100, 120, 140):
        wall.model.hear(activity)
    drawn = wall.model.still()
    assert ">10 Hz<" in drawn
    assert "@media print" in drawn
    assert 'role="img"' in drawn
    assert 'aria-label="The ROS graph: 4 nodes, 3 topics, 2 services"' in drawn
    assert "/talker\n  publishes  /chatter  (std_msgs/String)" in drawn
    assert "tabindex" not in drawn
