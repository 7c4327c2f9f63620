"""Tests of the message counts of nodes, and of the callers of services."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from xmlrpc.server import SimpleXMLRPCServer

import pytest

from course_pkg.errors import UnknownExecutable
from course_pkg.ros import (
    Activity,
    ActivityPoller,
    MasterClient,
    NodeProcess,
    NodeSeen,
    PrivateMaster,
    Snapshot,
    Traffic,
    look,
)
from course_pkg.ros.protocol.probe import Reach, ask_all
from course_pkg.ros.trace.activity import Callers, answered_callers, callers_probe
from tests.kernel import Kernel
from tests.support import eventually, stopped

SPEAK = """
import rospy
from std_msgs.msg import String
from course_pkg.ros import join
node = join("speaker")
speaker = rospy.Publisher("/words", String, queue_size=10)
"""
HEAR = """
from std_msgs.msg import String
from course_pkg.ros import join
node = join("listener")
heard = node.subscribe("/words", String)
"""


SERVE = """
import threading
import rospy
from std_srvs.srv import Trigger
from course_pkg.ros import join
node = join("server")
done = threading.Event()
raw = rospy.Service("/raw", Trigger, lambda request: (done.wait(20), (True, ""))[1])
rospy.Service("/served", Trigger, lambda request: (True, ""))
"""
ASK = """
from std_srvs.srv import Trigger
from course_pkg.ros import join
node = join("asker")
for _ in range(3):
    node.call("/served", Trigger)
"""


@pytest.fixture
def pair(master: PrivateMaster) -> Iterator[tuple[Kernel, Kernel]]:
    """Run a publisher and a subscriber in two kernels, and wait until they are connected."""
    with Kernel() as speaker, Kernel() as listener:
        speaker.run(SPEAK)
        listener.run(HEAR)
        eventually(lambda: speaker.run("result = speaker.get_num_connections()") == 1)
        yield speaker, listener


def counted(wanted: Callable[[Traffic], bool]) -> int | None:
    """Return the number of messages on the connection that `wanted` selects, or None if there is none."""
    found = [each.messages for each in ActivityPoller().poll(look()).traffic if wanted(each)]
    assert len(found) <= 1
    return found[0] if found else None


def test_messages_are_counted_by_connection(pair: tuple[Kernel, Kernel]) -> None:
    """A poll returns the two nodes of each connection and the number of messages."""
    speaker, _ = pair
    before = [topic for topic in look().topics if topic.name == "/words"]
    speaker.run("for number in range(3): speaker.publish(str(number))")
    eventually(lambda: counted(lambda each: each.topic == "/words") == 3)
    [traffic] = [each for each in ActivityPoller().poll(look()).traffic if each.topic == "/words"]
    assert (traffic.publisher, traffic.subscriber) == ("/speaker", "/listener")
    assert [topic for topic in look().topics if topic.name == "/words"] == before
    assert speaker.run("result = speaker.get_num_connections()") == 1


def test_without_a_listener_there_is_no_connection(kernel: Kernel) -> None:
    """If a publisher has no subscribers, a poll does not list the publisher as silent."""
    kernel.run(SPEAK + "\nfor number in range(3): speaker.publish('x')")
    seen = ActivityPoller().poll(look())
    assert [each for each in seen.traffic if each.topic == "/words"] == []
    assert seen.silent == frozenset()


def test_a_connection_of_more_than_two_gigabytes(pair: tuple[Kernel, Kernel]) -> None:
    """If a connection's number of bytes is too large for XML-RPC, the poll lists the node as silent."""
    speaker, _ = pair
    speaker.run("speaker.impl.connections[0].stat_bytes = 2**31")
    speaker.run("speaker.publish('x')")
    assert ActivityPoller().poll(look()).silent == {"/speaker"}


def test_a_stopped_node_is_silent(pair: tuple[Kernel, Kernel]) -> None:
    """If a node is suspended with SIGSTOP, a poll lists this node as silent."""
    speaker, listener = pair
    snapshot = look()
    with stopped(speaker.pid):
        seen = ActivityPoller().poll(snapshot)
    assert isinstance(seen, Activity)
    assert seen.silent == {"/speaker"}
    assert listener.run("result = node.name") == "/listener"


def test_a_node_written_in_cpp(master: PrivateMaster) -> None:
    """The poller reads the message counts of a C++ node, although C++ nodes use another format.

    A C++ node does not report callers.
    """
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
        seen = ActivityPoller().poll(look())
        assert "/rosout" not in seen.silent
        assert "/speaker/get_loggers" in seen.callers
        assert "/rosout/get_loggers" not in seen.callers


