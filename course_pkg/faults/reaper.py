"""Waits while a case exists, and cleans up if the notebook's kernel is killed.

usage: reaper.py MASTER NAMESPACE FOLDER

The processes of the case end with the kernel. What a process registered that was killed on purpose stays at
the master: this program withdraws it when it gets SIGTERM, because its owner is gone. It runs for every case
and is almost never needed, so it runs on the bare interpreter, and imports nothing until then.
"""

from __future__ import annotations

import signal
import sys

DURATION = 1.5  # s; after 2 s this program is killed, too
COURSE = __file__.rpartition("/course_pkg/")[0]


def main(argv: list[str]) -> None:
    """Wait, then clean up."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
    signal.sigwait([signal.SIGTERM])
    clean_up(*argv[1:4])


def clean_up(master: str, namespace: str, folder: str) -> None:
    """Remove the folder, and withdraw what is registered until no program can be registering any more."""
    import shutil
    import time

    sys.path.append(COURSE)
    from course_pkg.errors import GraphError
    from course_pkg.ros.protocol.master_api import MasterClient
    from course_pkg.ros.protocol.registrations import withdraw_below

    shutil.rmtree(folder, ignore_errors=True)
    deadline = time.monotonic() + DURATION
    try:
        while time.monotonic() < deadline:  # programs that end meanwhile may still be registering
            withdraw_below(MasterClient(master, timeout=0.5), f"{namespace}/")
            time.sleep(0.1)
    except GraphError:
        pass  # the master has ended with the kernel


if __name__ == "__main__":
    main(sys.argv)
