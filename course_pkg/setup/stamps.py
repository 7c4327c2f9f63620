"""Record the finished steps, in one small file per step. A lock allows only one set-up at a time."""

from __future__ import annotations

import fcntl
import hashlib
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from course_pkg.files import write_atomically


class Stamps:
    """The finished steps; the file of each step contains a hash of the step's inputs."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def read(self, name: str) -> str | None:
        """Return the hash of the step `name`, or None if the step is not finished."""
        try:
            return (self._folder / name).read_text()
        except OSError:
            return None

    def write(self, name: str, key: str) -> None:
        """Record that the step `name` is finished, with the hash `key`."""
        write_atomically(self._folder / name, key)

    def clear(self, name: str) -> None:
        """Record that the step `name` is not finished; call this before the step runs again."""
        (self._folder / name).unlink(missing_ok=True)


def digest(parts: Iterable[str | bytes]) -> str:
    """Return a short hash of the parts and of their lengths: ["ab", "c"] differs from ["a", "bc"]."""
    hasher = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        hasher.update(len(data).to_bytes(8, "big") + data)
    return hasher.hexdigest()[:16]


@contextmanager
def locked(path: Path, on_wait: Callable[[], None]) -> Iterator[int]:
    """Acquire the lock at the path `path`, and yield its file descriptor.

    Call the function `on_wait` if another process has the lock.
    """
    with path.open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            on_wait()
            fcntl.flock(file, fcntl.LOCK_EX)
        yield file.fileno()
