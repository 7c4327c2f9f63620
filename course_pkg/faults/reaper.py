"""Waits as long as a case exists, and cleans up if the notebook's kernel is killed.

usage: reaper.py MASTER NAMESPACE FOLDER

The processes of a case end when the kernel ends. But if a case has killed a process on purpose, the
registrations of this process remain at the master. This program removes these registrations when it receives
SIGTERM, because the kernel has then ended. This program runs for every case, but is rarely needed. Therefore
it imports other modules only after SIGTERM.
"""

from __future__ import annotations

import signal
import sys

DURATION = 1.5  # length of the clean-up in s; less than 2 s, because this program is killed 2 s after SIGTERM
COURSE = __file__.rpartition("/course_pkg/")[0]


def main(argv: list[str]) -> None:
    """Wait for SIGTERM, and then clean up."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
    signal.sigwait([signal.SIGTERM])
    clean_up(*argv[1:4])


def clean_up(master: str, namespace: str, folder: str) -> None:
    """Remove the folder.

    For DURATION s, repeatedly remove all registrations in the namespace from the master.
    """
    import shutil
    import time

    sys.path.append(COURSE)
    from course_pkg.errors import GraphError
    from course_pkg.ros.protocol.master_api import MasterClient
    from course_pkg.ros.protocol.registrations import withdraw_below

    shutil.rmtree(folder, ignore_errors=True)
    deadline = time.monotonic() + DURATION
    try:
        # A program that is just ending may still register, so this is repeated.
        while time.monotonic() < deadline:
            withdraw_below(MasterClient(master, timeout=0.5), f"{namespace}/")
            time.sleep(0.1)
    except GraphError:
        pass  # The master has ended with the kernel, so there is nothing to remove.


if __name__ == "__main__":
    main(sys.argv)
