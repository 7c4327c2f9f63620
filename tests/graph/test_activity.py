"""What nodes count is read from them without anybody subscribing, whatever they are written in."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from xmlrpc.server import SimpleXMLRPCServer

import pytest

from course_pkg.errors import UnknownExecutable
from course_pkg.graph import (
    Activity,
    Carried,
    NodeProcess,
    NodeSeen,
    PrivateMaster,
    Snapshot,
    listen,
    look,
)
from tests.kernel import Kernel
from tests.support import eventually, stopped

SPEAK = """
import rospy
from std_msgs.msg import String
from course_pkg.graph import join
node = join("speaker")
speaker = rospy.Publisher("/words", String, queue_size=10)
"""
HEAR = """
from std_msgs.msg import String
from course_pkg.graph import join
node = join("listener")
heard = node.subscribe("/words", String)
"""


@pytest.fixture
def pair(master: PrivateMaster) -> Iterator[tuple[Kernel, Kernel]]:
    """A kernel that publishes and one that listens, connected."""
    with Kernel() as speaker, Kernel() as listener:
        speaker.run(SPEAK)
        listener.run(HEAR)
        eventually(lambda: speaker.run("result = speaker.get_num_connections()") == 1)
        yield speaker, listener


def counted(wanted: Callable[[Carried], bool]) -> int | None:
    """Find what the one connection that is wanted has carried; None when there is none."""
    found = [each.messages for each in listen(look()).carried if wanted(each)]
    assert len(found) <= 1
    return found[0] if found else None


def test_messages_are_counted_by_connection(pair: tuple[Kernel, Kernel]) -> None:
    """A connection is told with both its ends and what went over it; looking does not add a subscriber."""
    speaker, _ = pair
    before = [topic for topic in look().topics if topic.name == "/words"]
    speaker.run("for number in range(3): speaker.publish(str(number))")
    eventually(lambda: counted(lambda each: each.topic == "/words") == 3)
    [carried] = [each for each in listen(look()).carried if each.topic == "/words"]
    assert (carried.publisher, carried.subscriber) == ("/speaker", "/listener")
    assert [topic for topic in look().topics if topic.name == "/words"] == before
    assert speaker.run("result = speaker.get_num_connections()") == 1


def test_without_a_listener_there_is_no_connection(kernel: Kernel) -> None:
    """What is published to nobody is carried nowhere, and the node is not mute for that."""
    kernel.run(SPEAK + "\nfor number in range(3): speaker.publish('x')")
    seen = listen(look())
    assert [each for each in seen.carried if each.topic == "/words"] == []
    assert seen.mute == frozenset()


def test_a_connection_of_more_than_two_gigabytes(pair: tuple[Kernel, Kernel]) -> None:
    """A node whose count of bytes XML-RPC cannot carry is mute; the others are read all the same."""
    speaker, _ = pair
    speaker.run("speaker.impl.connections[0].stat_bytes = 2**31")
    speaker.run("speaker.publish('x')")
    assert listen(look()).mute == {"/speaker"}


def test_a_stopped_node_costs_half_a_second_and_is_mute(pair: tuple[Kernel, Kernel]) -> None:
    """Who does not answer is said; who does is read."""
    speaker, listener = pair
    snapshot = look()
    with stopped(speaker.pid):
        seen = listen(snapshot)
    assert isinstance(seen, Activity)
    assert seen.mute == {"/speaker"}
    assert listener.run("result = node.name") == "/listener"


def test_a_node_written_in_cpp(master: PrivateMaster) -> None:
    """Roscpp answers in another shape, and is read as well; who calls its services it does not tell."""
    try:
        process = NodeProcess.rosrun("rosout", "rosout")
    except UnknownExecutable:
        pytest.skip("the C++ node rosout is not installed")
    with process, Kernel() as kernel:
        process.wait_for_service("/rosout/get_loggers", timeout=20)
        kernel.run(SPEAK + "from rosgraph_msgs.msg import Log\nall = node.subscribe('/rosout_agg', Log)")
        kernel.run("log = rospy.Publisher('/rosout', Log, queue_size=10)")
        eventually(lambda: kernel.run("result = log.get_num_connections()") == 1)
        eventually(lambda: counted(lambda each: each.topic == "/rosout_agg") is not None)
        kernel.run("for number in range(4): log.publish(Log(name='/speaker', msg=str(number)))")
        eventually(lambda: (counted(lambda each: each.topic == "/rosout_agg") or 0) >= 4)
        seen = listen(look())
        assert "/rosout" not in seen.mute
        assert "/speaker/get_loggers" in seen.callers
        assert "/rosout/get_loggers" not in seen.callers


def test_who_called_is_told_by_the_server(kernel: Kernel) -> None:
    """A service of the course's nodes has its callers, the latest first, with how often and when."""
    with NodeProcess.rosrun("course_pkg", "server") as server:
        server.wait_for_service("/getGeometry", timeout=20)
        assert listen(look()).callers["/getGeometry"] == ()
        kernel.run(
            "from course_pkg.graph import join; from course_pkg.srv import geometry\n"
            "node = join('asker')\n"
            "for side in (1, 2): node.call('/getGeometry', geometry, side, side, side)"
        )
        [caller] = listen(look()).callers["/getGeometry"]
        assert (caller.node, caller.calls, caller.running) == ("/asker", 2, 0)
        assert caller.last > 1e9


def test_an_empty_graph() -> None:
    """Nobody to ask is no error."""
    with PrivateMaster() as alone:
        seen = listen(look(alone.uri))
    assert (seen.carried, seen.mute, dict(seen.callers)) == ((), frozenset(), {})


@pytest.mark.parametrize(
    "answer",
    [
        [1, "", [[["/words", 3, [[1, 10, 3, True]]]], [], [["/service", "calls"]]]],
        [1, "", [[["/words"]], [], []]],
        [1, "", "nothing"],
        [0, "not supported", 0],
        "nonsense",
    ],
)
def test_a_stranger_s_answer_does_no_harm(answer: object) -> None:
    """A node of another library may answer in a shape of its own: what cannot be read is not counted."""
    server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
    server.register_function(lambda _: answer, "getBusStats")
    server.register_function(lambda _: [1, "", [[1, "/listener", "o", "TCPROS", "/words"]]], "getBusInfo")
    threading.Thread(target=server.serve_forever, daemon=True).start()
    node = NodeSeen("/stranger", f"http://localhost:{server.server_address[1]}/", "answered")
    try:
        seen = listen(Snapshot("http://localhost:1", (node,), (), ()))
    finally:
        server.shutdown()
        server.server_close()
    assert seen.callers == {}
    assert seen.mute == {"/stranger"} or seen.carried == (Carried("/words", "/stranger", "/listener", 1, 3),)
