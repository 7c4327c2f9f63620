"""Records the steps that are done, in one small file per step.

A lock prevents changes by two set-ups at a time.
"""

from __future__ import annotations

import fcntl
import hashlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from course_pkg.files import write_atomically


class Stamps:
    """The steps that are done; the file of each step contains a hash of the step's inputs."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def read(self, name: str) -> str | None:
        """Return the hash of the step `name`, or None if the step is not done."""
        try:
            return (self._folder / name).read_text()
        except OSError:
            return None

    def write(self, name: str, key: str) -> None:
        """Record that the step `name` is done, with the hash `key`."""
        write_atomically(self._folder / name, key)

    def clear(self, name: str) -> None:
        """Record that the step `name` is not done; call this before the step runs again."""
        (self._folder / name).unlink(missing_ok=True)


def digest(parts: Iterable[str | bytes]) -> str:
    """Return a short hash of `parts` and of their lengths: ["ab", "c"] differs from ["a", "bc"]."""
    hasher = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        hasher.update(len(data).to_bytes(8, "big") + data)
    return hasher.hexdigest()[:16]


@contextmanager
def locked(path: Path, on_wait: Callable[[], None]) -> Iterator[int]:
    """Hold the lock at `path`, and yield its file descriptor.

    Call `on_wait` if another process holds the lock.
    """
    with path.open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            on_wait()
            fcntl.flock(file, fcntl.LOCK_EX)
        yield file.fileno()
