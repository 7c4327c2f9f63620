"""Tests of how a check waits for a launch file and reads the output of roslaunch."""

from __future__ import annotations

import os

import pytest

from course_pkg.checking.commands.folder import becomes, telling_line
from course_pkg.checking.peers.node import closed_port
from course_pkg.ros import PrivateMaster


@pytest.mark.parametrize(
    ("printed", "told"),
    [
        ("started\nERROR: cannot launch node\nprocess ended\n", "ERROR: cannot launch node"),
        ("\x1b[31mValue error: yes is not a 'bool' type\x1b[0m\n", "Value error: yes is not a 'bool' type"),
        ("one\n\ntwo\n\n", "two"),
        ("", "nothing"),
        (f"{os.getcwd()}/my.launch: Invalid\n", "/my.launch: Invalid"),
    ],
)
def test_line_with_the_error_is_found(printed: str, told: str) -> None:
    """telling_line() returns the line with the error, without colour codes and the working folder's path."""
    assert telling_line(printed) == told


def test_wait_for_a_graph_ends(master: PrivateMaster) -> None:
    """The wait ends when the ROS graph meets the condition, or after the timeout."""
    assert becomes(master.uri, lambda actual: actual.services is not None, within=10.0)
    assert not becomes(master.uri, lambda actual: actual.service("/nobody"), within=0.2)


def test_master_may_start_during_the_wait() -> None:
    """If roslaunch has not started the master yet, the check waits for the master."""
    assert not becomes(f"http://localhost:{closed_port()}", lambda _: True, within=0.2)
