"""Tests of the shell in `course run bash` and in JupyterLab's terminals."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.lab.commands import ROOT, user_environment

HOSTILE = """
export PATH=$HOME/shims:$PATH PYTHONPATH=/nowhere ROS_MASTER_URI=http://robot:11311 ROS_IP=10.0.0.1
alias mine='echo my alias'
PS1='mine> '
"""


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """Create a home folder; its ~/.bashrc selects another Python and another master, and defines an alias."""
    (tmp_path / ".bashrc").write_text(HOSTILE)
    (tmp_path / "shims").mkdir()
    for name in ("python3", "rosservice"):
        (tmp_path / "shims" / name).write_text("#!/bin/sh\necho shim\n")
        (tmp_path / "shims" / name).chmod(0o755)
    return tmp_path


def shell(home: Path, commands: str) -> str:
    """Type commands into an interactive shell, and return the output."""
    cache = {"XDG_CACHE_HOME": user_environment().get("XDG_CACHE_HOME", str(Path("~/.cache").expanduser()))}
    typed = ["script", "-qec", f"{ROOT / 'course'} run bash", "/dev/null"]
    answer = subprocess.run(
        typed,
        env={**user_environment(), **cache, "HOME": str(home), "TERM": "dumb"},
        input=f"{commands}\nexit 0\n",
        capture_output=True,
        text=True,
        timeout=60,
    )
    return answer.stdout


def test_the_course_overrides_the_settings_in_bashrc(home: Path) -> None:
    """The shell uses the course's Python, tools and master, but also the aliases of the user."""
    look = "echo py:$(python3 -c 'print(3)') uri:$ROS_MASTER_URI ip:${ROS_IP-none}"
    seen = shell(home, f"{look}; mine; rosservice list")
    assert "py:3 uri:http://localhost:" in seen
    assert "ip:none" in seen
    assert "my alias" in seen
    assert "(course) mine>" in seen
    assert "shim" not in seen.replace("/shims", "")


def test_tab_completes_the_tools_of_ros(home: Path) -> None:
    """The Tab key completes the arguments of rosrun and rosservice."""
    tab = "COMP_WORDS=(rosrun course_p) COMP_CWORD=1; _roscomplete_exe; echo found:${COMPREPLY[*]}"
    seen = shell(home, f"complete -p rosrun rosservice rossrv roslaunch; {tab}")
    for tool in ("rosrun", "rosservice", "rossrv", "roslaunch"):
        assert f" {tool}\n" in seen, seen
    assert "found:course_pkg" in seen
