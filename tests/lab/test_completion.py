"""Tests of the Tab key in a terminal."""

from __future__ import annotations

from pathlib import Path

from tests.lab.test_bashrc import shell

SWITCH = (
    "rosrun course_pkg switch >/dev/null 2>&1 & until rosservice list | grep -q /switch/reset; do :; done"
)
TAB = "\t"


def test_tab_completes_services_and_requests(tmp_path: Path) -> None:
    """The Tab key completes the name of a service, and then the request."""
    lines = [SWITCH, f"rosservice call /sw{TAB}rep{TAB}", f"rosservice call /switch/set {TAB}", "kill %1"]
    seen = shell(tmp_path, "\n".join(lines))
    assert 'message: "closed"' in seen  # This text is the response of /switch/report.
    assert '/switch/set "data: false"' in seen
    assert 'message: "already closed"' in seen
