"""Tests of recordings with the events of callers and servers."""

from __future__ import annotations

import subprocess
import sys
import textwrap
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from course_pkg.ros import Event, MasterClient, PrivateMaster, Recording
from tests.kernel import Kernel
from tests.support import eventually

START = """
import dataclasses, threading, time
import rospy
from std_msgs.msg import UInt32
from std_srvs.srv import SetBool, Trigger
from course_pkg.ros import join
node = join("asker")
def called(*arguments, **options):
    try:
        return node.call(*arguments, **options)
    except Exception as error:
        return error
"""
PLAIN = """
import rospy
from std_srvs.srv import Trigger
rospy.init_node("plain")
rospy.Service("/plain", Trigger, lambda request: (True, ""))
rospy.spin()
"""


@pytest.fixture
def asker(kernel: Kernel) -> Kernel:
    """Return a kernel that runs a node and has imported some types."""
    kernel.run(START)
    return kernel


def recorded(asker: Kernel, cell: str) -> Recording:
    """Run a cell that creates the variable `recording`, and return this recording."""
    found = asker.run(f"{textwrap.dedent(cell)}\nresult = dataclasses.asdict(recording)")
    events = tuple(Event(**event) for event in found["events"])
    return Recording(
        **{**found, "events": events, "nodes": tuple(found["nodes"]), "notes": tuple(found["notes"])}
    )


def kinds(recording: Recording, key: str) -> list[str]:
    """Return the kinds of the events with the given key, in the order of their start times."""
    return [event.kind for event in recording.parts(key)]


@contextmanager
def plain_node(master: PrivateMaster) -> Iterator[None]:
    """Run a node that has not called prepare_node()."""
    process = subprocess.Popen([sys.executable, "-c", PLAIN])
    try:
        eventually(lambda: "/plain" in MasterClient(master.uri).system_state().services)
        yield
    finally:
        process.terminate()
        process.wait()


@pytest.mark.parametrize(
    "how", ["node.call('/getGeometry', geometry", "rospy.ServiceProxy('/getGeometry', geometry)("]
)
def test_both_ends_of_a_call(asker: Kernel, how: str) -> None:
    """A call has five events of the caller and one event of the handler."""
    opening = how if how.endswith("(") else f"{how}, "
    recording = recorded(
        asker,
        f"""
        from course_pkg.srv import geometry
        server = node.run("course_pkg", "server")
        server.wait_for_service("/getGeometry")
        with node.record() as recording:
            {opening}1.0, 2.0, 3.0)
        server.stop()
    """,
    )
    parts = {event.kind: event for event in recording.parts("call 1")}
    assert [*parts] in (
        ["lookup", "connect", "request", "wait", "handler", "response"],
        ["lookup", "connect", "request", "handler", "wait", "response"],
    )
    handler, response = parts["handler"], parts["response"]
    assert (handler.node, handler.peer, handler.name) == ("/SERVER_NODE", "/asker", "/getGeometry")
    assert {event.node for event in parts.values() if event.kind != "handler"} == {"/asker"}
    assert [parts[kind].peer for kind in ("lookup", "connect", "wait", "response")] == [
        "master",
        *["/SERVER_NODE"] * 3,
    ]
    assert handler.end is not None
    assert parts["request"].start <= handler.start <= handler.end <= response.start <= recording.length
    assert recording.nodes == ("/SERVER_NODE", "/asker")
    assert len(recording.events) == 6


def test_a_persistent_connection_is_looked_up_once(asker: Kernel) -> None:
    """On a persistent connection, only the first call looks up the service at the master."""
    recording = recorded(
        asker,
        """
        seen = []
        rospy.Service("/flip", SetBool, lambda request: (seen.append(1), (not request.data, ""))[1])
        with node.record() as recording:
            proxy = rospy.ServiceProxy("/flip", SetBool, persistent=True)
            for data in (True, False, True):
                proxy(data)
            proxy.close()
    """,
    )
    assert set(kinds(recording, "call 1")) == {"lookup", "connect", "request", "wait", "handler", "response"}
    for key in ("call 2", "call 3"):
        assert set(kinds(recording, key)) == {"request", "wait", "handler", "response"}
    assert len(recording.of("handler")) == 3


