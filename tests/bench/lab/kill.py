"""Kills processes of `course lab`, and counts the processes, sockets, mounts and files that are left."""

from __future__ import annotations

import os
import signal
import subprocess
import tempfile
import time
from contextlib import suppress
from functools import partial
from pathlib import Path
from urllib.parse import urlsplit

from course_pkg.ports import free_port
from tests.lab.commands import ROOT, alive, below, can_connect, having, lab
from tests.support import eventually

TIMEOUT = 20.0  # A process that still runs after this time in s counts as left behind.


def kill(times: int = 25) -> bool:
    """Kill four processes of `course lab`, each one several times, and print what is left.

    Return whether nothing is left.
    """
    victims = {"course lab": b"", "the master": b"rosmaster\0--core", "the kernel": b"ipykernel_launcher"}
    victims["the holder of the graph"] = b"graph/holder.py\0"
    nothing = True
    with tempfile.TemporaryDirectory(prefix="c", dir="/tmp") as folder:  # The path must be short for sockets.
        killed(
            folder, victims["the holder of the graph"]
        )  # The first start creates files that are not deleted, such as locks.
        for name, pattern in victims.items():
            seconds, leftovers = zip(*(killed(folder, pattern) for _ in range(times)), strict=True)
            counts = {kind: sum(each[kind] for each in leftovers) for kind in leftovers[0]}
            left = ", ".join(f"{count} {kind}" for kind, count in counts.items())
            print(f"SIGKILL of {name}, {times} times: {left} left; slowest {max(seconds):.1f} s", flush=True)
            nothing = nothing and not any(counts.values())
    return nothing


def killed(folder: str, pattern: bytes) -> tuple[float, dict[str, int]]:
    """Kill the process that has the given text in its command line, and then stop `course lab`.

    If the text is empty, the function kills `course lab` itself. The files of `course lab` are in `folder`.
    The function waits until nothing is left, but at most `TIMEOUT`. Return the waiting time in s, and the
    number of remaining processes, sockets, mounts and files.
    """
    port, before = free_port(), files_in(folder)
    variables = {"TMPDIR": folder, "XDG_STATE_HOME": f"{folder}/state"}
    chapter = str(next((ROOT / "solutions").glob("*.ipynb")))
    with lab("--port", str(port), chapter, **variables) as (process, address):
        assert urlsplit(address).port == port
        family = eventually(partial(complete_family, process), timeout=60)
        if pattern:
            # The supervisor and its child process have the same command line. The child process comes last in
            # the list.
            os.kill(having(pattern, family)[-1], signal.SIGKILL)
            family += below(process)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=TIMEOUT)
        else:
            process.kill()

        def left() -> dict[str, int]:
            return {
                "processes": len({*filter(alive, family), *started_with(folder)}),
                "sockets": can_connect(port) + Path("/proc/net/unix").read_text().count(f"{folder}/"),
                "mounts": Path("/proc/self/mountinfo").read_text().count(folder),
                "files": len(files_in(folder) - before),
            }

        began = time.monotonic()
        while any((seen := left()).values()) and time.monotonic() - began < TIMEOUT:
            time.sleep(0.02)
        return time.monotonic() - began, seen


def files_in(folder: str) -> set[str]:
    """Return all files, sockets and folders in a folder.

    If another process removes files during the search, the function raises no error.
    """
    return {os.path.join(root, name) for root, folders, files in os.walk(folder) for name in folders + files}


def started_with(folder: str) -> list[int]:
    """Return all processes of this computer that have the given folder as TMPDIR in their environment.

    Linux deletes a private network when no process uses it. Therefore, an empty list means that the private
    network of the command no longer exists.
    """
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):  # The process has ended, or belongs to another user.
            if f"\0TMPDIR={folder}\0".encode() in b"\0" + (process / "environ").read_bytes():
                found.append(int(process.name))
    return found


def complete_family(process: subprocess.Popen[str]) -> list[int]:
    """Return the child processes of `course lab`.

    The list is empty if the master or the kernel is missing.
    """
    family = below(process)
    return family if having(b"ipykernel_launcher", family) and having(b"rosmaster\0--core", family) else []
