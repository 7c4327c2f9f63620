"""Tests of the topic panel's widget on a real master, without a page."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.errors import NotATopic, UnknownType
from course_pkg.panels import TopicPanel
from course_pkg.ros import MasterClient, PrivateMaster, look
from tests.kernel import Kernel
from tests.support import eventually

SETTINGS = {"rate": "10", "queue": "10", "latch": False, "path": "data"}


@pytest.fixture
def panel(master: PrivateMaster) -> Iterator[TopicPanel]:
    """Yield a visible panel of /speed, and close the panel after the test."""
    assert master.uri
    panel = TopicPanel("/speed", "std_msgs/Float64")
    panel.received("hello", {})
    panel.shown()
    eventually(lambda: panel.connections.get("own"), timeout=20)
    yield panel
    panel.hidden()
    panel.close()
    eventually(lambda: not look(master.uri).nodes)


def click(panel: TopicPanel, action: str, data: str, **settings: object) -> None:
    """Send the message that the page sends for a click."""
    content = {"action": action, "draft": {"data": data}, "settings": {**SETTINGS, **settings}}
    panel.received("act", content)


def sent_to(panel: TopicPanel) -> set[str]:
    """Return the nodes that received the message."""
    return {each["peer"] for each in panel.publisher.get("deliveries", ()) if each["sent"]}


def test_it_is_on_the_graph_while_a_page_shows_it(panel: TopicPanel, master: PrivateMaster) -> None:
    """A visible panel is a subscriber on the graph, and a hidden panel is not on the graph."""
    panel.shown()
    topic = next(each for each in look(master.uri).topics if each.name == "/speed")
    assert topic.subscribers == (panel.connections["own"],)
    assert topic.publishers == ()
    panel.hidden()
    eventually(lambda: not look(master.uri).nodes)


def test_no_page_no_node(master: PrivateMaster) -> None:
    """If no page shows a panel, the panel starts no process, but has a form."""
    panel = TopicPanel("/speed", "std_msgs/Float64")
    assert panel.check["once"] == "rostopic pub --once /speed std_msgs/Float64 0.0"
    assert panel.trouble == ""
    assert look(master.uri).nodes == ()
    panel.close()


def test_a_click_publishes_for_real(panel: TopicPanel, kernel: Kernel) -> None:
    """A subscriber in another node receives the published number."""
    kernel.run("""
        from course_pkg.ros import join
        node = join("listener")
        heard = node.subscribe("/speed", "std_msgs/Float64")
    """)
    click(panel, "publish", "-1.5", latch=True)
    assert kernel.run("result = heard.wait(1)[0].data") == -1.5
    eventually(lambda: "/listener" in sent_to(panel))
    assert eventually(lambda: panel.messages)[0]["line"] == "data -1.5"


def test_hiding_it_ends_what_it_publishes(panel: TopicPanel, kernel: Kernel) -> None:
    """When no page shows the panel, the panel stops publishing."""
    kernel.run("""
        from course_pkg.ros import join
        from tests.support import eventually
        node = join("listener")
        heard = node.subscribe("/speed", "std_msgs/Float64")
    """)
    click(panel, "repeat", "1", rate="50")
    kernel.run("heard.wait(10)")
    panel.hidden()
    kernel.run("eventually(lambda: not heard._subscriber.get_num_connections())")
    assert kernel.run("count = heard.count; node.call; result = heard.count - count") == 0


def test_a_panel_that_is_shown_again_keeps_its_type_and_plot(panel: TopicPanel) -> None:
    """When a panel is shown again, its type and plot have not changed."""
    click(panel, "publish", "2.5")
    first = panel.connections["own"]
    panel.hidden()
    panel.shown()
    eventually(lambda: panel.connections.get("own") not in ("", first), timeout=20)
    assert panel.messages == []
    click(panel, "publish", "3.5", latch=True)
    assert eventually(lambda: panel.messages)[0]["line"] == "data 3.5"
    assert eventually(lambda: '"count": 1' in panel.curve)


def test_quick_shows_and_hides_leave_at_most_one_node(panel: TopicPanel, master: PrivateMaster) -> None:
    """After the panel was shown and hidden many times, at most one node exists."""
    for _ in range(8):
        panel.hidden()
        panel.shown()
    eventually(
        lambda: [node.name for node in look(master.uri).nodes] == [panel.connections["own"]], timeout=30
    )
    panel.hidden()
    eventually(lambda: not look(master.uri).nodes)


def test_another_type_is_reported(panel: TopicPanel, kernel: Kernel) -> None:
    """If the type of a publisher differs from the type of the panel, the panel shows this publisher."""
    kernel.run("""
        import rospy
        from std_msgs.msg import String
        from course_pkg.ros import join
        node = join("talker")
        publisher = rospy.Publisher("/speed", String, queue_size=10)
    """)
    warnings = eventually(lambda: panel.connections["warnings"])
    assert warnings[0].startswith("/talker publishes std_msgs/String (MD5 992ce8a1…)")


def test_the_type_of_a_topic_is_found(kernel: Kernel) -> None:
    """A panel without a type uses the type of the publisher."""
    kernel.run("""
        import rospy
        from sensor_msgs.msg import JointState
        from course_pkg.ros import join
        node = join("talker")
        publisher = rospy.Publisher("/joints", JointState, queue_size=10)
    """)
    panel = TopicPanel("joints")
    assert panel.about["message"]["name"] == "sensor_msgs/JointState"
    assert panel.connections["publishers"] == [{"node": "/talker", "type": "sensor_msgs/JointState"}]
    panel.close()


def test_the_text_is_the_same_in_every_run(panel: TopicPanel) -> None:
    """The plain text contains the name of the topic, but no values."""
    assert repr(panel) == panel._repr_mimebundle_()[0]["text/plain"] == "TopicPanel('/speed')"


def test_a_mistake_in_the_cell_raises_an_error() -> None:
    """An unknown type or an invalid name raises an error."""
    with pytest.raises(UnknownType, match="Flaot64"):
        TopicPanel("/speed", "std_msgs/Flaot64")
    with pytest.raises(NotATopic):
        TopicPanel("/my speed", "std_msgs/Float64")


def test_without_a_master_the_panel_gives_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a master, the panel shows its form and the reason why the panel cannot subscribe."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    panel = TopicPanel("/speed", "std_msgs/Float64")
    assert "No ROS master" in panel.trouble
    panel.close()


def test_it_follows_its_kernel_to_another_master(monkeypatch: pytest.MonkeyPatch) -> None:
    """If ROS_MASTER_URI changes, an open panel uses the new master."""
    with PrivateMaster() as master:
        monkeypatch.setenv("ROS_HOSTNAME", "localhost")
        monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
        panel = TopicPanel("/speed", "std_msgs/Float64")
        panel.shown()
        eventually(lambda: panel.trouble)
        monkeypatch.setenv("ROS_MASTER_URI", master.uri)
        eventually(lambda: panel.connections.get("own"), timeout=20)
        assert panel.trouble == ""
        panel.hidden()
        eventually(lambda: not MasterClient(master.uri).system_state().nodes)
        panel.close()
