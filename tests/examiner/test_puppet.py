"""A puppet is on the master's books as a node is, alive or killed, and is taken off them again."""

from __future__ import annotations

from course_pkg.examiner.node import Node
from course_pkg.examiner.puppet import Puppet
from course_pkg.graph import MasterClient, NodeProcess, PrivateMaster, look


def test_one_answers_and_one_is_dead(master: PrivateMaster) -> None:
    """The living one has an address at which a node answers; at the other's nobody does."""
    client = MasterClient(master.uri)
    with NodeProcess.rosrun("course_pkg", "pulse") as pulse:
        pulse.wait_for_service("/pulse/get_loggers")
        node = Node("/tester", client.lookup_node("/pulse") or "", client)
        with (
            Puppet(node, "/left/eye", "/image", "std_msgs/UInt32", alive=True),
            Puppet(node, "/right/eye", "/image", "std_msgs/UInt32", alive=False),
        ):
            seen = look()
            topic = next(topic for topic in seen.topics if topic.name == "/image")
            assert (topic.type, topic.publishers) == ("std_msgs/UInt32", ("/left/eye", "/right/eye"))
            reaches = {node.name: node.reach for node in seen.nodes}
            assert (reaches["/left/eye"], reaches["/right/eye"]) == ("answered", "refused")
        assert client.system_state().nodes == ("/pulse",)
