"""The folders that a check has beside the kernel, and the commands that run in them.

A check never works on the student's own files: it works on copies, together with files that it brings. The
commands get the course's environment and not that of the kernel, so that what a student has built and sourced
cannot stand in for what the check builds.
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
from typing import IO, Any

from course_pkg.graph.leash import Leash
from course_pkg.provision import Places, environment

PRINTED = 65536  # characters kept of what is printed
GRACE = 2.0  # s for a node to end after SIGINT, so that it takes its registrations back; rospy takes 0.6 s


class Bench:
    """Folders and running commands, numbered; all are gone after close()."""

    def __init__(self, find: Callable[[str], Path]) -> None:
        self._find = find  # where a file of the student's lies
        self._open = ExitStack()
        self._folders: list[Path] = []
        self._running: list[_Running] = []

    def folder(self, files: Sequence[str], texts: Mapping[str, str]) -> dict[str, Any]:
        """Make a folder with copies of the student's files and folders, and over them the check's `texts`."""
        folder = Path(self._open.enter_context(tempfile.TemporaryDirectory(prefix="course-run-")))
        for name in files:
            _copy(self._find(name), folder / _place(name))
        for name, text in texts.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
        self._folders.append(folder)
        return {"folder": len(self._folders) - 1}

    def run(self, argv: Sequence[str], folder: int, within: float) -> dict[str, Any]:
        """Run a command to its end, and at most `within` s."""
        return _finished(_command(argv), self._folders[folder], within)

    def start(self, argv: Sequence[str], folder: int) -> dict[str, Any]:
        """Start a command that goes on."""
        self._running.append(_Running(_command(argv), self._folders[folder]))
        self._open.callback(self._running[-1].stop)
        return {"process": len(self._running) - 1}

    def poll(self, process: int) -> dict[str, Any]:
        """Return the status of a command that was started, None while it runs."""
        return {"status": self._running[process].status}

    def stop(self, process: int) -> dict[str, Any]:
        """End a command that was started, as Ctrl-C does, and say how it ended (None if it still ran)."""
        return self._running[process].stop()

    def close(self) -> None:
        """End what runs, and remove the folders."""
        self._open.close()


class _Running:
    """A command that goes on; it ends with the kernel at the latest."""

    def __init__(self, command: Sequence[str], folder: Path) -> None:
        self._started = time.monotonic()
        self._output = tempfile.TemporaryFile()  # noqa: SIM115 -- it lives as long as this object
        in_folder = ["sh", "-c", 'cd "$0" && exec "$@"', str(folder), *command]
        self._leash = Leash(in_folder, output=self._output, env=_environment(folder))
        self._end: dict[str, Any] | None = None

    @property
    def status(self) -> int | None:
        """The exit status, None while it runs."""
        return self._leash.returncode

    def stop(self) -> dict[str, Any]:
        """End it, as Ctrl-C does and then by force; say how it ended, None if it still ran."""
        if self._end is None:
            status = self.status
            self._leash.end(GRACE)
            took = time.monotonic() - self._started
            self._end = {"status": status, "out": _text(self._output), "err": "", "took": took}
            self._output.close()
        return self._end


def _place(name: str) -> str:
    """Return where a copy goes: a relative path is kept, of any other only the last part."""
    path = Path(os.path.normpath(name))
    return path.name if path.is_absolute() or ".." in path.parts else str(path)


def _copy(source: Path, target: Path) -> None:
    """Copy a file or a folder, run bits and links as they are."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        shutil.copytree(source, target, symlinks=True, dirs_exist_ok=True)
    else:
        shutil.copy(source, target)


def _command(argv: Sequence[str]) -> list[str]:
    return [sys.executable if argv[0] == "python" else argv[0], *argv[1:]]


def _environment(folder: Path) -> dict[str, str]:
    """Return the course's environment; catkin_make believes PWD, and not where it is."""
    try:
        known = environment.merged(Places.of(), os.environ)
    except (OSError, ValueError):  # the course was set up by other means than its own
        known = dict(os.environ)
    return {**known, "PWD": str(folder), "PYTHONUNBUFFERED": "1"}


def _finished(command: Sequence[str], folder: Path, timeout: float) -> dict[str, Any]:
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
        try:
            status: int | None = process.wait(timeout)
        except subprocess.TimeoutExpired:
            status = None
        finally:
            _end_group(process.pid)
        took = time.monotonic() - started
        return {"status": status, "out": _text(out), "err": _text(err), "took": took}


def _end_group(leader: int) -> None:
    """End what the command left running in its own session."""
    try:
        os.killpg(leader, signal.SIGKILL)
    except ProcessLookupError:
        return


def _text(stream: IO[bytes]) -> str:
    stream.seek(0)
    return stream.read(PRINTED).decode("utf-8", errors="replace")
