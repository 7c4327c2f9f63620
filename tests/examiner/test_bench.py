"""A check works in folders of its own beside the kernel, on copies, in bounded time, and leaves nothing."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.examiner.bench import Bench
from tests.support import eventually


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    """A bench whose student works in tmp_path."""
    fresh = Bench(lambda name: tmp_path / name)
    yield fresh
    fresh.close()


def out(bench: Bench, *argv: str, folder: int = 0, within: float = 10.0) -> str:
    """Return what a command printed."""
    return str(bench.run(argv, folder, within)["out"])


def test_a_command_runs_on_copies(bench: Bench, tmp_path: Path) -> None:
    """Under the paths of the student's files; what it does to them is not done to the student's own."""
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "client.py").write_text("import sys; print(sys.argv[1:]); sys.exit(3)")
    folder = bench.folder(["src/client.py"], {})["folder"]
    answer = bench.run(["python", "src/client.py", "-1", "2"], folder, 10.0)
    assert (answer["status"], answer["out"]) == (3, "['-1', '2']\n")
    bench.run(["rm", "src/client.py"], folder, 10.0)
    assert (tmp_path / "src" / "client.py").exists()


def test_a_command_has_its_time_and_no_more(bench: Bench) -> None:
    """One that hangs is ended, with all that it has started."""
    folder = bench.folder([], {})["folder"]
    answer = bench.run(["bash", "-c", "sleep 60 & sleep 60"], folder, 0.1)
    assert answer["status"] is None
    assert answer["took"] < 5


def test_a_folder_is_copied_with_its_run_bits(bench: Bench, tmp_path: Path) -> None:
    """Whether a script may be run is the student's doing, and is looked at."""
    (tmp_path / "scripts").mkdir()
    for name, mode in (("yes", 0o755), ("no", 0o644)):
        (tmp_path / "scripts" / name).write_text("#!/bin/sh\necho hello\n")
        (tmp_path / "scripts" / name).chmod(mode)
    folder = bench.folder(["scripts"], {})["folder"]
    assert out(bench, "scripts/yes", folder=folder) == "hello\n"
    with pytest.raises(PermissionError):
        bench.run(["scripts/no"], folder, 10.0)


def test_the_texts_of_the_check_go_over_the_copies(bench: Bench, tmp_path: Path) -> None:
    """What is not examined is the check's own, so that one slip does not cost two parts."""
    (tmp_path / "package.xml").write_text("the student's")
    folder = bench.folder(["package.xml"], {"package.xml": "the check's", "srv/A.srv": "---"})["folder"]
    assert out(bench, "cat", "package.xml", "srv/A.srv", folder=folder) == "the check's---"


@pytest.mark.parametrize("name", ["/etc/hostname", "../hostname"])
def test_a_copy_stays_in_its_folder(bench: Bench, tmp_path: Path, name: str) -> None:
    """Whatever path is asked for."""
    (tmp_path / "hostname").write_text("x")
    bench = Bench(lambda _: tmp_path / "hostname")
    folder = bench.folder([name], {})["folder"]
    assert out(bench, "ls", folder=folder) == "hostname\n"
    bench.close()


def test_what_the_student_has_sourced_does_not_count(
    bench: Bench, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A module of an older build, on the kernel's own path, must not stand in for what is being checked."""
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}")
    folder = bench.folder([], {})["folder"]
    assert str(tmp_path) not in out(bench, "bash", "-c", "echo $PYTHONPATH", folder=folder)


def test_the_folder_is_where_the_command_believes_to_be(bench: Bench) -> None:
    """catkin_make builds in $PWD, whatever the working directory is."""
    folder = bench.folder([], {})["folder"]
    there, believed = out(bench, "python", "-c", "import os; print(os.getcwd(), os.environ['PWD'])").split()
    assert folder == 0
    assert there == believed


def test_a_command_that_goes_on_is_ended(bench: Bench) -> None:
    """As by Ctrl-C; what it printed until then is kept."""
    script = "trap 'echo bye; exit 0' INT; echo hello > ready; echo hello; while :; do sleep 0.01; done"
    folder = bench.folder([], {})["folder"]
    process = bench.start(["bash", "-c", script], folder)["process"]
    eventually(lambda: bench.run(["cat", "ready"], folder, 10.0)["status"] == 0)
    answer = bench.stop(process)
    assert answer["status"] is None
    assert answer["out"] == "hello\nbye\n"
    assert bench.stop(process) == answer


def test_a_command_that_ended_by_itself_has_a_status(bench: Bench) -> None:
    """A server that ends at once is told from one that serves."""
    folder = bench.folder([], {})["folder"]
    process = bench.start(["bash", "-c", "echo no; exit 3"], folder)["process"]
    eventually(lambda: bench.poll(process)["status"] is not None)
    assert bench.stop(process)["status"] == 3


def test_nothing_is_left(tmp_path: Path) -> None:
    """Neither a folder nor a process."""
    bench = Bench(lambda name: tmp_path / name)
    folder = bench.folder([], {})["folder"]
    path = Path(out(bench, "pwd").strip())
    bench.start(["sleep", "1000"], folder)
    pid = bench._running[0]._leash.pid
    bench.close()
    assert not path.exists()
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
