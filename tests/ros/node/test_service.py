"""Tests of services whose cell runs again, and of the stored calls."""

from __future__ import annotations

import socket

import pytest

from course_pkg.ros import MasterClient, PrivateMaster
from tests.kernel import Kernel

START = """
import sys
import rospy
from std_srvs.srv import Empty, SetBool, Trigger, TriggerRequest, TriggerResponse
from course_pkg.ros import join
node = join("server")
def words(name="/x", kind=Trigger, *values):
    try:
        node.call(name, kind, *values, timeout=2)
    except rospy.ServiceException as error:
        return str(error)
"""


@pytest.fixture
def joined(kernel: Kernel) -> Kernel:
    """Return a kernel that runs a node and has imported some types."""
    kernel.run(START)
    return kernel


def test_serving_again_replaces(joined: Kernel) -> None:
    """After the cell runs again, all connections use the new handler."""
    assert joined.run("""
        node.serve("/x", Trigger, lambda request: (True, "old"))
        kept = rospy.ServiceProxy("/x", Trigger, persistent=True)
        result = [kept().message]
        node.serve("/x", Trigger, lambda request: (True, "new"))
        result += [kept().message, node.call("/x", Trigger).message]
    """) == ["old", "new", "new"]


def test_serving_replaces_a_raw_service(joined: Kernel) -> None:
    """serve() replaces a service that rospy.Service created."""
    assert (
        joined.run("""
        raw = rospy.Service("/x", Trigger, lambda request: (True, "raw"))
        served = node.serve("/x", Trigger, lambda request: (True, "served"))
        raw.shutdown()
        result = node.call("/x", Trigger).message, repr(served), raw.resolved_name
    """)[0]
        == "served"
    )


def test_another_type_with_the_same_name(joined: Kernel) -> None:
    """A service can change its type, and a persistent client then gets an error."""
    reply = joined.run("""
        node.serve("/x", Trigger, lambda request: (True, "old"))
        kept = rospy.ServiceProxy("/x", Trigger, persistent=True)
        kept()
        node.serve("/x", SetBool, lambda request: (request.data, "new"))
        result = [node.call("/x", SetBool, True).message]
        try:
            kept()
        except rospy.ServiceException as error:
            result.append(str(error))
    """)
    assert reply[0] == "new"
    assert "is of type std_srvs/SetBool now" in reply[1]


def test_calls_are_stored(joined: Kernel) -> None:
    """The service stores the request, the response and the time of the last 1000 calls."""
    assert joined.run("""
        import time
        started = time.time()
        served = node.serve("/x", SetBool, lambda request: (request.data, "done"))
        caller = node.caller("/x", SetBool, persistent=True)
        for number in range(1001):
            caller(number == 1000)
        last = served.calls[-1]
        result = [len(served.calls), last.request.data, last.response.success, last.time >= started]
    """) == [1000, True, True, True]


@pytest.mark.parametrize(
    ("handler", "told"),
    [
        ("lambda request: None", "service cannot process request: service handler returned None"),
        ("lambda request: 1 / 0", "error processing request: division by zero"),
        ("lambda request: 42", "service cannot process request: handler returned invalid value"),
        (
            "lambda request: {'ok': True}",
            "ok is not an attribute of TriggerResponse",
        ),
        (
            "lambda request: TriggerResponse('yes', '')",
            "error processing request: field success is not a bool",
        ),
        (
            "lambda: (True, '')",
            "error processing request: <lambda>() takes 0 positional arguments but 1 was given",
        ),
        ("lambda request: sys.exit(3)", "service cannot process request: handler ended with SystemExit: 3"),
        ("lambda request: exec('raise KeyboardInterrupt')", "handler ended with KeyboardInterrupt"),
    ],
)
def test_errors_are_sent_to_the_client_and_stored(joined: Kernel, handler: str, told: str) -> None:
    """If a handler fails, the client gets rospy's error message, and the service stores the error."""
    words, errors = joined.run(f"""
        served = node.serve("/x", Trigger, {handler})
        result = words(), [(call.error, call.traceback) for call in served.errors]
    """)
    assert told in words
    assert len(errors) == 1
    assert told in errors[0][0]
    assert errors[0][1].startswith("Traceback")


