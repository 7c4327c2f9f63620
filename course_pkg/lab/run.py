"""`course run`: a command in the environment, with a master of its own."""

from __future__ import annotations

import ctypes
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.lab.master import master_of_this_command

BASHRC = Path(__file__).with_name("bashrc")
AWAITED = {signal.SIGCHLD, signal.SIGINT, signal.SIGTERM, signal.SIGHUP}
PR_SET_PDEATHSIG = 1  # linux/prctl.h


def run_command(command: Sequence[str]) -> int:
    """Run `command` to its end, and return its status: 128 + n where signal n ended it."""
    if list(command) == ["bash"]:
        command = ["bash", "--rcfile", str(BASHRC)]
    with master_of_this_command(), _held_back():
        try:
            process = subprocess.Popen(command, preexec_fn=_in_child)  # no thread runs here yet
        except OSError as error:
            raise SetupError(f"{command[0]} cannot be run: {error.strerror}.") from error
        status = _wait(process)
    return 128 - status if status < 0 else status


@contextmanager
def _held_back() -> Iterator[None]:
    """Have signals wait until somebody asks for them, from before the command starts: none is lost."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, AWAITED)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _in_child() -> None:
    """Have the command hear signals, and be hung up, like a terminal's, when this process is killed."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # a shell's background job has it ignored
    signal.pthread_sigmask(signal.SIG_UNBLOCK, AWAITED)
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGHUP)


def _wait(process: subprocess.Popen[bytes]) -> int:
    """Wait for `process`, handing on the signals that come here alone."""
    while (status := process.poll()) is None:
        came = signal.sigwaitinfo(AWAITED)
        # Pid 0 is the terminal: its Ctrl-C has gone to the command as well.
        if came.si_signo != signal.SIGCHLD and came.si_pid:
            process.send_signal(came.si_signo)
    return status
