"""Servers count who calls them, and tell it by the interface that every node has."""

from __future__ import annotations

import time

import pytest

from course_pkg.graph import MasterClient, PrivateMaster, service_callers
from course_pkg.graph.callers import Callers
from tests.kernel import Kernel
from tests.support import eventually, stopped

SERVE = """
import threading
import rospy
from std_srvs.srv import Trigger
from course_pkg.graph import join
node = join("server")
done = threading.Event()
raw = rospy.Service("/raw", Trigger, lambda request: (done.wait(20), (True, ""))[1])
node.serve("/served", Trigger, lambda request: (True, ""))
"""
ASK = """
from std_srvs.srv import Trigger
from course_pkg.graph import join
node = join("asker")
for _ in range(3):
    node.call("/served", Trigger)
"""


def ask(master: PrivateMaster, *nodes: str) -> Callers:
    """Ask these nodes who called them."""
    return service_callers(MasterClient(master.uri).lookup_all(nodes, ())[0])


def test_who_called(kernel: Kernel, master: PrivateMaster) -> None:
    """A service has its callers with number and time; one that nobody called has none."""
    kernel.run(SERVE)
    before = time.time()
    with Kernel() as asker:
        asker.run(ASK)
        (caller,) = ask(master, "/server")["/served"]
    assert (caller.node, caller.calls, caller.running) == ("/asker", 3, 0)
    assert before <= caller.last <= time.time()
    assert ask(master, "/server")["/raw"] == ()


def test_who_is_waiting(kernel: Kernel, master: PrivateMaster) -> None:
    """While a handler works, its caller counts as waiting, and no more when it has ended."""
    kernel.run(SERVE)
    with Kernel() as asker:
        asker.run(ASK)
        asker.begin("node.call('/raw', Trigger, timeout=20)")
        (caller,) = eventually(lambda: ask(master, "/server")["/raw"])
        assert (caller.node, caller.running) == ("/asker", 1)
        kernel.run("done.set()")
        asker.reply()
        assert eventually(lambda: ask(master, "/server")["/raw"][0].running == 0)


def test_who_does_not_count(kernel: Kernel, master: PrivateMaster) -> None:
    """Services of a node that keeps no count, or does not answer, are missing, and nothing hangs."""
    kernel.run(SERVE)
    with stopped(kernel.pid):
        began = time.monotonic()
        assert ask(master, "/server") == {}
        assert time.monotonic() - began < 2
    with Kernel() as plain:
        plain.run("import rospy; rospy.init_node('plain', disable_signals=True)")
        assert ask(master, "/plain") == {}


def test_topics_are_told_as_ever(kernel: Kernel) -> None:
    """What getBusStats says of topics is rospy's, and a wrong question is refused as ever."""
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
def test_an_answer_that_is_none(answer: bytes) -> None:
    """What is not an answer by XML-RPC is taken for no answer."""
    from course_pkg.graph.callers import callers_probe, told_callers
    from course_pkg.graph.probe import Reach

    probe = callers_probe("http://localhost:1/")
    probe.answer, probe.reach = answer, Reach.ANSWERED
    assert told_callers(probe) == {}
