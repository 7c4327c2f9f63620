"""A student's work in a home folder: the chapters' notebooks, and the catkin packages that parts require.

Each folder and file is opened relative to its parent folder, and links are not followed. Therefore, no harm
is done if a folder is replaced with a link during the reading. The number and the size of the files are
limited.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from course_pkg.errors import HandoutError
from course_pkg.grading.intake import archive, packages
from course_pkg.grading.intake.packages import MANIFEST
from course_pkg.workspace.fault import manifest_tags

NOTEBOOKS, SOURCES = "notebooks", "workspace/src"  # These paths are relative to the course's folder.
DEPTH = 12  # Folders can be nested to this depth.
ENTRIES = 5_000  # At most this many files and folders of a workspace are examined.
# A later modification time (ns since 1970) is replaced by this time, the beginning of the year 2100. A user
# can set any modification time, but some large times are not valid dates.
LATEST = 4_102_444_800 * 10**9
TRIES = 3  # The course tries this many times to read a file that changes during the reading.


@dataclass(frozen=True)
class WorkFile:
    """A file of a student: a notebook, or a file of a package.

    `package` is the name of the package's folder. `asked` is the name that the parts use for the package.
    """

    path: str  # `path` is NN_topic.ipynb, or the path inside the package.
    content: bytes = field(repr=False)
    modified: int  # The time is in ns since 1970; the file's owner can set this time.
    # The time (ns since 1970) of the last write, move or other change. Users cannot set this time.
    changed: int
    executable: bool = False
    package: str = ""
    asked: str = ""

    @property
    def place(self) -> str:
        """The file's path relative to the student's folder."""
        return f"{self.package}/{self.path}" if self.package else self.path


@dataclass(frozen=True)
class Problem:
    """A file or folder that was not collected, with the reason as a sentence."""

    reason: str


class Refused(HandoutError):
    """A file or a folder that must not be read."""


@dataclass
class Walk:
    """A search in a workspace: the wanted packages, the found packages, and the remaining limits."""

    asked: frozenset[str]
    found: set[str] = field(default_factory=set)  # The set contains the names of the packages' folders.
    entries: int = ENTRIES


def work_in(
    home: str, folder: str, notebooks: Mapping[str, str], asked: frozenset[str]
) -> Iterator[WorkFile | Problem]:
    """Yield the student's work in the subfolder `folder` of a home folder.

    The files are read with the rights of this process.

    The keys of `notebooks` are the file names of the notebooks, and the values are the chapters. `asked`
    contains the names of the packages.
    """
    try:
        with _opened(home) as top, _opened(folder, top) as course:
            yield from _notebooks(course, notebooks)
            yield from _packages(course, asked)
    except FileNotFoundError:
        return
    except (OSError, Refused) as error:
        yield Problem(_reason(folder, error))


def _notebooks(course: int, notebooks: Mapping[str, str]) -> Iterator[WorkFile | Problem]:
    """Yield the notebooks in the folder `notebooks`, and then those directly in the course's folder."""
    done: set[str] = set()
    for place in (NOTEBOOKS, ""):
        try:
            with _opened(place, course) as folder:
                for name in notebooks:
                    if name not in done and (found := _notebook(folder, name)):
                        done.add(name)
                        yield found
        except FileNotFoundError:
            continue
        except OSError as error:
            yield Problem(_reason(place, error))


def _notebook(folder: int, name: str) -> WorkFile | Problem | None:
    try:
        return _read(folder, name, archive.LARGEST)
    except FileNotFoundError:
        return None
    except (OSError, Refused) as error:
        return Problem(_reason(name, error))


def _packages(course: int, asked: frozenset[str]) -> Iterator[WorkFile | Problem]:
    try:
        with _opened(SOURCES, course) as sources:
            yield from _below(sources, "", DEPTH, Walk(asked))
    except FileNotFoundError:
        return
    except (OSError, Refused) as error:
        yield Problem(_reason(SOURCES, error))


def _below(folder: int, name: str, depth: int, walk: Walk) -> Iterator[WorkFile | Problem]:
    """Yield the packages in a folder and in its subfolders; a package cannot contain another package."""
    listed = _listed(folder, walk)
    if MANIFEST in listed:
        yield from _package(folder, name, walk)
        return
    for item in listed:
        if not depth or packages.is_generated((item,)):
            continue
        try:
            with _opened(item, folder) as inner:
                yield from _below(inner, item, depth - 1, walk)
        except OSError as error:  # This error is usual, because most paths are files.
            if item in walk.asked:
                yield Problem(_reason(f"the package {item}", error))


