"""Tests of commands that start, join and leave ROS graphs."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.errors import GraphError
from course_pkg.lab.graph.graph import Graph, Which, join_or_start
from course_pkg.lab.graph.network import entering
from course_pkg.lab.graph.notes import EXPOSED, notes
from course_pkg.ros.process.supervisor import descendants
from tests.lab.commands import all_gone, having, own_namespace
from tests.lab.test_run import course_run
from tests.support import eventually, terminal

URI = "http://localhost:11311"
SHOW = "echo $ROS_MASTER_URI; readlink /proc/self/ns/net; rosnode list"


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Graph]:
    """Start a graph in a private network, or skip the test if this machine does not allow such networks."""
    started = join_or_start(Which.RUNNING, tmp_path)
    try:
        if started.reason:
            pytest.skip(started.reason)
        started.wait_for_master()
        yield started
    finally:
        started.leave()


def nodes(graph: Graph) -> list[str]:
    """Return the nodes of a graph."""
    return terminal(*entering(graph.files), "rosnode", "list", ROS_MASTER_URI=graph.uri).stdout.split()


def sockets(folder: Path) -> list[str]:
    """Return the names of the Unix sockets with which a command can join a graph."""
    return [path.name for path in folder.iterdir() if path.is_socket()]


def test_the_master_has_the_usual_port_on_each_graph(graph: Graph, tmp_path: Path) -> None:
    """Two ROS graphs have separate networks, so both masters can use port 11311 at the same time."""
    other = join_or_start(Which.ALONE, tmp_path)
    other.wait_for_master()
    assert graph.uri == other.uri == URI
    assert nodes(graph) == nodes(other) == ["/rosout"]
    command = [*entering(other.files), "env", f"ROS_MASTER_URI={URI}", "rosparam", "set", "/here", "1"]
    assert terminal(*command).returncode == 0
    listed = [
        terminal(*entering(each.files), "rosparam", "list", ROS_MASTER_URI=URI).stdout
        for each in (graph, other)
    ]
    assert ["/here" in text for text in listed] == [False, True]
    other.leave()


def test_a_graph_ends_with_its_last_command(graph: Graph, tmp_path: Path) -> None:
    """A second command joins the graph that the first command has started.

    When the first command exits, the graph still runs. When the last command exits, the graph ends.
    """
    second = join_or_start(Which.RUNNING, tmp_path)
    second.wait_for_master()
    processes = of_graphs(tmp_path)
    assert processes
    graph.leave()
    assert nodes(second) == ["/rosout"]
    second.leave()
    assert all_gone(processes)
    assert sockets(tmp_path) == []


def test_a_graph_of_its_own_is_not_joined(graph: Graph, tmp_path: Path) -> None:
    """A later command does not join a graph that was started with --new-graph."""
    alone = join_or_start(Which.ALONE, tmp_path)
    later = join_or_start(Which.RUNNING, tmp_path)
    names = [os.fstat(each.files[-1]).st_ino for each in (graph, alone, later)]
    assert names[0] == names[2] != names[1]
    alone.leave()
    later.leave()


def test_a_killed_holder_leaves_nothing(graph: Graph, tmp_path: Path) -> None:
    """If the process that keeps a graph's network is killed with SIGKILL, the master of the graph ends.

    When the next command starts or ends, it removes the socket file of the killed process.
    """
    processes = of_graphs(tmp_path)
    os.kill(processes[0], signal.SIGKILL)
    assert all_gone(processes)
    assert len(sockets(tmp_path)) == 1  # the socket of the killed process; it accepts no connections
    later = join_or_start(Which.RUNNING, tmp_path)
    later.wait_for_master()
    assert nodes(later) == ["/rosout"]
    os.kill(of_graphs(tmp_path)[0], signal.SIGKILL)
    later.leave()
    assert sockets(tmp_path) == []


def test_without_namespaces_the_graph_is_in_the_machines_network(tmp_path: Path) -> None:
    """If namespaces are forbidden, the master uses a free port of the machine, and a note says this."""
    with pytest.MonkeyPatch.context() as patch:
        (tmp_path / "rosmaster").write_text('#!/bin/sh\nexec /usr/bin/rosmaster "$@"\n')
        (tmp_path / "rosmaster").chmod(0o755)
        patch.setenv("PATH", str(tmp_path))  # This folder contains no program nsenter.
        graph = join_or_start(Which.RUNNING, tmp_path)
    assert "nsenter" in graph.reason
    assert graph.files == []
    assert graph.uri != URI
    with pytest.raises(GraphError):  # PATH does not contain the programs of ROS.
        graph.wait_for_master()
    assert EXPOSED in notes(graph, Which.RUNNING)
    graph.leave()


def test_a_shared_graph_is_in_the_machines_network() -> None:
    """With --shared-graph, the command runs in this machine's network, and the master uses a free port."""
    uri, network, node = course_run("--shared-graph", "sh", "-c", SHOW).stdout.split()
    assert (network, node) == (own_namespace("net"), "/rosout")
    assert uri != URI


def test_a_command_in_a_graph_stays_in_it(graph: Graph) -> None:
    """`course run` inside `course run bash` uses the same network and master.

    With --new-graph, a `course run` inside `course run bash` uses a new network and a new master.
    """
    script = f"{SHOW}; ./course run sh -c '{SHOW}'; ./course run --new-graph sh -c '{SHOW}'"
    seen = course_run("sh", "-c", script).stdout.split()
    assert seen[::3] == [URI] * 3
    assert seen[1] == seen[4] != seen[7]
    assert own_namespace("net") not in seen


def of_graphs(folder: Path) -> list[int]:
    """Return the process that keeps the graph's private network, and the descendants of this process."""
    [holder] = eventually(lambda: having(b"holder.py\0", descendants(os.getpid())))[:1]
    return [holder, *descendants(holder)]
