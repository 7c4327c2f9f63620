"""Test whether this machine can create the sandbox of a part; if not, print an error message."""

from __future__ import annotations

import os
import sys

from course_pkg.sandbox.linux import confinement, namespaces


def main() -> None:
    """Create the sandbox of one part; a process in it only reports that it is running."""
    try:
        namespaces.become_root()
        namespaces.unshare(namespaces.MOUNT | namespaces.NETWORK | namespaces.IPC | namespaces.HOSTNAME)
        namespaces.start_loopback()
        namespaces.mount_memory("/student", size=1 << 20, files=10)
        reading, writing = os.pipe()
        if not os.fork():
            _inside(writing)
        os.close(writing)
        message = os.read(reading, 4096).decode()
    except (OSError, ImportError) as error:
        message = str(error)
    sys.exit(message if message != "here" else None)


def _inside(writing: int) -> None:
    try:
        confinement.run_confined(lambda: _report(writing, "here"), may_write=True)
    except (OSError, ImportError) as error:
        _report(writing, str(error))
    finally:
        os._exit(0)


def _report(writing: int, message: str) -> None:
    os.write(writing, message.encode())


if __name__ == "__main__":
    main()
