"""Lists and reads the files in a submitted folder or zip. A zip is never unpacked.

It does not follow links and does not open files outside the folder or zip. Each file has a size limit.
"""

from __future__ import annotations

import os
import re
import stat
import time
import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path, PurePosixPath

from course_pkg.errors import GradingError
from course_pkg.grading import clean

LARGEST = 20 << 20  # LARGEST is the maximum number of bytes of one notebook.
ALTOGETHER = 4 << 30  # ALTOGETHER is the maximum number of bytes of all unpacked notebooks in a zip.
# This is the maximum compression ratio of a file. The ratio of a usual notebook is 10; with much repetition,
# it is 100.
RATIO = 400
SMALL = 1 << 20  # The compression ratio of files with fewer bytes than this is not checked.
MEMBERS = 200_000
DEPTH = 16  # A file inside more nested folders than this is not graded.
LITTER = {"__macosx", "thumbs.db", "desktop.ini", "timestamp.txt", "__pycache__"}


@dataclass(frozen=True)
class Entry:
    """A submitted file; `read` returns its content, or raises GradingError with the reason."""

    path: str  # `path` is the path in the submitted folder or archive, with / between folders.
    modified: float  # `modified` is a time in s since 1970.
    read: Callable[[], bytes]
    # `executable` is True if the file's owner has the permission to execute the file. Without stored
    # permissions, `executable` is False.
    executable: bool = False

    @property
    def parts(self) -> tuple[str, ...]:
        """The parts of the path: the names of the folders, and the name of the file."""
        return PurePosixPath(self.path).parts


@contextmanager
def opened(source: Path) -> Iterator[list[Entry]]:
    """List the files in `source`, a folder or a zip.

    The files can be read until the end of the `with` block.
    """
    if source.is_dir():
        yield sorted(_in_folder(source, "", DEPTH), key=lambda entry: entry.path)
        return
    try:
        archive = zipfile.ZipFile(source)
    except (OSError, zipfile.BadZipFile, ValueError, NotImplementedError) as error:
        raise GradingError(
            f"{source} contains no submissions: {error}. Give a folder with "
            "SUBMISSIONS/<student>/NN_topic.ipynb, a zip file of this folder, or the zip file from Moodle, "
            "Canvas or Gradescope."
        ) from error
    with archive:
        yield list(_Archive(archive).entries())


def one_file(path: Path) -> Entry:
    """Return an entry for the file at the path `path`; raise GradingError if this file does not exist."""
    try:
        return Entry(path.name, path.lstat().st_mtime, partial(_read_file, path))
    except OSError as error:
        raise GradingError(f"There is no {path}: {error.strerror}. Give the path of a notebook.") from error


def is_litter(parts: tuple[str, ...]) -> bool:
    """Return whether an operating system or an editor, and not the student, created the file."""
    return any(part.lower() in LITTER or (part.startswith(".") and part not in ("..", ".")) for part in parts)


def _in_folder(folder: Path, prefix: str, depth: int) -> Iterator[Entry]:
    try:
        found = list(os.scandir(folder))
    except OSError as error:
        yield _refused(
            prefix.rstrip("/"), f"the folder cannot be read ({error.strerror}); correct its permissions"
        )
        return
    for item in found:
        path = f"{prefix}{item.name}"
        if is_litter((item.name,)):
            continue
        if item.is_dir(follow_symlinks=False):
            if depth:
                yield from _in_folder(Path(item.path), f"{path}/", depth - 1)
            else:
                yield _refused(
                    path,
                    (
                        f"the file is inside more than {DEPTH} nested folders; move the file to a "
                        "higher folder"
                    ),
                )
        else:
            status = item.stat(follow_symlinks=False)
            read, executable = partial(_read_file, Path(item.path)), bool(status.st_mode & stat.S_IXUSR)
            yield Entry(path, status.st_mtime, read, executable)


