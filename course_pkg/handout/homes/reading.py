"""Reads a student's work in a child process that has only the rights of this student.

If root runs `course collect`, the child process gives up all rights of root before it reads the home folder.
After this, the child process can read only files that the student can read. A student may create a link, or
replace a folder during the reading. The child still cannot read other users' private files. Without root's
rights, the child has the rights of the user who runs `course collect`.
"""

from __future__ import annotations

import json
import os
import resource
import select
import signal
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import asdict
from typing import BinaryIO

from course_pkg.errors import HandoutError
from course_pkg.handout.homes.listing import Home, groups_of
from course_pkg.handout.homes.work import Problem, WorkFile, work_in
from course_pkg.waiting import Deadline

# Reading one home may take up to this time in s. Without a limit, a network folder that does not respond
# would stop the whole collection.
TIMEOUT = 60.0
ALTOGETHER = 200 << 20  # ALTOGETHER is the maximum number of bytes of one student's work.
HEADER = 64 << 10  # Each header of the child's data has at most this many bytes.
CHUNK = 1 << 20


def read_home(
    home: Home, folder: str, notebooks: Mapping[str, str], asked: frozenset[str], timeout: float = TIMEOUT
) -> tuple[list[WorkFile], list[str]]:
    """Return the student's work in the subfolder `folder` of a home folder.

    The second result contains a sentence about each file or folder that could not be collected.

    The keys of `notebooks` are the file names of the notebooks, and the values are the chapters. `asked`
    contains the names of the packages that the parts of the chapters require. The child process ends after at
    most `timeout` s.
    """
    reader, writer = os.pipe()
    pid = os.fork()
    if not pid:
        os.close(reader)
        _serve(writer, home, folder, notebooks, asked)
    os.close(writer)
    files: list[WorkFile] = []
    problems: list[str] = []
    try:
        for found in _received(_Pipe(reader, timeout)):
            if isinstance(found, Problem):
                problems.append(found.reason)
            elif found.asked in asked if found.package else found.path in notebooks:
                files.append(found)
    except HandoutError as error:
        problems.append(str(error))
    finally:
        os.close(reader)
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
    return files, problems


def become(home: Home) -> None:
    """Give up all rights except the rights of the home's owner.

    Do nothing if this process does not run as root.

    After the change of the user, no process of the home's owner can trace this process (ptrace(2)). Raises
    PermissionError if this process still has rights of root.
    """
    if os.geteuid() != 0:
        return
    os.setgroups(groups_of(home))
    os.setresgid(home.gid, home.gid, home.gid)
    os.setresuid(home.uid, home.uid, home.uid)
    if set(os.getresuid()) != {home.uid} or home.uid == 0:
        raise PermissionError(f"{home.path} must not be read with the rights of root")


def _serve(writer: int, home: Home, folder: str, notebooks: Mapping[str, str], asked: frozenset[str]) -> None:
    """Send the work through a pipe, and exit."""
    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # After Ctrl-C, the parent process ends this process.
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        os.closerange(3, writer)
        os.closerange(writer + 1, resource.getrlimit(resource.RLIMIT_NOFILE)[0])
        become(home)
        with os.fdopen(writer, "wb") as pipe:
            for found in work_in(str(home.path), folder, notebooks, asked):
                _send(pipe, found)
            pipe.write(b'{"end": true}\n')
    finally:
        os._exit(0)


def _send(pipe: BinaryIO, found: WorkFile | Problem) -> None:
    if isinstance(found, Problem):
        pipe.write(json.dumps({"reason": found.reason[:1000]}).encode() + b"\n")
        return
    header = {name: value for name, value in asdict(found).items() if name != "content"}
    pipe.write(json.dumps({**header, "size": len(found.content)}).encode() + b"\n")
    pipe.write(found.content)


class _Pipe:
    """The parent's side of the pipe: reads lines and blocks of bytes before a deadline."""

    def __init__(self, descriptor: int, timeout: float) -> None:
        self._descriptor = descriptor
        self._deadline = Deadline(timeout)
        self._kept = bytearray()

    def line(self) -> bytes:
        """Return the next line, or b"" after the last line."""
        while b"\n" not in self._kept:
            if len(self._kept) > HEADER:
                raise HandoutError("the process that reads the folder sent no valid data")
            if not self._more():
                return b""
        line, _, rest = bytes(self._kept).partition(b"\n")
        self._kept = bytearray(rest)
        return line

    def block(self, size: int) -> bytes:
        """Return the next `size` bytes."""
        while len(self._kept) < size:
            if not self._more():
                raise HandoutError("the process that reads the folder ended too early")
        block = bytes(self._kept[:size])
        del self._kept[:size]
        return block

    def _more(self) -> bool:
        if not select.select([self._descriptor], [], [], self._deadline.left)[0]:
            raise HandoutError(f"reading the folder took more than {self._deadline.seconds:g} s")
        data = os.read(self._descriptor, CHUNK)
        self._kept += data
        return bool(data)


def _received(pipe: _Pipe) -> Iterator[WorkFile | Problem]:
    """Yield all data that the child sends; raise HandoutError if the child ends too early."""
    left = ALTOGETHER
    while line := pipe.line():
        header = json.loads(line)
        if header.pop("end", False):
            return
        if "reason" in header:
            yield Problem(str(header["reason"]))
            continue
        left -= header["size"]
        if left < 0:
            raise HandoutError(f"the work has more than {ALTOGETHER >> 20} MiB; the rest was not collected")
        file = WorkFile(content=pipe.block(header.pop("size")), **header)
        if not _stays_inside(file):
            raise HandoutError(
                "the process that reads the folder sent the name of a file outside of the folder"
            )
        yield file
    raise HandoutError("the process that reads the folder ended too early")


def _stays_inside(file: WorkFile) -> bool:
    """Return whether the file's path is inside the student's folder.

    The student can choose any file name, such as "../x".
    """
    names = [*file.path.split("/"), *([file.package] if file.package else [])]
    safe = all(name not in ("", ".", "..") and "\0" not in name for name in names)
    return safe and "/" not in file.package and (bool(file.package) or len(names) == 1)
