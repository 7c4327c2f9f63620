"""How much processor time a process has used so far."""

from __future__ import annotations

import subprocess
import time


def processor_time(pid: int) -> float:
    """Return the s of processor time that the process `pid` has used; raises ProcessLookupError."""
    try:
        # The CPU clock of another process, as clock_getcpuclockid(3) names it on Linux: in ns, where /proc
        # counts in ticks of 10 ms.
        return time.clock_gettime((~pid << 3) | 2)
    except (OSError, OverflowError):
        return _as_ps_tells(pid)


def _as_ps_tells(pid: int) -> float:
    """Ask `ps`, which every system has; it tells whole seconds on Linux, and hundredths on macOS."""
    command = ["ps", "-o", "time=", "-p", str(pid)]
    said = subprocess.run(command, capture_output=True, text=True, timeout=5, check=False).stdout.strip()
    if not said:
        raise ProcessLookupError(f"There is no process {pid}.")
    return read_time(said)


def read_time(text: str) -> float:
    """Return the s in a time as `ps` words it, [[days-]hours:]minutes:seconds."""
    days, _, rest = text.rpartition("-")
    seconds = 0.0
    for part in rest.split(":"):
        seconds = 60 * seconds + float(part)
    return 86400 * int(days or 0) + seconds
