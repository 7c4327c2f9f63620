"""Tests of the `course` script."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SUBCOMMANDS = (
    *(
        "lab",
        "run",
        "test",
        "sync",
        "grade",
        "grade-one",
        "points",
        "review",
        "release",
        "collect",
        "install",
        "uninstall",
        "bundle",
        "completion",
        "progress",
        "site",
        "doctor",
    ),
    "lock",
)


def course(*words: str, cwd: Path = ROOT, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run `course` with the arguments `words`; `variables` are additional environment variables."""
    env = {**os.environ, "ROS_MASTER_URI": "http://localhost:9", **variables}
    return subprocess.run([ROOT / "course", *words], cwd=cwd, env=env, capture_output=True, text=True)


@pytest.fixture
def nowhere(tmp_path: Path) -> dict[str, str]:
    """Return an environment variable that selects a cache folder which cannot be created."""
    (tmp_path / "file").write_text("")
    return {"XDG_CACHE_HOME": str(tmp_path / "file")}


@pytest.mark.parametrize("name", SUBCOMMANDS)
def test_help_comes_before_anything_is_installed(name: str, nowhere: dict[str, str]) -> None:
    """`course COMMAND --help` works before the set-up has run."""
    answer = course(name, "--help", **nowhere)
    assert answer.returncode == 0, answer.stderr
    assert answer.stdout.startswith(f"usage: course {name}")
    assert f"\n    {name}" in course("--help", **nowhere).stdout


@pytest.mark.parametrize(("words", "seen"), [(["fly"], "invalid choice: 'fly'"), ([], "COMMAND")])
def test_an_unknown_command_is_refused_at_once(words: list[str], seen: str, nowhere: dict[str, str]) -> None:
    """If a command is unknown, the exit status is 2, and no set-up starts."""
    answer = course(*words, **nowhere)
    assert answer.returncode == 2
    assert seen in answer.stderr


def test_a_cache_that_cannot_be_made_is_one_clear_message(nowhere: dict[str, str]) -> None:
    """If the cache cannot be created, the error message is one line and names the environment variable."""
    answer = course("run", "true", **nowhere)
    assert answer.returncode == 1
    assert answer.stderr.count("\n") == 1
    assert "Set XDG_CACHE_HOME to a folder that you can write to" in answer.stderr


def test_a_space_in_the_name_of_the_cache_is_one_clear_message(tmp_path: Path) -> None:
    """If the cache path contains a space, the error message is one line."""
    answer = course("run", "true", XDG_CACHE_HOME=str(tmp_path / "a b"))
    assert (answer.returncode, answer.stderr.count("\n")) == (1, 1)
    assert "catkin cannot build in" in answer.stderr


def test_another_python_first_on_path_does_not_matter(tmp_path: Path) -> None:
    """The course uses its own Python, even if the user's python3 does not work."""
    for name in ("python3", "python", "rosservice"):
        (tmp_path / name).write_text("#!/bin/sh\nexit 66\n")
        (tmp_path / name).chmod(0o755)
    (tmp_path / "json.py").write_text("raise SystemExit(67)\n")
    path = f"{tmp_path}:{os.environ['PATH']}"
    answer = course(
        *("run", "python3", "-c", "import json, sys, rospy; print(sys.prefix != sys.base_prefix)"),
        PATH=path,
        PYTHONPATH=str(tmp_path),
        PYTHONHOME=str(tmp_path),
    )
    assert (answer.returncode, answer.stdout) == (0, "True\n"), answer.stderr
    assert "rosservice call -h" in course("run", "rosservice", PATH=path).stdout


def test_it_runs_from_anywhere_and_through_a_link(tmp_path: Path) -> None:
    """A command runs in the current folder; a link to the script `course` also works."""
    assert course("run", "pwd", cwd=tmp_path).stdout == f"{tmp_path}\n"
    link = tmp_path / "my course"
    link.symlink_to(ROOT / "course")
    answer = subprocess.run([link, "--help"], capture_output=True, text=True)
    assert answer.returncode == 0, answer.stderr


def test_a_second_start_sets_nothing_up() -> None:
    """After the set-up, `course run` prints only the output of the command."""
    course("run", "true")
    answer = course("run", "echo", "it")
    assert (answer.stdout, answer.stderr) == ("it\n", "")


def test_doctor_reports_no_problem_on_this_machine() -> None:
    """If `course doctor` finds no problem, its exit status is 0."""
    answer = course("doctor", ROS_MASTER_URI="")
    assert answer.returncode == 0, answer.stdout
    assert "to do" not in answer.stdout
    answer = course("doctor", ROS_MASTER_URI="localhost:11311")
    assert answer.returncode == 1
    assert "Set ROS_MASTER_URI to an address such as http://localhost:11311" in answer.stdout
