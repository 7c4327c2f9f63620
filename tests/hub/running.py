"""Runs a hub as the current user, for tests and measurements."""

from __future__ import annotations

import csv
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from tests.lab.commands import ROOT, address_of, running
from tests.support import eventually, terminal


def passwords(folder: Path) -> dict[str, str]:
    """Return the one-time passwords of a hub; the keys are the users."""
    with (folder / "hub" / "private" / "passwords.csv").open(newline="") as file:
        return {row["username"]: row["password"] for row in csv.DictReader(file)}


def arguments(folder: Path, students: Sequence[str]) -> list[str]:
    """Return the arguments of `course` for a hub with its data and home folders in the given folder."""
    roster = folder / "roster.csv"
    roster.write_text("\n".join(["username", *students]))
    homes = ["--without-accounts", str(folder / "homes")]
    return ["hub", "--users", str(roster), *homes, "--data", str(folder / "hub")]


@contextmanager
def hub(
    folder: Path, students: Sequence[str], *options: str, before: Sequence[str] = ()
) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Run a hub during the `with` block; wait until the hub responds, and yield its process and its address.

    `before` contains the words of a command that runs the hub's command, such as `unshare`. Another test may
    start a hub at the same time, so the port is not one of the usual ports.
    """
    port = [] if "--port" in options else ["--port", "0"]
    with running(*arguments(folder, students), *port, *options, before=before) as process:
        address = address_of(process)
        eventually(lambda: answers(address), 60, 0.1)
        yield process, address


def answers(address: str) -> bool:
    """Return whether the hub's login page answers."""
    return not terminal("curl", "-sfk", "-o", "/dev/null", f"{address}/hub/login").returncode


def refusal(*options: str) -> str:
    """Return the error message of `course hub` for wrong options."""
    done = subprocess.run(
        [ROOT / "course", "hub", *options], capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 1, done.stdout
    return done.stderr
