"""Waits while a case exists, and cleans up if the notebook's kernel is killed.

usage: reaper.py MASTER NAMESPACE FOLDER

The processes of a case end with the kernel. But if a case has killed a process on purpose, the registrations
of this process stay at the master. This program removes them when it receives SIGTERM, because then the
kernel has ended. It runs for every case, but is rarely needed. Therefore it imports other modules only after
SIGTERM.
"""

from __future__ import annotations

import signal
import sys

DURATION = 1.5  # s; less than 2 s, because this program is killed 2 s after SIGTERM
COURSE = __file__.rpartition("/course_pkg/")[0]


def main(argv: list[str]) -> None:
    """Wait for SIGTERM, and then clean up."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
    signal.sigwait([signal.SIGTERM])
    clean_up(*argv[1:4])


def clean_up(master: str, namespace: str, folder: str) -> None:
    """Remove the folder, and for DURATION remove all registrations in the namespace from the master."""
    import shutil
    import time

    sys.path.append(COURSE)
    from course_pkg.errors import GraphError
    from course_pkg.ros.protocol.master_api import MasterClient
    from course_pkg.ros.protocol.registrations import withdraw_below

    shutil.rmtree(folder, ignore_errors=True)
    deadline = time.monotonic() + DURATION
    try:
        while time.monotonic() < deadline:  # Programs that are just ending may still register.
            withdraw_below(MasterClient(master, timeout=0.5), f"{namespace}/")
            time.sleep(0.1)
    except GraphError:
        pass  # The master has ended with the kernel, so there is nothing to remove.


if __name__ == "__main__":
    main(sys.argv)
