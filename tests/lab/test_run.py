"""Tests of `course run`, which runs any command with its own master."""

from __future__ import annotations

import signal
import subprocess
import time
from contextlib import suppress
from pathlib import Path

import pexpect
import pytest

from tests.lab.commands import ROOT, alive, all_gone, below, having, running, user_environment
from tests.support import eventually


def course_run(*words: str, text: str = "", **variables: str) -> subprocess.CompletedProcess[str]:
    """Run `course run` with a command; `text` is the input of this command."""
    env = {**user_environment(), **variables}
    return subprocess.run(
        [ROOT / "course", "run", *words], env=env, input=text, capture_output=True, text=True
    )


@pytest.mark.parametrize(("script", "status"), [("exit 0", 0), ("exit 7", 7), ("kill -9 $$", 137)])
def test_the_status_of_the_command_is_passed_on(script: str, status: int) -> None:
    """`course run` exits with the status of the command, or with 128 + n after signal n."""
    assert course_run("sh", "-c", script).returncode == status


def test_every_argument_reaches_the_command() -> None:
    """The command receives all arguments, even `--`, --help, spaces and empty arguments."""
    words = ["-n", "--", "--help", "a b", "", "-1.0"]
    assert course_run("printf", "[%s]", *words).stdout == "".join(f"[{word}]" for word in words)


def test_input_reaches_the_command() -> None:
    """The command can read the input of `course run`."""
    assert course_run("tr", "a-z", "A-Z", text="words").stdout == "WORDS"


def test_an_unknown_command_is_refused() -> None:
    """If the command does not exist, the error message contains its name, and the exit status is 1."""
    answer = course_run("no-such-command")
    assert (answer.returncode, answer.stderr) == (
        1,
        "course: no-such-command could not be started: No such file or directory.\n",
    )


def test_a_master_that_the_user_names_is_used() -> None:
    """If ROS_MASTER_URI is set, `course run` uses the master at this address."""
    assert (
        course_run("printenv", "ROS_MASTER_URI", ROS_MASTER_URI="http://robot:1").stdout == "http://robot:1\n"
    )


def test_the_course_is_a_package_like_any_other() -> None:
    """The ROS tools find the course's service type and package."""
    script = "rossrv show geometry && rossrv md5 course_pkg/geometry && rospack find course_pkg"
    answer = course_run("sh", "-c", script)
    assert answer.stdout.startswith("[course_pkg/geometry]:\nfloat32 length\n"), answer.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_the_command_and_its_master(number: signal.Signals) -> None:
    """The command receives SIGINT, SIGTERM and SIGHUP, and no process remains."""
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
    """After SIGKILL of `course run`, its command and its master end."""
    with running("run", "sleep", "1000") as process:
        family = eventually(lambda: "sleep" in names(below(process)) and below(process))
        process.kill()
        assert all_gone(family)


@pytest.mark.parametrize(
    "script",
    [
        "rosrun course_pkg server & until rosservice list | grep -q /getGeometry; do :; done",
        "sleep 1000 & disown; setsid sleep 1000 & sleep 0.2",
        "(trap '' TERM; while :; do sleep 0.05; done) &",
    ],
    ids=["a node", "without a parent or session", "ignores SIGTERM"],
)
def test_the_background_ends_with_the_command(script: str, tmp_path: Path) -> None:
    """When a command exits, its background processes are killed."""
    tag = str(tmp_path)  # Only the processes of this test have the text of `tag` in their environment.
    answer = course_run("bash", "-c", f"{script}\nexit 5", TAG=tag)
    assert answer.returncode == 5, answer.stderr
    assert [pid for pid in tagged(tag) if alive(pid)] == []


def test_an_interactive_shell_has_the_terminal_and_its_jobs() -> None:
    """In `course run bash`, Ctrl-C stops only the foreground job, and Ctrl-Z suspends the foreground job."""
    tag = f"course-run-{time.monotonic_ns()}"
    shell = pexpect.spawn(
        str(ROOT / "course"), ["run", "bash"], env={**user_environment(), "TAG": tag}, timeout=30
    )

    def job(seconds: int) -> list[int]:
        return eventually(lambda: having(b"sleep\0%d" % seconds, tagged(tag)), timeout=20)

    try:
        shell.expect_exact("(course)")
        shell.sendline("sleep 1000 &")
        background = job(1000)
        shell.sendline("sleep 1001")
        foreground = job(1001)
        shell.sendintr()
        assert all_gone(foreground)
        shell.sendline("sleep 1002")
        stopped = job(1002)
        shell.send("\x1a")
        shell.expect_exact("Stopped")
        assert alive(background[0])
        assert alive(stopped[0])
        shell.sendline("kill %2")  # While a job is suspended, the first `exit` only prints a warning.
        assert all_gone(stopped)
        shell.sendline("exit 7")
        shell.expect(pexpect.EOF)
        shell.close()
        assert shell.exitstatus == 7
        assert all_gone(background)
    finally:
        shell.close(force=True)


def tagged(tag: str) -> list[int]:
    """Return the processes that have the given text in their environment."""
    found = []
    for environment in Path("/proc").glob("[0-9]*/environ"):
        with suppress(OSError):  # The process may have exited, or may belong to another user.
            if tag.encode() in environment.read_bytes():
                found.append(int(environment.parent.name))
    return found


def names(pids: list[int]) -> list[str]:
    """Return the command names of those given processes that still run."""
    return [Path(f"/proc/{pid}/comm").read_text().strip() for pid in pids if alive(pid)]
