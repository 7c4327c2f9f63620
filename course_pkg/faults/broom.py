"""Waits beside a case, and sweeps up after it should the notebook's kernel be killed.

usage: broom.py MASTER NAMESPACE FOLDER

Processes end with the kernel by themselves. What stays is what a process registered that was killed on
purpose: SIGTERM, which this program gets when its owner is gone, has it withdrawn. It is there for every
case and almost never needed, so it runs on the bare interpreter, and imports nothing until then.
"""

from __future__ import annotations

import signal
import sys

PATIENCE = 1.5  # s; after 2 s this program is killed, too
COURSE = __file__.rpartition("/course_pkg/")[0]


def main(argv: list[str]) -> None:
    """Wait, then sweep."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
    signal.sigwait([signal.SIGTERM])
    sweep(*argv[1:4])


def sweep(master: str, namespace: str, folder: str) -> None:
    """Remove the folder, and withdraw what is registered, until nobody can be registering any more."""
    import shutil
    import time

    sys.path.append(COURSE)
    from course_pkg.errors import GraphError
    from course_pkg.faults.registrations import withdraw_below
    from course_pkg.graph.rpc import MasterClient

    shutil.rmtree(folder, ignore_errors=True)
    deadline = time.monotonic() + PATIENCE
    try:
        while time.monotonic() < deadline:  # those that end meanwhile may still be registering
            withdraw_below(MasterClient(master, timeout=0.5), f"{namespace}/")
            time.sleep(0.1)
    except GraphError:
        pass  # the master has ended with the kernel


if __name__ == "__main__":
    main(sys.argv)
