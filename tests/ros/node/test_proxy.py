"""Tests of calls that would never end in plain rospy, but end at a time limit with the course's proxy."""

from __future__ import annotations

import os
import socket
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from course_pkg.ros import MasterClient, PrivateMaster
from course_pkg.ros.node import watchdog
from course_pkg.ros.node.watchdog import Watchdog
from course_pkg.ros.process.node_process import NodeProcess
from tests.kernel import Kernel
from tests.support import eventually, stopped

CALL = """
from std_srvs.srv import Trigger
node.call({name!r}, Trigger, timeout=0.5)
"""
LONGEST = 2.0  # On a busy machine, a call with a timeout of 0.5 s is allowed to take this time in s.

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
    """Run a node that uses only rospy."""
    with NodeProcess([sys.executable, "-c", RAW_SERVER]) as process:
        process.wait_for_service("/raw/well")
        yield process


@pytest.fixture
def joined(kernel: Kernel) -> Kernel:
    """Return a kernel that runs a node."""
    kernel.run("from course_pkg.ros import BoundedProxy, join; node = join('caller')")
    return kernel


@contextmanager
def listening(accept: bool = True) -> Iterator[int]:
    """Yield the port of a server that never sends any data.

    If `accept` is false, the server accepts no connections.
    """
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        listener.listen(0)
        held = []
        # The connection queue is full, so a new connection gets no response to its SYN packet.
        if not accept:
            for _ in range(4):
                held.append(socket.socket())
                held[-1].setblocking(False)
                held[-1].connect_ex(listener.getsockname())
        yield listener.getsockname()[1]
        for sock in held:
            sock.close()


@contextmanager
def registered(name: str, uri: str) -> Iterator[None]:
    """Register an address for a service; no node offers this service."""
    master = MasterClient(os.environ["ROS_MASTER_URI"])
    master.register_service("/pretender", name, uri, "http://localhost:1/")
    yield
    master.unregister_service("/pretender", name, uri)


def times_out(kernel: Kernel, name: str) -> str:
    """Assert that a call in the kernel raises CallTimeout in time; return the message of CallTimeout."""
    reply = kernel.ask(CALL.format(name=name), timeout=20)
    assert reply.error == "CallTimeout", reply
    assert 0.5 <= reply.took < LONGEST
    return reply.words


@pytest.mark.parametrize("name", ["/raw/sleeps", "/raw/exits"])
def test_handler_that_never_answers(joined: Kernel, raw: NodeProcess, name: str) -> None:
    """If the handler never returns, the call times out, and calls of other services work."""
    assert "its handler is still working" in times_out(joined, name)
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


def test_stopped_server(joined: Kernel, raw: NodeProcess) -> None:
    """A call to a server that is suspended with SIGSTOP times out. After SIGCONT, calls work again."""
    with stopped(raw.pid):
        assert "but sends nothing" in times_out(joined, "/raw/well")
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


def test_idle_connection_blocks_a_plain_server(joined: Kernel, raw: NodeProcess) -> None:
    """If an idle connection blocks a plain rospy server, a call to this server times out."""
    uri = MasterClient(os.environ["ROS_MASTER_URI"]).lookup_service("/raw/well")
    assert uri is not None
    with socket.create_connection(("localhost", int(uri.rpartition(":")[2]))):
        times_out(joined, "/raw/well")
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


def test_stopped_master(joined: Kernel, raw: NodeProcess, master: PrivateMaster) -> None:
    """If the master is suspended with SIGSTOP, the error message is about the master."""
    with stopped(master.pid):
        assert "the master" in times_out(joined, "/raw/well")
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


@pytest.mark.parametrize("accept", [True, False], ids=["accepts", "does not even accept"])
def test_silent_address(joined: Kernel, accept: bool) -> None:
    """If the server's address does not respond, the call times out."""
    with listening(accept) as port, registered("/mute", f"rosrpc://localhost:{port}"):
        times_out(joined, "/mute")


def test_server_ends_during_the_call(joined: Kernel, raw: NodeProcess) -> None:
    """If the server exits during the call, the call raises rospy's error immediately."""
    reply = joined.ask("from std_srvs.srv import Trigger\nnode.call('/raw/dies', Trigger, timeout=20)")
    assert reply.error == "ServiceException"
    assert reply.words.startswith(
        "transport error completing service call: unable to receive data from sender"
    )
    assert reply.took < LONGEST


def test_killed_server(joined: Kernel, raw: NodeProcess) -> None:
    """A call to a killed server raises rospy's connection error."""
    raw.kill()
    reply = joined.ask("from std_srvs.srv import Trigger\nnode.call('/raw/well', Trigger)")
    assert (reply.error, reply.words) == (
        "ServiceException",
        "unable to connect to service: [Errno 111] Connection refused",
    )