def test_a_refusal_is_recorded_at_both_ends(asker: Kernel) -> None:
    """If the server refuses a call, the events of the caller and of the handler contain the error message."""
    recording = recorded(
        asker,
        """
        def refuse(request):
            raise rospy.ServiceException("not today")
        rospy.Service("/no", Trigger, refuse)
        with node.record() as recording:
            called("/no", Trigger)
    """,
    )
    (error,), (handler,) = recording.of("error"), recording.of("handler")
    assert (error.peer, error.key) == ("/asker", handler.key)
    assert "not today" in error.note
    assert "not today" in handler.note


def test_a_service_that_does_not_exist(asker: Kernel) -> None:
    """If the service of a call is unknown, the recording contains a look-up and an error."""
    recording = recorded(asker, "with node.record() as recording:\n    called('/nope', Trigger)")
    assert kinds(recording, "call 1") == ["lookup", "error"]
    assert (recording.events[1].peer, "unavailable" in recording.events[1].note) == ("", True)


def test_a_caller_that_gave_up(asker: Kernel) -> None:
    """After a timeout, the caller has an event "error", and the handler's event has no end time."""
    recording = recorded(
        asker,
        """
        done = threading.Event()
        rospy.Service("/slow", Trigger, lambda request: (done.wait(20), (True, ""))[1])
        with node.record() as recording:
            called("/slow", Trigger, timeout=0.2)
        done.set()
    """,
    )
    (wait,), (error,), (handler,) = (recording.of(kind) for kind in ("wait", "error", "handler"))
    assert wait.end is not None
    assert error.peer == ""
    assert "CallTimeout" in error.note
    assert handler.open
    assert handler.key == wait.key == error.key


def test_unfinished_events_are_open(asker: Kernel) -> None:
    """A caller that still waits and a handler that still runs have no end time."""
    recording = recorded(
        asker,
        """
        begun, done = threading.Event(), threading.Event()
        rospy.Service("/slow", Trigger, lambda request: (begun.set(), done.wait(20), (True, ""))[-1])
        caller = threading.Thread(target=called, args=("/slow", Trigger), kwargs={"timeout": 30})
        caller.start()
        begun.wait(10)
        with node.record() as recording:
            node.call("/asker/get_loggers", "roscpp/GetLoggers")
        done.set()
        caller.join()
    """,
    )
    (handler,) = recording.of("handler", name="/slow")
    (wait,) = recording.of("wait", name="/slow")
    assert handler.open
    assert wait.open
    assert handler.key == wait.key
    assert wait.start < 0
    assert wait.thread != recording.of("wait", name="/asker/get_loggers")[0].thread


def test_a_client_that_ends_during_the_recording(asker: Kernel) -> None:
    """A client process that exits sends its events to the recording."""
    recording = recorded(
        asker,
        """
        server = node.run("course_pkg", "server")
        server.wait_for_service("/getGeometry")
        with node.record() as recording:
            client = node.run("course_pkg", "client", "1", "2", "3")
            client.wait(20)
        left = rospy.get_param("/course_recorders", {})
    """,
    )
    (handler,) = recording.of("handler")
    assert handler.peer.startswith("/client_")
    assert handler.peer in recording.nodes
    assert {event.node for event in recording.parts(handler.key)} == {"/SERVER_NODE", handler.peer}
    assert recording.unrecorded == {}
    assert asker.run("result = [*left]") == []


def test_a_kernel_that_leaves_during_the_recording(asker: Kernel) -> None:
    """If the kernel of another notebook calls leave(), this kernel sends its events to the recording."""
    with Kernel() as other:
        other.run("from std_srvs.srv import Trigger; from course_pkg.ros import join; node = join('other')")
        asker.run("""
            rospy.Service("/x", Trigger, lambda request: (True, ""))
            block = node.record()
            recording = block.__enter__()
        """)
        other.run("node.call('/x', Trigger)")
        other.run("node.leave()")
        recording = recorded(asker, "block.__exit__(None, None, None)")
    assert "/other" in recording.nodes
    assert {event.node for event in recording.parts("call 1")} == {"/asker", "/other"}


