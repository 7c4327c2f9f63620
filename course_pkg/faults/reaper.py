"""Wait until the notebook's kernel ends or is killed, and then remove the registrations and files of a fault.

usage: reaper.py MASTER NAMESPACE FOLDER

The processes of a fault end when the kernel ends. If the fault has killed a process, its registrations remain
at the master. SIGTERM means that the kernel has ended; this program then removes the registrations. This
program runs for every fault, so it imports other modules only after SIGTERM.
"""

from __future__ import annotations

import signal
import sys

DURATION = 1.5  # The clean-up takes this time in s. Two seconds after SIGTERM, this program is killed.
COURSE = __file__.rpartition("/course_pkg/")[0]


def main(argv: list[str]) -> None:
    """Wait for SIGTERM, and then clean up."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
    signal.sigwait([signal.SIGTERM])
    clean_up(*argv[1:4])


def clean_up(master: str, namespace: str, folder: str) -> None:
    """Delete the folder, and remove all registrations in the namespace repeatedly for `DURATION` s."""
    import shutil
    import time

    sys.path.append(COURSE)
    from course_pkg.errors import GraphError
    from course_pkg.ros.protocol.master_api import MasterClient
    from course_pkg.ros.protocol.registrations import withdraw_below

    shutil.rmtree(folder, ignore_errors=True)
    deadline = time.monotonic() + DURATION
    try:
        # The removal is repeated: a program that is ending can register another service or topic.
        while time.monotonic() < deadline:
            withdraw_below(MasterClient(master, timeout=0.5), f"{namespace}/")
            time.sleep(0.1)
    except GraphError:
        pass  # The master has ended with the kernel, so no registrations exist.


if __name__ == "__main__":
    main(sys.argv)