def _package(folder: int, name: str, walk: Walk) -> Iterator[WorkFile | Problem]:
    """Yield the files of a required package, and a problem for each file that is left out.

    If nothing can be collected, yield only the reason.
    """
    label = f"the package {name}"
    files: list[WorkFile] = []
    problems: list[str] = []
    try:
        tags = manifest_tags(_read(folder, MANIFEST, packages.LARGEST).content.decode("utf-8", "replace"))
        own = next((tag.text for tag in tags if tag.name == "name"), "")
        asked = next((each for each in (own, name) if each in walk.asked), "")
        if not asked:
            return
        if name in walk.found:
            raise Refused("a second folder has the same name, and was not collected")
        walk.found.add(name)
        _fill(folder, "", files, problems, walk)
    except (OSError, Refused) as error:
        yield Problem(_reason(label, error))
        return
    yield from (Problem(f"{label}: {problem}") for problem in problems)
    yield from (replace(file, package=name, asked=asked) for file in files)


def _fill(folder: int, prefix: str, files: list[WorkFile], problems: list[str], walk: Walk) -> None:
    """Add the files of a package to `files`; raise Refused if the package is too large."""
    for item in _listed(folder, walk):
        path = f"{prefix}{item}"
        try:
            if stat.S_ISDIR(os.stat(item, dir_fd=folder, follow_symlinks=False).st_mode):
                if path.count("/") < DEPTH and not packages.is_generated((item,)):
                    with _opened(item, folder) as inner:
                        _fill(inner, f"{path}/", files, problems, walk)
                continue
            files.append(replace(_read(folder, item, packages.LARGEST), path=path))
        except (OSError, NotRegular) as error:
            problems.append(_reason(path, error))
        if len(files) > packages.FILES:
            raise Refused(f"it has more than {packages.FILES} files")
        if sum(len(each.content) for each in files) > packages.LARGEST:
            raise Refused(f"it has more than {packages.LARGEST >> 20} MiB")


class NotRegular(Refused):
    """A link, a pipe or a device instead of a file."""


def _read(folder: int, name: str, largest: int) -> WorkFile:
    """Read a regular file of at most `largest` bytes; do not open a link, a pipe or a device."""
    if stat.S_ISLNK(os.stat(name, dir_fd=folder, follow_symlinks=False).st_mode):
        raise NotRegular("it is a link, and the command does not follow links")
    flags = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
    for _ in range(TRIES):
        with os.fdopen(os.open(name, flags, dir_fd=folder), "rb") as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                raise NotRegular("it is not an ordinary file")
            content = file.read(largest + 1)
            after = os.fstat(file.fileno())
        if len(content) > largest:
            raise Refused(f"it has more than {largest >> 20} MiB")
        if (status.st_mtime_ns, status.st_size) == (after.st_mtime_ns, after.st_size):
            executable = bool(status.st_mode & stat.S_IXUSR)
            modified = min(max(status.st_mtime_ns, 0), LATEST)
            return WorkFile(name, content, modified, status.st_ctime_ns, executable)
    raise Refused("another program was writing this file; type the command again")


@contextmanager
def _opened(path: str, above: int | None = None) -> Iterator[int]:
    """Open the folder `path`, relative to the open folder `above`, without following a link.

    If `path` is "", open `above` itself.
    """
    flags = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
    if above is None:
        current = os.open(path, flags)
    else:
        current = os.dup(above)
        for name in filter(None, path.split("/")):
            try:
                inner = os.open(name, flags, dir_fd=current)
            finally:
                os.close(current)
            current = inner
    try:
        yield current
    finally:
        os.close(current)


def _listed(folder: int, walk: Walk) -> list[str]:
    """Return the sorted names in a folder, without hidden files and files that operating systems create."""
    names = []
    with os.scandir(folder) as items:
        for item in items:
            walk.entries -= 1
            if walk.entries < 0:
                raise Refused(f"the workspace has more than {ENTRIES} files")
            if not archive.is_litter((item.name,)) and item.name.isprintable():
                names.append(item.name)
    return sorted(names)


def _reason(what: str, error: Exception) -> str:
    if not isinstance(error, OSError):
        return f"{what}: {error}"
    if error.errno in (errno.ELOOP, errno.ENOTDIR):
        return f"{what}: it is a link, or it is not a folder; the command does not follow links"
    return f"{what}: it cannot be read ({error.strerror})"
