"""Tests of snapshots, which list the nodes, topics and services of a graph."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator

import pytest

from course_pkg.errors import MasterUnreachable
from course_pkg.ros import MasterClient, NodeProcess, PrivateMaster, look, remove_stale
from tests.support import stopped


@pytest.fixture
def server(master: PrivateMaster) -> Iterator[NodeProcess]:
    """Run the course's server."""
    with NodeProcess.rosrun("course_pkg", "server") as process:
        process.wait_for_service("/getGeometry")
        yield process
    remove_stale()


def test_contents_of_a_snapshot(server: NodeProcess) -> None:
    """A snapshot lists nodes, topics and services, and can be written as JSON."""
    with NodeProcess.rosrun("course_pkg", "pulse") as pulse:
        pulse.wait_for_service("/pulse/get_loggers")
        seen = look()
    assert [node.name for node in seen.nodes] == ["/SERVER_NODE", "/pulse"]
    assert all(node.reachable for node in seen.nodes)
    service = seen.service("/getGeometry")
    assert service is not None
    assert (service.type, service.node, service.reachable) == ("course_pkg/geometry", "/SERVER_NODE", True)
    topics = {topic.name: topic for topic in seen.topics}
    assert topics["/pulse"].type == "std_msgs/UInt32"
    assert topics["/rosout"].publishers == ("/SERVER_NODE", "/pulse")
    assert [service.name for service in seen.services] == sorted(service.name for service in seen.services)
    assert json.loads(json.dumps(seen.as_dict()))["services"][1]["name"] == "/SERVER_NODE/set_logger_level"


def test_equal_snapshots_of_the_same_graph(server: NodeProcess) -> None:
    """Two snapshots of an unchanged graph are equal."""
    before = look()
    assert (look(), hash(look())) == (before, hash(before))
    MasterClient(before.master).register_service(
        "/more", "/more", "rosrpc://localhost:1", "http://localhost:1/"
    )
    assert look() != before
    remove_stale()


def test_stopped_node_is_silent_and_costs_half_a_second(server: NodeProcess) -> None:
    """If a node is suspended with SIGSTOP, a snapshot lists this node as silent.

    remove_stale() does not remove the registrations of a suspended node.
    """
    with stopped(server.pid):
        started = time.monotonic()
        seen = look()
        assert time.monotonic() - started < 2
        node, service = seen.node("/SERVER_NODE"), seen.service("/getGeometry")
        assert node is not None
        assert service is not None
        assert (node.reach, service.reach, service.type) == ("silent", "silent", "")
        assert remove_stale() == []
    assert all(node.reachable for node in look().nodes)


def test_killed_node_is_stale_until_removed(server: NodeProcess) -> None:
    """remove_stale() unregisters a killed node, but not a running node."""
    with NodeProcess.rosrun("course_pkg", "pulse") as pulse:
        pulse.wait_for_service("/pulse/get_loggers")
        server.kill()
        assert server.returncode == -9
        seen = look().node("/SERVER_NODE")
        assert seen is not None
        assert seen.reach == "refused"
        assert remove_stale(nodes=frozenset({"/other"})) == []
        stale = remove_stale()
        assert [(entry.kind, entry.name) for entry in stale] == [
            ("publisher", "/rosout"),
            ("service", "/SERVER_NODE/get_loggers"),
            ("service", "/SERVER_NODE/set_logger_level"),
            ("service", "/getGeometry"),
        ]
        assert {entry.node for entry in stale} == {"/SERVER_NODE"}
        assert remove_stale() == []
        assert [node.name for node in look().nodes] == ["/pulse"]


def test_no_master() -> None:
    """Without a master, look() raises MasterUnreachable."""
    with pytest.raises(MasterUnreachable):
        look("http://localhost:1")
