"""A check runs commands on copies of the student's files, with a time limit."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.checking.commands.workbench import CommandFolders
from tests.support import eventually


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[CommandFolders]:
    """Return an object that runs commands on copies of the files in tmp_path."""
    fresh = CommandFolders(lambda name: tmp_path / name)
    yield fresh
    fresh.close()


def out(bench: CommandFolders, *argv: str, folder: int = 0, within: float = 10.0) -> str:
    """Return the output of a command."""
    return str(bench.run(argv, folder, within)["out"])


def test_a_command_runs_on_copies(bench: CommandFolders, tmp_path: Path) -> None:
    """If a command changes a copy, the student's file does not change."""
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "client.py").write_text("import sys; print(sys.argv[1:]); sys.exit(3)")
    folder = bench.folder(["src/client.py"], {})["folder"]
    answer = bench.run(["python", "src/client.py", "-1", "2"], folder, 10.0)
    assert (answer["status"], answer["out"]) == (3, "['-1', '2']\n")
    bench.run(["rm", "src/client.py"], folder, 10.0)
    assert (tmp_path / "src" / "client.py").exists()


def test_command_ends_at_its_time_limit(bench: CommandFolders) -> None:
    """A command and its child processes end at the time limit."""
    folder = bench.folder([], {})["folder"]
    answer = bench.run(["bash", "-c", "sleep 60 & sleep 60"], folder, 0.1)
    assert answer["status"] is None
    assert answer["took"] < 5


def test_copies_keep_permissions(bench: CommandFolders, tmp_path: Path) -> None:
    """A copied script stays executable."""
    (tmp_path / "scripts").mkdir()
    for name, mode in (("yes", 0o755), ("no", 0o644)):
        (tmp_path / "scripts" / name).write_text("#!/bin/sh\necho hello\n")
        (tmp_path / "scripts" / name).chmod(mode)
    folder = bench.folder(["scripts"], {})["folder"]
    assert out(bench, "scripts/yes", folder=folder) == "hello\n"
    with pytest.raises(PermissionError):
        bench.run(["scripts/no"], folder, 10.0)


def test_files_of_the_check_replace_copies(bench: CommandFolders, tmp_path: Path) -> None:
    """If the check and the student have a file with the same path, the command uses the check's file."""
    (tmp_path / "package.xml").write_text("the student's")
    folder = bench.folder(["package.xml"], {"package.xml": "the check's", "srv/A.srv": "---"})["folder"]
    assert out(bench, "cat", "package.xml", "srv/A.srv", folder=folder) == "the check's---"


@pytest.mark.parametrize("name", ["/etc/hostname", "../hostname"])
def test_a_copy_stays_in_its_folder(bench: CommandFolders, tmp_path: Path, name: str) -> None:
    """Even if the path of a student's file leads out of the folder, the copy is inside the check's folder."""
    (tmp_path / "hostname").write_text("x")
    bench = CommandFolders(lambda _: tmp_path / "hostname")
    folder = bench.folder([name], {})["folder"]
    assert out(bench, "ls", folder=folder) == "hostname\n"
    bench.close()


def test_sourced_packages_of_the_student_are_not_used(
    bench: CommandFolders, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """The check does not import a student's module from an older build."""
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}")
    folder = bench.folder([], {})["folder"]
    assert str(tmp_path) not in out(bench, "bash", "-c", "echo $PYTHONPATH", folder=folder)


def test_pwd_is_the_folder(bench: CommandFolders) -> None:
    """In a command, $PWD is the folder of the check, because catkin_make builds in $PWD."""
    folder = bench.folder([], {})["folder"]
    there, believed = out(bench, "python", "-c", "import os; print(os.getcwd(), os.environ['PWD'])").split()
    assert folder == 0
    assert there == believed


def test_stop_ends_a_running_command(bench: CommandFolders) -> None:
    """stop() ends a running command and returns its output; a second stop() returns the same output."""
    script = "trap 'echo bye; exit 0' INT; echo hello; echo > ready; while :; do sleep 0.01; done"
    folder = bench.folder([], {})["folder"]
    process = bench.start(["bash", "-c", script], folder)["process"]
    eventually(lambda: bench.run(["cat", "ready"], folder, 10.0)["status"] == 0)
    answer = bench.stop(process)
    assert answer["status"] is None
    assert answer["out"] == "hello\nbye\n"
    assert bench.stop(process) == answer


def test_a_command_that_ended_by_itself_has_a_status(bench: CommandFolders) -> None:
    """The result contains the exit status of a command that has ended."""
    folder = bench.folder([], {})["folder"]
    process = bench.start(["bash", "-c", "echo no; exit 3"], folder)["process"]
    eventually(lambda: bench.poll(process)["status"] is not None)
    assert bench.stop(process)["status"] == 3


LISTENS = """
import socket, subprocess, sys, time
own = socket.create_server(("127.0.0.1", 0))
if sys.argv[1:]:
    subprocess.Popen([sys.executable, __file__])
time.sleep(60)
"""


def test_ports_of_the_own_process(bench: CommandFolders, tmp_path: Path) -> None:
    """The list "own" contains only the ports of the process itself, and no ports of its child processes."""
    (tmp_path / "listens.py").write_text(LISTENS)
    folder = bench.folder(["listens.py"], {})["folder"]
    process = bench.start(["python", "listens.py", "parent"], folder)["process"]
    assert eventually(lambda: len(bench.ports(process)["ports"]) == 2)
    ports = bench.ports(process)
    assert len(ports["own"]) == 1
    assert set(ports["own"]) < set(ports["ports"])


def test_sigkill_leaves_no_folder(tmp_path: Path) -> None:
    """If the process that made a folder is killed, the folder disappears."""
    code = (
        "import os, signal\nfrom course_pkg.checking.commands.workbench import CommandFolders\n"
        "bench = CommandFolders(lambda name: name)\nbench.folder([], {'arm.py': ''})\n"
        "os.kill(os.getpid(), signal.SIGKILL)"
    )
    subprocess.run(
        [sys.executable, "-c", code], env={**os.environ, "TMPDIR": str(tmp_path)}, check=False, timeout=30
    )
    eventually(lambda: not list(tmp_path.iterdir()))


def test_close_leaves_no_folder_and_no_process(tmp_path: Path) -> None:
    """After close(), no folder and no process remains."""
    bench = CommandFolders(lambda name: tmp_path / name)
    folder = bench.folder([], {})["folder"]
    path = Path(out(bench, "pwd").strip())
    bench.start(["sleep", "1000"], folder)
    pid = bench._running[0]._process.pid
    bench.close()
    assert not path.exists()
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
