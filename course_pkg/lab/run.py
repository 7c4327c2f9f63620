"""`course run`: a command in the environment, with a master of its own."""

from __future__ import annotations

import ctypes
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.lab.master import master_of_this_command

BASHRC = Path(__file__).with_name("bashrc")
HANDED_ON = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
PR_SET_PDEATHSIG = 1  # linux/prctl.h


def run_command(command: Sequence[str]) -> int:
    """Run `command` to its end, and return its status: 128 + n where signal n ended it."""
    if list(command) == ["bash"]:
        command = ["bash", "--rcfile", str(BASHRC)]
    with master_of_this_command():
        try:
            process = subprocess.Popen(command, preexec_fn=_end_with_parent)  # no thread runs here yet
        except OSError as error:
            raise SetupError(f"{command[0]} cannot be run: {error.strerror}.") from error
        status = _wait(process)
    return 128 - status if status < 0 else status


def _end_with_parent() -> None:
    """Have the command hung up, as if its terminal were closed, when this process is killed."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background job has it ignored
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGHUP)


def _wait(process: subprocess.Popen[bytes]) -> int:
    """Wait for `process`, handing on the signals that come here alone."""
    awaited = {signal.SIGCHLD, *HANDED_ON}
    blocked = signal.pthread_sigmask(signal.SIG_BLOCK, awaited)
    try:
        while (status := process.poll()) is None:
            came = signal.sigwaitinfo(awaited)
            # Pid 0 is the terminal: its Ctrl-C has gone to the command as well.
            if came.si_signo != signal.SIGCHLD and came.si_pid:
                process.send_signal(came.si_signo)
        return status
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