def test_traceback_shows_the_handler(joined: Kernel) -> None:
    """The stored traceback contains the failing line of the handler."""
    assert joined.run("""
        def stumbling_handler(request):
            raise ValueError("no bottom")
        served = node.serve("/x", Trigger, stumbling_handler)
        words()
        result = "in stumbling_handler" in served.errors[0].traceback
    """)


def test_printed_text_of_a_handler_is_stored(joined: Kernel) -> None:
    """`output` contains the text that the handler printed, and the cell does not show this text."""
    output = joined.run("""
        def chatty(request):
            print("from the handler")
            print("and an error", file=sys.stderr)
            return True, ""
        served = node.serve("/x", Trigger, chatty)
        node.call("/x", Trigger)
        print("from the cell")
        result = served.output
    """)
    assert output == "from the handler\nand an error\n"
    printed = joined.exit()
    assert "from the cell" in printed
    assert "from the handler" not in printed


def test_stopping(joined: Kernel, master: PrivateMaster) -> None:
    """A stopped service is unregistered, and a second stop() has no effect."""
    assert joined.run("""
        first = node.serve("/x", Trigger, lambda request: (True, "first"))
        second = node.serve("/x", Trigger, lambda request: (True, "second"))
        first.stop()
        result = node.call("/x", Trigger).message, repr(first), repr(second)
        second.stop()
        second.stop()
    """) == ["second", "</x of type std_srvs/Trigger, stopped>", "</x of type std_srvs/Trigger, served>"]
    assert MasterClient(master.uri).lookup_service("/x") is None


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
    for cell in (f"node.serve('/x', {kind}, print)", f"node.call('/x', {kind})"):
        reply = joined.ask(cell)
        assert reply.error == "NotAServiceType"
        assert told in reply.words


def test_idle_connections_do_not_block_clients(joined: Kernel, master: PrivateMaster) -> None:
    """Idle connections do not block other clients."""
    joined.run("node.serve('/x', Trigger, lambda request: (True, 'here'))")
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
        node.serve("/x", Trigger, lambda request: (True, "here"))
        proxy = node.caller("/x", Trigger)
        started = time.monotonic()
        with ThreadPoolExecutor(30) as pool:
            answers = list(pool.map(lambda _: proxy().message, range(30)))
        assert answers == ["here"] * 30
        result = time.monotonic() - started
    """)
    assert took < 1


def test_calling_itself(joined: Kernel) -> None:
    """A handler can call another service of its own node."""
    assert (
        joined.run("""
        node.serve("/inner", Trigger, lambda request: (True, "inner"))
        def outer(request):
            return True, "outer of " + node.call("/inner", Trigger).message
        node.serve("/outer", Trigger, outer)
        result = node.call("/outer", Trigger).message
    """)
        == "outer of inner"
    )


def test_three_ways_to_give_a_request(joined: Kernel) -> None:
    """A call accepts positional fields, named fields, or a request."""
    assert joined.run("""
        from std_srvs.srv import SetBoolRequest
        node.serve("/x", SetBool, lambda request: (request.data, ""))
        call = lambda *values, **fields: node.call("/x", SetBool, *values, **fields).success
        result = call(True), call(data=True), call(SetBoolRequest(True)), call()
    """) == [True, True, True, False]
    assert joined.ask("call(1, 2)").error == "TypeError"
    assert joined.ask("call(dat=True)").error == "AttributeError"
    assert joined.ask("call('text')").error == "SerializationError"


def test_types_from_text_and_from_a_name(joined: Kernel) -> None:
    """serve() and call() accept a class that was made from text, and the name of a type."""
    assert joined.run("""
        from course_pkg.types import compile_service
        echo = compile_service("course_pkg/Echo", "string text\\n---\\nstring text\\n")
        node.serve("/echo", echo, lambda request: request.text)
        node.serve("/named", "std_srvs/Trigger", lambda request: (True, "named"))
        result = node.call("/echo", echo, "hello").text, node.call("/named", "std_srvs/Trigger").message
    """) == ["hello", "named"]
