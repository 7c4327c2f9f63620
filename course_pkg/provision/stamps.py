"""Which steps are done: small files, each replaced in one go, and a lock for whoever changes things."""

from __future__ import annotations

import fcntl
import hashlib
import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path


class Stamps:
    """The steps that are done: for each a file that holds a hash of what it was made from."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def read(self, name: str) -> str | None:
        """Return what `name` was made from, None where it is not done."""
        try:
            return (self._folder / name).read_text()
        except OSError:
            return None

    def write(self, name: str, key: str) -> None:
        """Record that `name` was made from `key`."""
        replace_text(self._folder / name, key)

    def clear(self, name: str) -> None:
        """Record that `name` is not done, as is so while it is being made anew."""
        (self._folder / name).unlink(missing_ok=True)


def replace_text(path: Path, text: str) -> None:
    """Write `text` to `path` so that a reader sees the old text or the new one, never a part."""
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = path.with_name(f"{path.name}.{os.getpid()}")
    try:
        fresh.write_text(text)
        fresh.replace(path)
    finally:
        fresh.unlink(missing_ok=True)


def digest(parts: Iterable[str | bytes]) -> str:
    """Return a short hash over `parts`, each kept apart from the next."""
    hasher = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        hasher.update(len(data).to_bytes(8, "big") + data)
    return hasher.hexdigest()[:16]


@contextmanager
def locked(path: Path, on_wait: Callable[[], None]) -> Iterator[int]:
    """Hold the lock at `path`; where somebody else has it, call `on_wait` and wait. Yield its descriptor."""
    with path.open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            on_wait()
            fcntl.flock(file, fcntl.LOCK_EX)
        yield file.fileno()
