"""Tests of rospy services after join(), and of the requests that node.call() accepts."""

from __future__ import annotations

import socket

import pytest

from course_pkg.ros import MasterClient, PrivateMaster
from tests.kernel import Kernel

START = """
import rospy
from std_srvs.srv import SetBool, Trigger, TriggerRequest, TriggerResponse
from course_pkg.ros import BoundedProxy, join
node = join("server")
"""


@pytest.fixture
def joined(kernel: Kernel) -> Kernel:
    """Return a kernel that runs a node and has imported some types."""
    kernel.run(START)
    return kernel


@pytest.mark.parametrize(
    ("kind", "told"),
    [
        ("TriggerRequest", "Pass the type itself: Trigger."),
        ("TriggerResponse", "Pass the type itself: Trigger."),
        ("int", "int is not a service type"),
        ("__import__('std_msgs.msg').msg.UInt32", "is a message type"),
    ],
)
def test_another_class_in_place_of_the_type(joined: Kernel, kind: str, told: str) -> None:
    """If an argument is not a service type, the error message contains the expected type."""
    reply = joined.ask(f"node.call('/x', {kind})")
    assert reply.error == "NotAServiceType"
    assert told in reply.words


def test_idle_connections_do_not_block_clients(joined: Kernel, master: PrivateMaster) -> None:
    """Idle connections do not block other clients."""
    joined.run("rospy.Service('/x', Trigger, lambda request: (True, 'here'))")
    uri = MasterClient(master.uri).lookup_service("/x")
    assert uri is not None
    address = ("localhost", int(uri.rpartition(":")[2]))
    idle = [socket.create_connection(address) for _ in range(5)]
    idle[0].sendall(b"\x40\x00")
    idle[1].sendall(b"\x40\x00\x00\x00\x10\x00\x00\x00callerid=")
    idle[2].sendall(b"\xff\xff\xff\xff")
    reply = joined.ask("result = node.call('/x', Trigger).message")
    assert reply.value == "here"
    assert reply.took < 1
    for sock in idle:
        sock.close()


def test_burst_of_clients(joined: Kernel) -> None:
    """Thirty simultaneous calls all succeed within 1 s."""
    took = joined.run("""
        import time
        from concurrent.futures import ThreadPoolExecutor
        rospy.Service("/x", Trigger, lambda request: (True, "here"))
        proxy = BoundedProxy("/x", Trigger)
        started = time.monotonic()
        with ThreadPoolExecutor(30) as pool:
            answers = list(pool.map(lambda _: proxy().message, range(30)))
        assert answers == ["here"] * 30
        result = time.monotonic() - started
    """)
    assert took < 1


def test_calling_itself(joined: Kernel) -> None:
    """A handler can call another service of the same node."""
    assert (
        joined.run("""
        rospy.Service("/inner", Trigger, lambda request: (True, "inner"))
        def outer(request):
            return True, "outer of " + node.call("/inner", Trigger).message
        rospy.Service("/outer", Trigger, outer)
        result = node.call("/outer", Trigger).message
    """)
        == "outer of inner"
    )


def test_three_ways_to_give_a_request(joined: Kernel) -> None:
    """A call accepts positional fields, named fields, or a request."""
    assert joined.run("""
        from std_srvs.srv import SetBoolRequest
        rospy.Service("/x", SetBool, lambda request: (request.data, ""))
        call = lambda *values, **fields: node.call("/x", SetBool, *values, **fields).success
        result = call(True), call(data=True), call(SetBoolRequest(True)), call()
    """) == [True, True, True, False]
    assert joined.ask("call(1, 2)").error == "TypeError"
    assert joined.ask("call(dat=True)").error == "AttributeError"
    assert joined.ask("call('text')").error == "SerializationError"


def test_types_from_text_and_from_a_name(joined: Kernel) -> None:
    """call() accepts a service type that was compiled from text, and the name of a service type."""
    assert joined.run("""
        from course_pkg.types import compile_service
        echo = compile_service("course_pkg/Echo", "string text\\n---\\nstring text\\n")
        rospy.Service("/echo", echo.cls, lambda request: request.text)
        rospy.Service("/named", Trigger, lambda request: (True, "named"))
        result = node.call("/echo", echo, "hello").text, node.call("/named", "std_srvs/Trigger").message
    """) == ["hello", "named"]
