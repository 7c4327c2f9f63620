"""Tests of the class Stage, which causes a fault on the graph and removes the fault later."""

from __future__ import annotations

import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from course_pkg.errors import MasterUnreachable, NodeFailed, UnknownFault
from course_pkg.faults import TOOLS, Stage, caused, named, probe
from course_pkg.faults.catalogue import every_fault, select
from course_pkg.ros import MasterClient, PrivateMaster
from course_pkg.ros.process.supervisor import descendants
from tests.kernel import Kernel
from tests.support import eventually, process_state

CAUSE = """
from course_pkg.faults import Stage, named
stages = [Stage(named(name)) for name in {names!r}]
for stage in stages:
    stage.cause()
result = [str(stage._resources.folder) for stage in stages]
"""


def nodes(master: PrivateMaster) -> list[str]:
    """Return all nodes with a name that begins with /lab."""
    return [node for node in MasterClient(master.uri).system_state().nodes if node.startswith("/lab")]


@pytest.mark.parametrize("name", ["stale", "stopped", "hung_master", "two_providers"])
def test_a_killed_kernel_leaves_nothing(master: PrivateMaster, kernel: Kernel, name: str) -> None:
    """If the kernel that caused a fault is killed, the fault's processes, nodes and folder disappear."""
    (folder,) = kernel.run(CAUSE.format(names=[name]))
    pids = descendants(kernel.pid)
    assert pids
    kernel.kill()
    eventually(lambda: all(process_state(pid) == "Z" for pid in pids))
    eventually(lambda: not nodes(master))
    eventually(lambda: not Path(folder).exists())


def test_a_kernel_that_ends_undoes_its_case(master: PrivateMaster, kernel: Kernel) -> None:
    """When a kernel that caused a fault exits, the nodes of the fault exit too."""
    kernel.run(CAUSE.format(names=["stale"]))
    assert nodes(master)
    kernel.exit()
    assert not nodes(master)


def test_a_case_that_cannot_be_set_up_is_undone(master: PrivateMaster) -> None:
    """If the server of a fault does not start, cause() raises NodeFailed, and no node remains."""

    def play(stage: Stage) -> None:
        stage.serve("raise SystemExit(3)")

    stage = Stage(replace(named("stale"), play=play))
    with pytest.raises(NodeFailed, match="could not be set up"):
        stage.cause()
    assert not nodes(master)


def test_a_stage_needs_a_master(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a master, the class Stage raises MasterUnreachable."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    with pytest.raises(MasterUnreachable, match="No ROS master"):
        Stage(named("stale"))


def test_a_second_undo_changes_nothing(master: PrivateMaster) -> None:
    """A second call of `undo` raises no error."""
    stage = Stage(named("returns_none"))
    stage.cause()
    stage.undo()
    stage.undo()
    assert not nodes(master)


def test_a_fault_can_be_repaired_by_hand(master: PrivateMaster) -> None:
    """A server that was suspended with SIGSTOP responds again after SIGCONT."""
    assert master.uri
    with caused("stopped") as stage:
        assert stage.keeper is not None
        stage.keeper.signal(signal.SIGCONT)
        assert "open" in probe(stage, "again").said


def test_the_tools_show_the_real_state(master: PrivateMaster) -> None:
    """After a server was killed, the output of each diagnosis tool shows the real state of the graph."""
    assert master.uri
    with caused("stale") as stage:
        said = {tool: probe(stage, tool).said for tool in TOOLS if tool != "again"}
        assert "/lab/door" in said["services"]
        assert "/lab/keeper" in said["nodes"]
        assert "Unable to communicate with service" in said["info"] or "/lab/keeper" in said["info"]
        assert "connection refused" in said["ping"]
        assert "Its process has ended." in said["output"]
        assert "Unregistering service /lab/door of /lab/keeper" in said["cleanup"]
        assert "unavailable" in probe(stage, "again").said


def test_names_and_groups_are_found() -> None:
    """Faults are selected by name or by group, and an unknown name raises an error."""
    assert select() == every_fault()
    assert [each.name for each in select("stale", "stopped")] == ["stale", "stopped"]
    assert {each.group for each in select("serving")} == {"serving"}
    with pytest.raises(UnknownFault, match=r"No fault has the name 'rust'.*serving.*stale"):
        named("rust")
    with pytest.raises(UnknownFault, match="group"):
        named("calling")


def test_the_texts_of_each_fault_are_unique() -> None:
    """The names, diagnoses and reasons of all faults are unique. Each text ends with a full stop."""
    faults = every_fault()
    for texts in (
        [each.name for each in faults],
        [each.diagnosis for each in faults],
        [each.reason for each in faults],
    ):
        assert len(set(texts)) == len(faults)
    assert all(text.endswith(".") for each in faults for text in (each.diagnosis, each.remedy, each.reason))
    known = {each.name for each in faults}
    assert all(set(each.unlike) <= known for each in faults)


def test_a_fault_needs_no_rospy_in_the_kernel() -> None:
    """The package course_pkg.faults does not import rospy."""
    code = "import sys, course_pkg.faults as f; f.caused, f.probe, f.names(); print('rospy' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=30, check=True
    )
    assert done.stdout.strip() == "False"