def _read_file(path: Path) -> bytes:
    """Read a regular file; do not open a link, a pipe or a device."""
    try:
        handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as error:
        if path.is_symlink():
            raise GradingError(
                "the file is a link, and the course does not follow links; replace the link with the file "
                "itself"
            ) from error
        raise GradingError(f"the file cannot be read ({error.strerror}); correct its permissions") from error
    with os.fdopen(handle, "rb") as file:
        status = os.fstat(handle)
        if not stat.S_ISREG(status.st_mode):
            raise GradingError("the file is not an ordinary file; replace it with the notebook itself")
        return _bounded(file.read(LARGEST + 1))


def _bounded(content: bytes) -> bytes:
    _refuse_large(len(content))
    return content


def _refuse_large(size: int) -> None:
    if size > LARGEST:
        raise GradingError(
            f"the file is larger than {LARGEST >> 20} MiB; ask the student to clear the outputs "
            "(Edit, Clear Outputs of All Cells) and to hand in the notebook again"
        )


class _Archive:
    """A zip file; the total number of bytes that are read from this file has a limit."""

    def __init__(self, archive: zipfile.ZipFile) -> None:
        self._archive = archive
        self._left = ALTOGETHER

    def entries(self) -> Iterator[Entry]:
        """Yield the files in the order of their paths."""
        members = [member for member in self._archive.infolist() if not member.is_dir()]
        for member in sorted(members[:MEMBERS], key=lambda each: each.filename):
            path = PurePosixPath(member.filename.replace("\\", "/"))
            if not is_litter(path.parts):
                executable = bool((member.external_attr >> 16) & stat.S_IXUSR)
                yield Entry(str(path), _modified(member), partial(self._read, member), executable)
        if len(members) > MEMBERS:
            yield _refused("", f"the archive contains more than {MEMBERS} files; split the archive")

    def _read(self, member: zipfile.ZipInfo) -> bytes:
        _refuse_suspicious(member)
        if member.file_size > self._left:
            raise GradingError(
                f"the files of the archive have more than {ALTOGETHER >> 30} GiB after unpacking; split "
                "the archive"
            )
        try:
            with self._archive.open(member) as file:
                content = _bounded(file.read(LARGEST + 1))
        except (OSError, RuntimeError, ValueError, EOFError, zipfile.BadZipFile, zlib.error) as error:
            raise GradingError(
                f"this part of the archive is damaged ({clean.line(error)}); create the archive again"
            ) from error
        self._left -= len(content)
        return content


def _refuse_suspicious(member: zipfile.ZipInfo) -> None:
    kind = stat.S_IFMT(member.external_attr >> 16)
    if leads_out(member.filename):
        raise GradingError(
            "the path of the file points to a folder outside the archive, so the file was not read; ask the "
            "student for the notebook itself"
        )
    if kind not in (0, stat.S_IFREG):
        raise GradingError(
            "the file is a link or a device, so it was not read; ask the student for the notebook itself"
        )
    if member.flag_bits & 0x1:
        raise GradingError("the file is encrypted; ask the student for the notebook without a password")
    _refuse_large(member.file_size)
    if member.file_size > SMALL and member.file_size > RATIO * max(1, member.compress_size):
        raise GradingError(
            "the size of the file after unpacking is too large for a notebook; ask the student for "
            "the notebook again"
        )


def leads_out(path: str) -> bool:
    """Return whether a path in an archive refers to a place outside the archive."""
    parts = path.replace("\\", "/").split("/")
    return not parts[0] or ".." in parts or re.match(r"[A-Za-z]:", path) is not None


def _modified(member: zipfile.ZipInfo) -> float:
    try:
        return time.mktime((*member.date_time, 0, 1, -1))
    except (ValueError, OverflowError):
        return 0.0


def _refused(path: str, why: str) -> Entry:
    def read() -> bytes:
        raise GradingError(why)

    return Entry(path, 0.0, read)