def test_the_server_reports_its_callers(kernel: Kernel) -> None:
    """A node of the course reports the callers of its services."""
    with NodeProcess.rosrun("course_pkg", "server") as server:
        server.wait_for_service("/getGeometry", timeout=20)
        assert ActivityPoller().poll(look()).callers["/getGeometry"] == ()
        kernel.run(
            "from course_pkg.ros import join; from course_pkg.srv import geometry\n"
            "node = join('asker')\n"
            "for side in (1, 2): node.call('/getGeometry', geometry, side, side, side)"
        )
        [caller] = ActivityPoller().poll(look()).callers["/getGeometry"]
        assert (caller.node, caller.calls, caller.running) == ("/asker", 2, 0)
        assert caller.last > 1e9


def test_an_empty_graph() -> None:
    """A poll of an empty graph returns empty results."""
    with PrivateMaster() as alone:
        seen = ActivityPoller().poll(look(alone.uri))
    assert (seen.traffic, seen.silent, dict(seen.callers)) == ((), frozenset(), {})


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
def test_an_answer_in_another_format_does_no_harm(answer: object) -> None:
    """If a node's response has an unknown format, the poller ignores the unknown data."""
    server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
    server.register_function(lambda _: answer, "getBusStats")
    server.register_function(lambda _: [1, "", [[1, "/listener", "o", "TCPROS", "/words"]]], "getBusInfo")
    threading.Thread(target=server.serve_forever, daemon=True).start()
    node = NodeSeen("/stranger", f"http://localhost:{server.server_address[1]}/", "answered")
    try:
        seen = ActivityPoller().poll(Snapshot("http://localhost:1", (node,), (), ()))
    finally:
        server.shutdown()
        server.server_close()
    assert seen.callers == {}
    assert seen.silent == {"/stranger"} or seen.traffic == (
        Traffic("/words", "/stranger", "/listener", 1, 3),
    )


def ask(master: PrivateMaster, *nodes: str) -> Callers:
    """Return the callers that the given nodes report."""
    probes = [callers_probe(uri) for uri in MasterClient(master.uri).lookup_all(nodes, ())[0].values()]
    ask_all(probes, 0.5)
    return {name: callers for probe in probes for name, callers in answered_callers(probe).items()}


def test_callers_are_counted(kernel: Kernel, master: PrivateMaster) -> None:
    """A service reports the number of calls for each caller, and the time of the last call."""
    kernel.run(SERVE)
    before = time.time()
    with Kernel() as asker:
        asker.run(ASK)
        (caller,) = ask(master, "/server")["/served"]
    assert (caller.node, caller.calls, caller.running) == ("/asker", 3, 0)
    assert before <= caller.last <= time.time()
    assert ask(master, "/server")["/raw"] == ()


def test_waiting_callers_are_counted(kernel: Kernel, master: PrivateMaster) -> None:
    """A caller counts as waiting while the handler runs."""
    kernel.run(SERVE)
    with Kernel() as asker:
        asker.run(ASK)
        asker.begin("node.call('/raw', Trigger, timeout=20)")
        (caller,) = eventually(lambda: ask(master, "/server")["/raw"])
        assert (caller.node, caller.running) == ("/asker", 1)
        kernel.run("done.set()")
        asker.reply()
        assert eventually(lambda: ask(master, "/server")["/raw"][0].running == 0)


def test_a_node_that_does_not_count_callers(kernel: Kernel, master: PrivateMaster) -> None:
    """A node that does not count its callers is not in the result."""
    kernel.run(SERVE)
    with stopped(kernel.pid):
        began = time.monotonic()
        assert ask(master, "/server") == {}
        assert time.monotonic() - began < 2
    with Kernel() as plain:
        plain.run("import rospy; rospy.init_node('plain', disable_signals=True)")
        assert ask(master, "/plain") == {}


def test_statistics_of_topics_are_unchanged(kernel: Kernel) -> None:
    """The method getBusStats still returns rospy's values for topics."""
    stats, refused = kernel.run(
        SERVE
        + """
from xmlrpc.client import ServerProxy
proxy = ServerProxy(node.uri)
result = proxy.getBusStats("/test"), proxy.getBusStats("/test", "too much")[0]
"""
    )
    code, _, (published, subscribed, services) = stats
    assert code == 1
    assert [topic for topic, *_ in published] == ["/rosout"]
    assert subscribed == []
    assert {name for name, _ in services} >= {"/raw", "/served"}
    assert refused == -1


@pytest.mark.parametrize(
    "answer", [b"", b"HTTP/1.0 200 OK\r\n\r\n<methodResponse>", b"nonsense</methodResponse>"]
)
def test_an_invalid_answer(answer: bytes) -> None:
    """An invalid XML-RPC response is treated like a missing response."""
    probe = callers_probe("http://localhost:1/")
    probe.answer, probe.reach = answer, Reach.ANSWERED
    assert answered_callers(probe) == {}
