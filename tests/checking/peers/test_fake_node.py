"""Tests of a fake node, which is registered at the master like a real node."""

from __future__ import annotations

from course_pkg.checking.peers.node import FakeNode, Node
from course_pkg.ros import MasterClient, NodeProcess, PrivateMaster, look


def test_fake_node_is_running_or_killed(master: PrivateMaster) -> None:
    """A running fake node accepts connections, and a killed fake node refuses connections."""
    client = MasterClient(master.uri)
    with NodeProcess.rosrun("course_pkg", "pulse") as pulse:
        pulse.wait_for_service("/pulse/get_loggers")
        node = Node("/tester", client.lookup_node("/pulse") or "", client)
        with (
            FakeNode(node, "/left/eye", "/image", "std_msgs/UInt32", alive=True),
            FakeNode(node, "/right/eye", "/image", "std_msgs/UInt32", alive=False),
        ):
            seen = look()
            topic = next(topic for topic in seen.topics if topic.name == "/image")
            assert (topic.type, topic.publishers) == ("std_msgs/UInt32", ("/left/eye", "/right/eye"))
            reaches = {node.name: node.reach for node in seen.nodes}
            assert (reaches["/left/eye"], reaches["/right/eye"]) == ("answered", "refused")
        assert client.system_state().nodes == ("/pulse",)