def test_a_server_that_died(asker: Kernel) -> None:
    """If a node crashes, the recording lists the node as unrecorded, and contains the caller's events."""
    recording = recorded(
        asker,
        """
        server = node.run("course_pkg", "dying_server")
        server.wait_for_service("/dying")
        with node.record() as recording:
            called("/dying", Trigger)
    """,
    )
    # The recorded error depends on the order in which the sockets close, so the test does not check the
    # message.
    assert [*recording.unrecorded] == ["/dying_server"]
    assert kinds(recording, "call 1") == ["lookup", "connect", "request", "wait", "error"]


def test_a_node_that_is_stopped(asker: Kernel, master: PrivateMaster) -> None:
    """If a node is suspended with SIGSTOP, the recording soon lists this node as unrecorded."""
    reply = asker.ask("""
        import os, signal
        server = node.run("course_pkg", "pulse")
        server.wait_for_service("/pulse/get_loggers")
        os.kill(server.pid, signal.SIGSTOP)
        with node.record() as recording:
            began = time.monotonic()
        took = time.monotonic() - began
        os.kill(server.pid, signal.SIGCONT)
        result = took, recording.unrecorded
    """)
    took, unrecorded = reply.value
    assert took < 3
    assert "paused or busy" in unrecorded["/pulse"]


def test_a_node_without_the_course(asker: Kernel, master: PrivateMaster) -> None:
    """If a node has not called prepare_node(), the recording lists this node as unrecorded."""
    with plain_node(master):
        recording = recorded(asker, "with node.record() as recording:\n    node.call('/plain', Trigger)")
    assert "keeps no record" in recording.unrecorded["/plain"]
    assert "/plain" not in recording.nodes
    assert kinds(recording, "call 1") == ["lookup", "connect", "request", "wait", "response"]


def test_messages_and_their_callbacks(asker: Kernel) -> None:
    """Each callback is assigned to the message that it received."""
    recording = recorded(
        asker,
        """
        publisher = rospy.Publisher("/numbers", UInt32, queue_size=10)
        first = node.subscribe("/numbers", UInt32)
        second = rospy.Subscriber("/numbers", UInt32, lambda message: None)
        while not publisher.get_num_connections():
            time.sleep(0.01)
        with node.record() as recording:
            for number in range(3):
                publisher.publish(number)
                first.wait(number + 1)
            rospy.loginfo("on /rosout")
    """,
    )
    for number in (1, 2, 3):
        assert sorted(kinds(recording, f"message {number}"))[:2] == ["callback", "callback"]
    assert {event.name for event in recording.events} == {"/numbers"}
    assert recording.of("publish")[0].peer == "/asker"
    assert {event.peer for event in recording.of("callback")} == {"/asker"}


FLOOD = """
from std_msgs.msg import String
def by_key(recording, kind, values):
    return dict(zip([event.key for event in recording.of(kind)], values, strict=True))
publisher = rospy.Publisher("/flood", String, queue_size={outgoing})
received, padding = [], "x" * 300_000
def slowly(message):
    received.append(int(message.data.split()[0]))
    time.sleep(0.01)
subscriber = rospy.Subscriber("/flood", String, slowly, queue_size={incoming}, buff_size=1 << 22)
while not publisher.get_num_connections():
    time.sleep(0.01)
with node.record() as recording:
    for number in range(150):
        publisher.publish(f"{{number}} {{padding}}")
    while not received or received[-1] != 149:
        time.sleep(0.01)
sent = by_key(recording, "publish", range(150))
result = [(sent.get(key), value) for key, value in by_key(recording, "callback", received).items()]
"""


@pytest.mark.parametrize(("outgoing", "incoming"), [(3, None), (200, 1), (2, 2)])
def test_dropped_messages_are_not_matched(asker: Kernel, outgoing: int, incoming: int | None) -> None:
    """Each callback is assigned to the right message, even if queues drop other messages."""
    pairs: list[tuple[int | None, int]] = asker.run(FLOOD.format(outgoing=outgoing, incoming=incoming))
    assert 0 < len(pairs) < 150
    assert [sent for sent, _ in pairs] == [received for _, received in pairs]


