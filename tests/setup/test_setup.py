"""Tests of the set-up."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from course_pkg.errors import SetupError
from course_pkg.setup import Places, packages, steps
from course_pkg.setup.journal import Journal
from course_pkg.setup.progress import Progress
from course_pkg.setup.stamps import locked
from course_pkg.setup.steps import Step, ensure, steps_of


@pytest.fixture
def journal(tmp_path: Path) -> Iterator[Journal]:
    """Return a journal (a log of the set-up) in a temporary folder."""
    with locked(tmp_path / "lock", lambda: None) as lock:
        yield Journal(tmp_path, lock)


def test_an_empty_cache_needs_libraries_and_workspace(tmp_path: Path) -> None:
    """If the cache is empty, is_done() returns False for the libraries and for the catkin workspace."""
    places = Places(Places.of().checkout, tmp_path / "cache")
    *_, [libraries], [catkin] = [[step for step in stage if step.makes] for stage in steps_of(places)]
    assert not libraries.is_done()
    assert not catkin.is_done()


@pytest.mark.parametrize(("complete", "message"), [(True, "libraries of the hub"), (False, "does not work")])
def test_a_user_cannot_complete_an_installation(
    complete: bool, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An ordinary user of an installation gets a message that says what an administrator has to do."""

    def steps_of_installation(_: Places, *, hub: bool = False, **_others: bool) -> list[list[Step]]:
        return [[Step("libraries", lambda: complete and not hub, lambda _journal, _progress: None)]]

    monkeypatch.setattr(steps, "steps_of", steps_of_installation)
    monkeypatch.setattr(Places, "installed", True)
    with pytest.raises(SetupError, match=message):
        ensure(Places(tmp_path, tmp_path / "nowhere"), hub=True)


def test_a_tool_that_fails_is_shown_by_its_last_lines_and_its_log(journal: Journal) -> None:
    """If a tool fails, the error message contains the exit status, the last output, and the log's path."""
    with pytest.raises(SetupError, match=r"status 3:\n  first\n  last\nThe whole output: .*setup-.*log"):
        journal.run(["sh", "-c", "echo first; echo last; exit 3"])


def test_a_full_disk_is_reported(journal: Journal) -> None:
    """If a tool prints an error about a full disk, the error message says that the disk is full."""
    with pytest.raises(SetupError, match=r"The disk is full \(.*\). Delete files that you do not need"):
        journal.run(["sh", "-c", "echo 'write: No space left on device'; exit 1"])


def test_a_full_disk_is_reported_without_a_message_from_the_tool(
    journal: Journal, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If a tool fails without a message while the disk is full, the error message is about the full disk."""
    monkeypatch.setattr("os.statvfs", lambda _: SimpleNamespace(f_bavail=3, f_frsize=4096))
    with pytest.raises(SetupError, match=r"The disk is full \(.*\). Delete files that you do not need"):
        journal.run(["false"])


@pytest.mark.parametrize(
    "words",
    [
        "dpkg: error: dpkg frontend lock was locked by another process with pid 7",
        "E: Could not get lock /var/lib/apt/lists/lock. It is held by process 7 (apt-get)",
        "E: Unable to acquire the dpkg frontend lock (/var/lib/dpkg/lock-frontend)",
    ],
)
def test_the_set_up_waits_for_another_package_manager(
    words: str, journal: Journal, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """While another program holds the lock of apt, the set-up repeats the command and prints a message."""
    monkeypatch.setattr(packages, "RETRY_INTERVAL", 0.0)
    said: list[str] = []
    held = f"[ $(wc -l < {tmp_path}/tries) -gt 2 ] || {{ echo '{words}'; exit 100; }}"
    packages._run_when_unlocked(journal, ["sh", "-c", f"echo x >> {tmp_path}/tries; {held}"], said.append)
    assert set(said) == {packages.WAITING}
    assert (tmp_path / "tries").read_text().count("x") == 3


def test_waiting_for_a_lock_has_a_timeout(journal: Journal, monkeypatch: pytest.MonkeyPatch) -> None:
    """After the timeout, or after an error that is not about a lock, the set-up shows the tool's error."""
    monkeypatch.setattr(packages, "LOCK_TIMEOUT", 0.0)
    monkeypatch.setattr(packages, "RETRY_INTERVAL", 0.0)
    for words in ("Could not get lock /x", "Unable to locate package y"):
        with pytest.raises(SetupError, match=words):
            packages._run_when_unlocked(journal, ["sh", "-c", f"echo '{words}'; exit 100"], lambda _: None)


def test_missing_packages_are_listed() -> None:
    """missing_packages() returns only packages that are not installed."""
    assert packages.missing_packages(["dpkg", "no-such-package-anywhere"]) == ["no-such-package-anywhere"]


def test_without_root_and_sudo_the_message_contains_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    """A user without sudo gets an error message that contains the whole installation command."""
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    monkeypatch.setattr("shutil.which", lambda _: None)
    with pytest.raises(SetupError, match=r"apt-get install --no-install-recommends rosbash catkin"):
        packages.become_root(["rosbash", "catkin"])


def test_progress_in_a_pipe_prints_start_and_result() -> None:
    """If the output is a pipe, each step prints a line at its start and a line at its end."""
    stream = io.StringIO()
    progress = Progress(stream)
    with progress.painting(), progress.step("catkin workspace"):
        progress.note("waiting")
        progress.note("waiting")
    with pytest.raises(KeyError), progress.step("other"):
        raise KeyError
    lines = stream.getvalue().splitlines()
    assert lines[:2] == ["catkin workspace …", "waiting"]
    assert [line.partition(" (")[0] for line in lines[2:]] == [
        "catkin workspace: done",
        "other …",
        "other: failed",
    ]


def test_progress_counts_and_estimates_the_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    """If the output is a pipe, the set-up prints its progress every 10 s."""
    now = 0.0
    monkeypatch.setattr("time.monotonic", lambda: now)
    stream = io.StringIO()
    progress = Progress(stream, total=40, unit="notebooks")
    progress.advance(20, kept=True)
    for now in (1.0, 11.0, 12.0, 40.0):  # noqa: B007 -- the clock
        progress.advance(5)
    assert stream.getvalue().splitlines() == [
        "30 of 40 notebooks, about 11 s left",
        "40 of 40 notebooks",
    ]
