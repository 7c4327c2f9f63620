"""Tests of the command `course class`.

The command prints one clear message for each wrong input, and SIGKILL does not delete stored results.
"""

from __future__ import annotations

import random
import socket
import sqlite3
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pytest

from course_pkg.class_view.storage import FILE, Storage
from course_pkg.ports import free_port
from course_pkg.sharing.outbox import Outbox
from course_pkg.sharing.sender import Sender
from tests.class_view.classes import tokens_in
from tests.support import eventually, terminal

COMMAND = (sys.executable, "-m", "course_pkg.cli", "class")


def _refused(*arguments: object) -> str:
    done = terminal(*COMMAND, *map(str, arguments))
    assert done.returncode == 1, done.stderr
    assert done.stderr.startswith("course: ")
    assert "Traceback" not in done.stderr
    return done.stderr


def test_wrong_inputs_get_one_message(tmp_path: Path) -> None:
    """Each wrong input causes one message.

    The inputs are a port in use, a missing or incomplete roster, and a database that is damaged or has
    another version.
    """
    data = ("--data", tmp_path / "data", "--port", 0)
    assert "There are no students. Use the option --roster FILE" in _refused(*data)
    assert "There is no folder" in _refused("--data", tmp_path / "nothing", "--delete", "s01")
    roster = tmp_path / "roster.csv"
    roster.write_text("name,username\nAda,ada\nBob,\n")
    assert "roster.csv: the column username is missing or empty in the lines 3" in _refused(
        *data, "--roster", roster
    )
    with socket.socket() as busy:
        busy.bind(("127.0.0.1", 0))
        busy.listen()
        port = busy.getsockname()[1]
        message = _refused("--data", tmp_path / "data", "--students", 2, "--port", port)
        assert (
            f"127.0.0.1:{port} cannot be used (Address already in use). Choose a different port "
            "with the option --port" in message
        )
    assert "contains nothing about 'nobody'" in _refused(*data, "--delete", "nobody")
    database = tmp_path / "data" / FILE
    with closing(sqlite3.connect(database)) as other:
        other.execute("PRAGMA user_version=9")
    assert "was written by another version of the course" in _refused(*data, "--students", 2)
    for each in (tmp_path / "data").glob("results.*"):
        each.unlink()
    database.write_text("This file is not a database. " * 100)
    assert "cannot be used (file is not a database)" in _refused(*data, "--students", 2)
    assert terminal(*COMMAND, "--students", "none").returncode == 2


@contextmanager
def _running(data: Path, port: int) -> Iterator[subprocess.Popen[str]]:
    command = [*COMMAND, "--data", data, "--students", "2", "--port", str(port)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout
            assert process.stdout.readline().startswith(f"The page for the teacher: http://127.0.0.1:{port}/")
            yield process
        finally:
            process.kill()


@pytest.mark.parametrize("kills", [1, pytest.param(20, marks=pytest.mark.slow)])
def test_no_result_is_lost_when_the_service_is_killed(
    kills: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The test kills the service at random moments while a student sends results.

    The service stores each result exactly once.
    """
    monkeypatch.setenv("COURSE_STATE", str(tmp_path / "state"))
    monkeypatch.setattr("course_pkg.sharing.sender.PAUSES", (0.05,))
    monkeypatch.setattr("course_pkg.sharing.sender.BATCH", 2)
    data, port, written = tmp_path / "data", free_port(), []
    outbox, moments = Outbox(), random.Random(16)  # noqa: S311 -- moments, not secrets
    with _running(data, port):
        token = tokens_in(data)["student01"]
    sender = Sender(f"http://127.0.0.1:{port}", token, outbox, lambda _message: None)
    thread = threading.Thread(target=sender.run)
    thread.start()
    try:
        for _ in range(kills):
            with _running(data, port) as service:
                for number in range(30):
                    outbox.put({"check": "05.1", "verdict": "not yet", "assertions": ()})
                    written.append(number)
                left = moments.randrange(30)
                eventually(lambda left=left: len(list(outbox.folder.glob("*.json"))) <= left, 30)
                service.kill()
        with _running(data, port):
            eventually(lambda: not list(outbox.folder.glob("*.json")), 30)
    finally:
        sender.stopped.set()
        thread.join(20)
    storage = Storage(data)
    assert len(storage.read()) == len(written)
    storage.close()
