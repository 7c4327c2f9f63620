"""Every call that hangs in bare rospy ends here, with its own words, within its deadline."""

from __future__ import annotations

import os
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from course_pkg.graph import MasterClient, PrivateMaster
from course_pkg.graph.processes import NodeProcess
from tests.kernel import Kernel
from tests.support import eventually, stopped

CALL = """
from std_srvs.srv import Trigger
node.call({name!r}, Trigger, timeout=0.5)
"""
LONGEST = 2.0  # s; the deadline is 0.5 s, and the machine may be busy

RAW_SERVER = """
import rospy, sys, threading
from std_srvs.srv import Trigger
rospy.init_node("raw", anonymous=True)
def stop(request):
    print('sleeping')
    threading.Event().wait()
services = [
    rospy.Service("raw/sleeps", Trigger, stop),
    rospy.Service("raw/exits", Trigger, lambda request: sys.exit()),
    rospy.Service("raw/dies", Trigger, lambda request: __import__("os")._exit(1)),
    rospy.Service("raw/well", Trigger, lambda request: (True, "well")),
]
rospy.spin()
"""


@pytest.fixture
def raw() -> Iterator[NodeProcess]:
    """A node of plain rospy, with nothing of the course in it."""
    with NodeProcess([sys.executable, "-c", RAW_SERVER]) as process:
        process.wait_for_service("/raw/well")
        yield process


@pytest.fixture
def joined(kernel: Kernel) -> Kernel:
    """A kernel that is a node."""
    kernel.run("from course_pkg.graph import join; node = join('caller')")
    return kernel


@contextmanager
def listening(accept: bool = True) -> Iterator[int]:
    """A port where somebody takes connections, or not even that, and never says anything."""
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        listener.listen(0)
        held = []
        if not accept:  # a full queue of connections: further ones get no answer to their SYN
            for _ in range(4):
                held.append(socket.socket())
                held[-1].setblocking(False)
                held[-1].connect_ex(listener.getsockname())
        yield listener.getsockname()[1]
        for sock in held:
            sock.close()


@contextmanager
def registered(name: str, uri: str) -> Iterator[None]:
    """An entry at the master for a service that no node of ROS serves."""
    master = MasterClient(os.environ["ROS_MASTER_URI"])
    master.register_service("/pretender", name, uri, "http://localhost:1/")
    yield
    master.unregister_service("/pretender", name, uri)


def times_out(kernel: Kernel, name: str) -> str:
    """Call from the kernel; hold the deadline, and that the kernel is well afterwards; return the words."""
    reply = kernel.ask(CALL.format(name=name), patience=20)
    assert reply.error == "CallTimeout", reply
    assert 0.5 <= reply.took < LONGEST
    return reply.words


@pytest.mark.parametrize("name", ["/raw/sleeps", "/raw/exits"])
def test_handler_without_end(joined: Kernel, raw: NodeProcess, name: str) -> None:
    """A handler that never returns, or that ended by sys.exit, costs its caller the deadline and no more."""
    assert "its handler is still working" in times_out(joined, name)
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


def test_stopped_server(joined: Kernel, raw: NodeProcess) -> None:
    """A stopped server takes connections and does not speak; once it goes on, calls do too."""
    with stopped(raw.pid):
        assert "does not speak" in times_out(joined, "/raw/well")
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


def test_idle_connection_hogs_a_plain_server(joined: Kernel, raw: NodeProcess) -> None:
    """A server of plain rospy, blocked by an idle connection, does not block its caller."""
    uri = MasterClient(os.environ["ROS_MASTER_URI"]).lookup_service("/raw/well")
    assert uri is not None
    with socket.create_connection(("localhost", int(uri.rpartition(":")[2]))):
        times_out(joined, "/raw/well")
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


def test_stopped_master(joined: Kernel, raw: NodeProcess, master: PrivateMaster) -> None:
    """A stopped master is told from a stopped server."""
    with stopped(master.pid):
        assert "the master" in times_out(joined, "/raw/well")
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


@pytest.mark.parametrize("accept", [True, False], ids=["accepts", "does not even accept"])
def test_mute_address(joined: Kernel, accept: bool) -> None:
    """An address where nobody speaks, or where packets vanish, costs the deadline."""
    with listening(accept) as port, registered("/mute", f"rosrpc://localhost:{port}"):
        times_out(joined, "/mute")


def test_server_ends_during_the_call(joined: Kernel, raw: NodeProcess) -> None:
    """A server that vanishes during the call is an error at once, in rospy's words."""
    reply = joined.ask("from std_srvs.srv import Trigger\nnode.call('/raw/dies', Trigger, timeout=20)")
    assert reply.error == "ServiceException"
    assert reply.words.startswith(
        "transport error completing service call: unable to receive data from sender"
    )
    assert reply.took < LONGEST


def test_dead_server(joined: Kernel, raw: NodeProcess) -> None:
    """A killed server leaves its entry, and a call says what rospy says of that."""
    raw.kill()
    reply = joined.ask("from std_srvs.srv import Trigger\nnode.call('/raw/well', Trigger)")
    assert (reply.error, reply.words) == (
        "ServiceException",
        "unable to connect to service: [Errno 111] Connection refused",
    )


def test_no_such_service(joined: Kernel) -> None:
    """A name that nobody serves is rospy's error."""
    reply = joined.ask("from std_srvs.srv import Trigger\nnode.call('/nope', Trigger)")
    assert (reply.error, reply.words) == ("ServiceException", "service [/nope] unavailable")


def test_cancel_from_another_thread(joined: Kernel, raw: NodeProcess) -> None:
    """A call under way ends when another thread cancels it, and the proxy can be used again."""
    reply = joined.ask("""
        import threading
        from std_srvs.srv import Trigger
        proxy = node.caller("/raw/sleeps", Trigger, timeout=20)
        threading.Timer(0.3, proxy.cancel).start()
        proxy()
    """)
    assert reply.error == "CallCancelled"
    assert reply.took < LONGEST
    assert joined.ask("proxy.call(timeout=0.2)").error == "CallTimeout"


def test_interrupt_of_a_call(joined: Kernel, raw: NodeProcess) -> None:
    """Interrupting the cell breaks its call off, and the node goes on."""
    joined.begin("from std_srvs.srv import Trigger\nnode.call('/raw/sleeps', Trigger, timeout=20)")
    eventually(lambda: "sleeping" in raw.output())
    joined.interrupt()
    reply = joined.reply()
    assert reply.error == "KeyboardInterrupt"
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


def test_persistent_proxy_survives_its_server(joined: Kernel) -> None:
    """A persistent proxy connects anew after its server was replaced, without an error in between."""
    joined.run("from std_srvs.srv import Trigger; proxy = node.caller('/raw/well', Trigger, persistent=True)")
    for _ in range(2):
        with NodeProcess([sys.executable, "-c", RAW_SERVER]) as process:
            process.wait_for_service("/raw/well")
            assert joined.run("result = [proxy().message for _ in range(3)]") == ["well"] * 3


def test_persistent_call_times_out_and_recovers(joined: Kernel, raw: NodeProcess) -> None:
    """A deadline on a persistent connection closes that connection, and the next call makes another."""
    joined.run("from std_srvs.srv import Trigger; proxy = node.caller('/raw/well', Trigger, persistent=True)")
    joined.run("proxy()")
    with stopped(raw.pid):
        reply = joined.ask("proxy.call(timeout=0.5)")
        assert reply.error == "CallTimeout"
        assert reply.took < LONGEST
    assert joined.run("result = proxy().message") == "well"