def test_no_such_service(joined: Kernel) -> None:
    """A call to an unknown service raises rospy's error."""
    reply = joined.ask("from std_srvs.srv import Trigger\nnode.call('/nope', Trigger)")
    assert (reply.error, reply.words) == ("ServiceException", "service [/nope] unavailable")


def test_cancel_from_another_thread(joined: Kernel, raw: NodeProcess) -> None:
    """Another thread can cancel a running call."""
    reply = joined.ask("""
        import threading
        from std_srvs.srv import Trigger
        proxy = BoundedProxy("/raw/sleeps", Trigger, timeout=20)
        threading.Timer(0.3, proxy.cancel).start()
        proxy()
    """)
    assert reply.error == "CallCancelled"
    assert reply.took < LONGEST
    assert joined.ask("proxy.call(timeout=0.2)").error == "CallTimeout"


def test_interrupt_of_a_call(joined: Kernel, raw: NodeProcess) -> None:
    """An interrupt of the cell ends its call, and the node still works."""
    joined.begin("from std_srvs.srv import Trigger\nnode.call('/raw/sleeps', Trigger, timeout=20)")
    eventually(lambda: "sleeping" in raw.output())
    joined.interrupt()
    reply = joined.reply()
    assert reply.error == "KeyboardInterrupt"
    assert joined.run("result = node.call('/raw/well', Trigger).message") == "well"


def test_persistent_proxy_survives_its_server(joined: Kernel) -> None:
    """If the server of a service is replaced, a persistent proxy connects to the new server."""
    joined.run(
        "from std_srvs.srv import Trigger; proxy = BoundedProxy('/raw/well', Trigger, persistent=True)"
    )
    for _ in range(2):
        with NodeProcess([sys.executable, "-c", RAW_SERVER]) as process:
            process.wait_for_service("/raw/well")
            assert joined.run("result = [proxy().message for _ in range(3)]") == ["well"] * 3


def test_persistent_call_times_out_and_recovers(joined: Kernel, raw: NodeProcess) -> None:
    """After a call has timed out, a persistent proxy uses a new connection."""
    joined.run(
        "from std_srvs.srv import Trigger; proxy = BoundedProxy('/raw/well', Trigger, persistent=True)"
    )
    joined.run("proxy()")
    with stopped(raw.pid):
        reply = joined.ask("proxy.call(timeout=0.5)")
        assert reply.error == "CallTimeout"
        assert reply.took < LONGEST
    assert joined.run("result = proxy().message") == "well"


@contextmanager
def switching_often() -> Iterator[None]:
    """Make Python switch threads very often, so that race conditions become more likely."""
    kept = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        yield
    finally:
        sys.setswitchinterval(kept)


def watching() -> list[threading.Thread]:
    """Return all threads of watchdogs; a watchdog runs actions at their deadlines."""
    return [thread for thread in threading.enumerate() if thread.name == "call-watchdog"]


def test_an_action_is_repeated_until_it_is_disarmed() -> None:
    """After its deadline, an action of the watchdog runs repeatedly until disarm() is called."""
    guard, done = Watchdog(), list[float]()
    number = guard.arm(time.monotonic(), lambda: done.append(time.monotonic()))
    eventually(lambda: len(done) >= 3)
    guard.disarm(number)
    _round(guard)
    counted = len(done)
    _round(guard)
    assert len(done) == counted


def _round(guard: Watchdog) -> None:
    """Give an action to the watchdog, and wait until the watchdog has run the action."""
    told = threading.Event()
    number = guard.arm(time.monotonic(), told.set)
    assert told.wait(5)
    guard.disarm(number)


def test_no_thread_is_left_when_nothing_is_armed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The watchdog's thread ends when the watchdog has no action; the next action starts a new thread."""
    monkeypatch.setattr(watchdog, "LINGER", 0.05)
    before = set(watching())
    guard = Watchdog()
    for _ in range(2):
        guard.disarm(guard.arm(time.monotonic() + 60, lambda: None))
        assert set(watching()) - before
        eventually(lambda: not set(watching()) - before)
    rung = threading.Event()
    guard.arm(time.monotonic() + 0.01, rung.set)
    assert rung.wait(5)


def test_no_deadline_is_missed_when_the_thread_ends_and_starts(monkeypatch: pytest.MonkeyPatch) -> None:
    """An action of the watchdog is called in time, even if the watchdog's thread ends at the same moment."""
    monkeypatch.setattr(watchdog, "LINGER", 0.0005)
    guard, missed = Watchdog(), list[int]()

    def caller() -> None:
        for turn in range(150):
            rung = threading.Event()
            number = guard.arm(time.monotonic() + turn % 7 * 0.0003, rung.set)
            if not rung.wait(5):
                missed.append(turn)
            guard.disarm(number)

    with switching_often():
        callers = [threading.Thread(target=caller) for _ in range(4)]
        for thread in callers:
            thread.start()
        for thread in callers:
            thread.join(60)
    assert missed == []
