"""A check's folders on the kernel's computer, and the commands that run in them.

A check never changes the student's own files: it uses copies of these files, and adds its own files. The
commands get the course's environment, not the kernel's environment. If a student has sourced a package, this
package therefore cannot replace a package that the check builds.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from threading import Thread
from typing import IO

from course_pkg.checking.plain_values import Reply
from course_pkg.ros.process.supervised import SupervisedProcess, temporary_folder
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.setup import Places, environment

PRINTED = 65536  # At most this number of characters of a command's output is stored.
GRACE = 2.0  # A node has to end within this time in s after SIGINT; a node with rospy takes 0.6 s.


class CommandFolders:
    """Folders and running commands with ID numbers; close() ends the commands and deletes the folders."""

    def __init__(self, find: Callable[[str], Path]) -> None:
        self._find = find  # This function returns the path of a student's file.
        self._open = ExitStack()
        self._root: Path | None = None  # This folder contains all other folders.
        self._folders: list[Path] = []
        self._running: list[_Running] = []

    def folder(self, files: Sequence[str], texts: Mapping[str, str]) -> Reply:
        """Make a folder with copies of the student's files and folders, and with the check's own texts."""
        self._root = self._root or self._open.enter_context(temporary_folder("course-run-"))
        folder = self._root / str(len(self._folders))
        folder.mkdir()
        for name in files:
            _copy(self._find(name), folder / _place(name))
        for name, text in texts.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
        self._folders.append(folder)
        return {"folder": len(self._folders) - 1}

    def run(self, argv: Sequence[str], folder: int, within: float) -> Reply:
        """Run a command; the time limit is `within` (s)."""
        return _finished(_command(argv), self._folders[folder], within)

    def start(self, argv: Sequence[str], folder: int) -> Reply:
        """Start a command that continues to run."""
        self._running.append(_Running(_command(argv), self._folders[folder]))
        self._open.callback(self._running[-1].stop)
        return {"process": len(self._running) - 1}

    def poll(self, process: int) -> Reply:
        """Return the exit status of a command that was started, or None while it runs."""
        return {"status": self._running[process].status}

    def stop(self, process: int) -> Reply:
        """End a command with SIGINT, like Ctrl-C; return its result.

        The status is null if the command was still running.
        """
        return self._running[process].stop()

    def ports(self, process: int) -> Reply:
        """Return the TCP ports on which a running command listens.

        The list "own" contains only the ports of the command's own process, without its descendants.
        """
        return {"ports": self._running[process].ports(), "own": self._running[process].ports(own=True)}

    def programs(self, process: int) -> Reply:
        """Return [SHA-256 sum, name] of each file that the processes of a running command execute."""
        return {"programs": self._running[process].programs}

    def close(self) -> None:
        """End the running commands, and delete the folders."""
        self._open.close()


class _Running:
    """A running command; when the kernel ends, the command ends, too."""

    def __init__(self, command: Sequence[str], folder: Path) -> None:
        self._started = time.monotonic()
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 -- it stays open as long as this object exists
        in_folder = ["sh", "-c", 'cd "$0" && exec "$@"', str(folder), *command]
        self._process = SupervisedProcess(in_folder, output=self._output, env=_environment(folder))
        self._end: Reply | None = None
        self._ended = 0.0  # The time at which the command ended (s, time.monotonic()).
        Thread(target=self._wait, daemon=True).start()

    def _wait(self) -> None:
        self._process.wait()
        self._ended = time.monotonic()

    @property
    def status(self) -> int | None:
        """The exit status, or None while the command runs."""
        return self._process.returncode

    def ports(self, *, own: bool = False) -> list[Json]:
        """Return the TCP ports on which the command and its descendants listen.

        If `own` is true, the ports of the descendants are omitted.
        """
        return [*sorted(self._process.listening_ports(descendants=not own))]

    @property
    def programs(self) -> list[Json]:
        """[SHA-256 sum, name] of each file that the command and its descendants execute."""
        return [[*each] for each in sorted(self._process.programs())]

    def stop(self) -> Reply:
        """End the command with SIGINT, or with SIGKILL if necessary; return its result.

        The status is None if the command was still running.
        """
        if self._end is None:
            status = self.status
            self._process.end(GRACE)
            now = time.monotonic()
            ended = self._ended or now
            self._end = {"status": status, "out": _text(self._output), "err": ""}
            self._end.update(took=ended - self._started, ago=now - ended)
            self._output.close()
        return self._end


def _place(name: str) -> str:
    """Return the path of a file's copy, relative to the check's folder.

    A relative path does not change. For an absolute path or a path outside the folder, the result is only the
    file name.
    """
    path = Path(os.path.normpath(name))
    return path.name if path.is_absolute() or ".." in path.parts else str(path)


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        shutil.copytree(source, target, symlinks=True, dirs_exist_ok=True)
    else:
        shutil.copy(source, target)


def _command(argv: Sequence[str]) -> list[str]:
    return [sys.executable if argv[0] == "python" else argv[0], *argv[1:]]


def _environment(folder: Path) -> dict[str, str]:
    """Return the course's environment; PWD is set because catkin_make uses it as the working directory."""
    try:
        known = environment.merged(Places.of(), os.environ)
    except (OSError, ValueError):  # If the course's set-up is incomplete, use the current environment.
        known = dict(os.environ)
    return {**known, "PWD": str(folder), "PYTHONUNBUFFERED": "1"}


def _finished(command: Sequence[str], folder: Path, timeout: float) -> Reply:
    started = time.monotonic()
    with (
        tempfile.TemporaryFile() as out,
        tempfile.TemporaryFile() as err,
        subprocess.Popen(
            command,
            cwd=folder,
            env=_environment(folder),
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=err,
            start_new_session=True,
        ) as process,
    ):
        times: Reply = {}
        try:
            status: int | None = process.wait(timeout)
        except subprocess.TimeoutExpired:
            status = None
            times = _scheduled(process.pid)
        finally:
            _end_group(process.pid)
        took = time.monotonic() - started
        return {"status": status, "out": _text(out), "err": _text(err), "took": took, **times}


def _scheduled(pid: int) -> Reply:
    """Return for how many seconds a process's main thread has run, and has waited for a CPU.

    Source: /proc/PID/schedstat, in ns (Documentation/scheduler/sched-stats.rst). If this file cannot be read,
    the result is empty.
    """
    try:
        ran, queued, _ = Path(f"/proc/{pid}/schedstat").read_text().split()
    except (OSError, ValueError):
        return {}
    return {"ran": int(ran) / 1e9, "queued": int(queued) / 1e9}


def _end_group(leader: int) -> None:
    """Kill the command and all processes that it has started."""
    try:
        os.killpg(leader, signal.SIGKILL)
    except ProcessLookupError:
        return


def _text(stream: IO[bytes]) -> str:
    stream.seek(0)
    return stream.read(PRINTED).decode("utf-8", errors="replace")
