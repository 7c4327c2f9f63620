"""What a launch file brings up is waited for, and what roslaunch says is told in one line."""

from __future__ import annotations

import os

import pytest

from course_pkg.examiner.launched import becomes, telling_line
from course_pkg.examiner.scripted import closed_port
from course_pkg.graph import PrivateMaster


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
def test_the_line_that_tells_of_the_error_is_told(printed: str, told: str) -> None:
    """Without the colours of a terminal, and without the folder of this machine."""
    assert telling_line(printed) == told


def test_a_graph_becomes_what_is_waited_for(master: PrivateMaster) -> None:
    """The condition sees the graph of that master, and the wait ends with it, or with its time."""
    assert becomes(master.uri, lambda seen: seen.services is not None, within=10.0)
    assert not becomes(master.uri, lambda seen: seen.service("/nobody"), within=0.2)


def test_a_master_that_is_not_there_yet_is_waited_for() -> None:
    """It is no error: roslaunch starts one."""
    assert not becomes(f"http://localhost:{closed_port()}", lambda _: True, within=0.2)
