"""The folder for a student's results and own packages.

Each checkout has its own state folder, which is outside the checkout. In a shared installation, the folder is
in the user's own folder. Therefore, an upgrade of the installation does not change the results.
"""

from __future__ import annotations

import errno
import fcntl
import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from datetime import datetime, timezone
from pathlib import Path
from typing import IO, Any

from course_pkg.files import write_atomically
from course_pkg.installed import DATA, own_folder, version_folder
from course_pkg.waiting import wait_until

# A program waits at most this time in s for a lock. This is enough: each program writes only one small file.
LOCK = 5.0


def state_folder() -> Path:
    """Return the folder of this user's state: the value of COURSE_STATE, or a folder below XDG_STATE_HOME.

    In a shared installation, the state is in the user's own folder.
    """
    if given := os.environ.get("COURSE_STATE"):
        return Path(given)
    checkout = Path(__file__).resolve().parent.parent
    if version_folder(checkout):
        return own_folder(checkout) / DATA / "state"
    home = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    return Path(home) / "ros-services-course" / hashlib.sha256(str(checkout).encode()).hexdigest()[:12]


def write_json(path: Path, data: Mapping[str, Any]) -> None:
    """Write the data to a file as JSON, completely or not at all; raises OSError if this fails."""
    write_atomically(path, json.dumps(data, indent=1, sort_keys=True, ensure_ascii=False) + "\n")


@contextmanager
def locked(folder: Path, timeout: float = LOCK) -> Iterator[None]:
    """Hold the lock of the folder `folder` during the `with` block; other processes cannot use the folder.

    The folder is created if it is missing. Raises OSError if the lock cannot be created, or if another
    process holds the lock for the time `timeout` (s). On a file system without locks, the block runs without
    a lock.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / ".lock").open("ab") as file:
        if not wait_until(lambda: _lock(file), timeout):
            raise TimeoutError(errno.ETIMEDOUT, "another program keeps it locked", str(folder))
        yield


def now() -> str:
    """Return the current time in UTC, as ISO 8601."""
    return datetime.now(timezone.utc).isoformat(timespec="seconds")


def _lock(file: IO[bytes]) -> bool:
    """Acquire the lock of a file, or return False if another process has the lock.

    Closing the file releases the lock.
    """
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError as error:
        if error.errno not in (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL):
            raise
    return True
