"""The set-up as a whole: what is done is not done again, what was interrupted is."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from course_pkg.errors import SetupError
from course_pkg.provision import Places, packages
from course_pkg.provision.journal import Journal
from course_pkg.provision.progress import Progress
from course_pkg.provision.setup import steps_of
from course_pkg.provision.stamps import locked


@pytest.fixture
def journal(tmp_path: Path) -> Iterator[Journal]:
    """A journal in a folder of its own."""
    with locked(tmp_path / "lock", lambda: None) as lock:
        yield Journal(tmp_path, lock)


def test_where_nothing_is_made_every_step_but_the_packages_is_to_do(tmp_path: Path) -> None:
    """A fresh cache folder: libraries and workspace are missing, and asking changes nothing."""
    places = Places(Places.of().checkout, tmp_path / "cache")
    *_, [libraries], [catkin] = [[step for step in stage if step.makes] for stage in steps_of(places)]
    assert not libraries.is_done()
    assert not catkin.is_done()


def test_a_tool_that_fails_is_shown_by_its_last_lines_and_its_log(journal: Journal) -> None:
    """The message holds the status, the last lines, and the file with all of them."""
    with pytest.raises(SetupError, match=r"status 3:\n  first\n  last\nThe whole of it: .*setup-.*log"):
        journal.run(["sh", "-c", "echo first; echo last; exit 3"])


def test_a_full_disk_is_called_that(journal: Journal) -> None:
    """Whichever tool runs out of room, the message is the same."""
    with pytest.raises(SetupError, match=r"The disk is full. Make room, and start again."):
        journal.run(["sh", "-c", "echo 'write: No space left on device'; exit 1"])


def test_a_full_disk_is_called_that_though_nobody_says_so(
    journal: Journal, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where a tool fails without a word and no room is left, that is the reason given."""
    monkeypatch.setattr("os.statvfs", lambda _: SimpleNamespace(f_bavail=3, f_frsize=4096))
    with pytest.raises(SetupError, match=r"The disk is full. Make room, and start again."):
        journal.run(["false"])


@pytest.mark.parametrize(
    "words",
    [
        "dpkg: error: dpkg frontend lock was locked by another process with pid 7",
        "E: Could not get lock /var/lib/apt/lists/lock. It is held by process 7 (apt-get)",
        "E: Unable to acquire the dpkg frontend lock (/var/lib/dpkg/lock-frontend)",
    ],
)
def test_another_package_manager_is_waited_for(
    words: str, journal: Journal, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whichever tool finds the lock taken, it is run again until it is free, and the user hears why once."""
    monkeypatch.setattr(packages, "AGAIN", 0.0)
    said: list[str] = []
    held = f"[ $(wc -l < {tmp_path}/tries) -gt 2 ] || {{ echo '{words}'; exit 100; }}"
    packages._patiently(journal, ["sh", "-c", f"echo x >> {tmp_path}/tries; {held}"], said.append)
    assert set(said) == {packages.WAITING}
    assert (tmp_path / "tries").read_text().count("x") == 3


def test_no_lock_is_waited_for_without_end(journal: Journal, monkeypatch: pytest.MonkeyPatch) -> None:
    """When the patience is over, and for all else that goes wrong at once, the message is the tool's own."""
    monkeypatch.setattr(packages, "PATIENCE", 0.0)
    monkeypatch.setattr(packages, "AGAIN", 0.0)
    for words in ("Could not get lock /x", "Unable to locate package y"):
        with pytest.raises(SetupError, match=words):
            packages._patiently(journal, ["sh", "-c", f"echo '{words}'; exit 100"], lambda _: None)


def test_what_is_missing_is_named() -> None:
    """A package that is not installed is missing, one that is there is not."""
    assert packages.missing_packages(["dpkg", "no-such-package-anywhere"]) == ["no-such-package-anywhere"]


def test_without_root_and_sudo_the_message_is_what_to_type(monkeypatch: pytest.MonkeyPatch) -> None:
    """An ordinary user without sudo gets the whole command, and nothing hangs."""
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    monkeypatch.setattr("shutil.which", lambda _: None)
    with pytest.raises(SetupError, match=r"apt-get install --no-install-recommends rosbash catkin"):
        packages.become_root(["rosbash", "catkin"])


def test_progress_is_a_line_at_either_end_where_nobody_watches() -> None:
    """Piped, each step prints its start and its outcome with the seconds, and no colour."""
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