def test_a_message_without_a_subscriber(asker: Kernel) -> None:
    """If a message has no subscriber, its note says that no subscriber was connected."""
    recording = recorded(
        asker,
        """
        alone = rospy.Publisher("/alone", UInt32, queue_size=1)
        with node.record() as recording:
            alone.publish(1)
    """,
    )
    assert [event.note for event in recording.events] == ["no subscriber was connected"]


def test_a_latched_message_is_sent_again(asker: Kernel) -> None:
    """The callback of a new subscriber is assigned to the latched message that it received."""
    recording = recorded(
        asker,
        """
        latched = rospy.Publisher("/latched", UInt32, queue_size=1, latch=True)
        latched.publish(7)
        with node.record() as recording:
            node.subscribe("/latched", UInt32).wait(1)
    """,
    )
    publish, callback = recording.of("publish")[-1], recording.of("callback")[0]
    assert publish.key == callback.key
    assert "one new subscriber" in publish.note


def test_a_call_from_a_callback(asker: Kernel) -> None:
    """A call in a callback is recorded on the callback's thread."""
    recording = recorded(
        asker,
        """
        calls = []
        rospy.Service("/x", Trigger, lambda request: (calls.append(request), (True, ""))[1])
        heard = node.subscribe("/go", UInt32, lambda message: called("/x", Trigger))
        publisher = rospy.Publisher("/go", UInt32, queue_size=5)
        while not publisher.get_num_connections():
            time.sleep(0.01)
        with node.record() as recording:
            publisher.publish(1)
            publisher.publish(2)
            while len(calls) < 2:  # at the second call, the first callback has ended
                time.sleep(0.01)
    """,
    )
    callback, wait = recording.of("callback")[0], recording.of("wait")[0]
    assert callback.thread == wait.thread
    assert callback.end is not None
    assert wait.end is not None
    assert callback.start <= wait.start <= wait.end <= callback.end


def test_without_a_master() -> None:
    """Without a master, the recording contains only the kernel's own events."""
    with PrivateMaster() as master, Kernel({"ROS_MASTER_URI": master.uri}) as kernel:
        kernel.run(START)
        kernel.run("""
            rospy.Service("/x", Trigger, lambda request: (True, ""))
            proxy = rospy.ServiceProxy("/x", Trigger, persistent=True)
            proxy()
        """)
        master.stop()
        recording = recorded(kernel, "with node.record() as recording:\n    proxy()")
    assert set(kinds(recording, "call 1")) == {"request", "wait", "handler", "response"}
    assert "master" in recording.notes[0]


def test_an_error_in_the_block(asker: Kernel) -> None:
    """If the block raises an error, the recording contains the events before the error."""
    reply = asker.ask("""
        with node.record() as recording:
            called("/nope", Trigger)
            raise KeyError("mine")
    """)
    assert reply.error == "KeyError"
    assert asker.run("result = [event.kind for event in recording.events]") == ["lookup", "error"]


def test_a_rospy_with_other_methods(kernel: Kernel) -> None:
    """If a rospy method has unexpected parameters, the recording contains a note."""
    assert kernel.run("""
        from rospy.impl.tcpros_service import ServiceImpl
        bare = ServiceImpl._handle_request
        def _handle_request(self, transport, request, novelty=None):
            return bare(self, transport, request)
        ServiceImpl._handle_request = _handle_request
        import rospy
        from std_srvs.srv import Trigger
        from course_pkg.ros import join
        node = join("other")
        rospy.Service("/x", Trigger, lambda request: (True, "here"))
        with node.record() as recording:
            answer = node.call("/x", Trigger).message
        untouched = ServiceImpl._handle_request is _handle_request
        result = answer, untouched, recording.notes, [event.kind for event in recording.of("handler")]
    """) == [
        "here",
        True,
        ["/other does not record service calls: this rospy makes and answers them in another way."],
        [],
    ]
