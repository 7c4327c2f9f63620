"""`course run`: any command, with a master of its own."""

from __future__ import annotations

import signal
import subprocess
from pathlib import Path

import pytest

from tests.lab.commands import ROOT, alive, all_gone, below, running, user_environment
from tests.support import eventually


def course_run(*words: str, text: str = "", **variables: str) -> subprocess.CompletedProcess[str]:
    """Run a command to its end."""
    env = {**user_environment(), **variables}
    return subprocess.run(
        [ROOT / "course", "run", *words], env=env, input=text, capture_output=True, text=True
    )


@pytest.mark.parametrize(("script", "status"), [("exit 0", 0), ("exit 7", 7), ("kill -9 $$", 137)])
def test_the_status_of_the_command_is_passed_on(script: str, status: int) -> None:
    """A command's status is `course run`'s, 128 + n where signal n ended it."""
    assert course_run("sh", "-c", script).returncode == status


def test_every_word_reaches_the_command() -> None:
    """Options, `--`, blanks and empty words are the command's, even --help."""
    words = ["-n", "--", "--help", "a b", "", "-1.0"]
    assert course_run("printf", "[%s]", *words).stdout == "".join(f"[{word}]" for word in words)


def test_input_reaches_the_command() -> None:
    """A command can be fed by a pipe."""
    assert course_run("tr", "a-z", "A-Z", text="words").stdout == "WORDS"


def test_a_command_that_is_not_there_is_one_clear_message() -> None:
    """The name of the command is in the message, and the status is 1."""
    answer = course_run("no-such-command")
    assert (answer.returncode, answer.stderr) == (
        1,
        "course: no-such-command cannot be run: No such file or directory.\n",
    )


def test_each_command_has_a_master_of_its_own_on_this_host_only() -> None:
    """The graph answers, at an address of 127.0.0.1, and is another one for another command."""
    script = "rosnode list; echo $ROS_MASTER_URI $ROS_HOSTNAME"
    first, second = (course_run("sh", "-c", script).stdout.split() for _ in range(2))
    assert first[1:] == second[1:] == ["localhost"]
    assert first[0] != second[0]


def test_a_master_that_the_user_names_is_used() -> None:
    """With ROS_MASTER_URI set, no master is started, and the address stays."""
    assert (
        course_run("printenv", "ROS_MASTER_URI", ROS_MASTER_URI="http://robot:1").stdout == "http://robot:1\n"
    )


def test_the_course_is_a_package_like_any_other() -> None:
    """The tools of ROS find the package's service, its MD5 and its server."""
    script = "rossrv show geometry && rossrv md5 course_pkg/geometry && rospack find course_pkg"
    answer = course_run("sh", "-c", script)
    assert answer.stdout.startswith("[course_pkg/geometry]:\nfloat32 length\n"), answer.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_reaches_the_command_and_nothing_is_left(number: signal.Signals) -> None:
    """Ctrl-C, a kill and a closed terminal end the command, and the master with it."""
    script = "trap 'echo heard; exit 3' INT TERM HUP; echo up; while :; do sleep 0.05; done"
    with running("run", "bash", "-c", script) as process:
        assert process.stdout
        assert process.stdout.readline() == "up\n"
        family = below(process)
        process.send_signal(number)
        assert process.communicate(timeout=20)[0] == "heard\n"
        assert process.returncode == 3
        assert all_gone(family)


def test_nothing_outlives_a_killed_run() -> None:
    """After SIGKILL of `course run` its command and its master end by themselves."""
    with running("run", "sleep", "1000") as process:
        family = eventually(lambda: "sleep" in names(below(process)) and below(process))
        process.kill()
        assert all_gone(family)


def names(pids: list[int]) -> list[str]:
    """Return the command names of processes."""
    return [Path(f"/proc/{pid}/comm").read_text().strip() for pid in pids if alive(pid)]
