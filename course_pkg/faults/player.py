"""Run one short Python program, as `python FILE` does.

The process reads a byte from a pipe before it runs the program.

usage: player.py READY GO NAME CODE [ARGUMENT …]

READY and GO are file descriptors. When the interpreter and rospy are loaded, this program writes a byte to
READY. Then it reads a byte from GO, and runs the code. After the code has ended, this program writes the exit
status to READY as one byte. The caller can therefore start the interpreter early, and then measure only the
running time of the code.
"""

from __future__ import annotations

import linecache
import os
import sys
import traceback


def main(argv: list[str]) -> int:
    """Run the code, and return its exit status; a traceback shows only lines of this code."""
    ready, go = int(argv[1]), int(argv[2])
    name, code = argv[3:5]
    del sys.path[0]  # The program must not import modules from the folder of this file.
    import rospy  # noqa: F401 -- slow imports run before the first byte
    import std_srvs.srv  # noqa: F401

    sys.argv = [name, *argv[5:]]
    linecache.cache[name] = (len(code), None, code.splitlines(keepends=True), name)
    os.write(ready, b"r")
    os.read(go, 1)
    status = _run(name, code)
    sys.stdout.flush()
    sys.stderr.flush()
    os.write(ready, bytes([status & 255]))
    # Wait until the parent process kills this process, because rospy's own shutdown takes 0.6 s or more.
    os.read(go, 1)
    return status


def _run(name: str, code: str) -> int:
    try:
        exec(compile(code, name, "exec"), {"__name__": "__main__"})  # noqa: S102 -- a program of the catalogue
    except SystemExit as end:
        return int(end.code or 0)
    except BaseException as error:  # noqa: BLE001 -- printed as Python prints it
        shown = traceback.TracebackException.from_exception(error)
        _cut(shown, name)
        sys.stderr.write("".join(shown.format()))
        return 1
    return 0


def _cut(shown: traceback.TracebackException, name: str) -> None:
    """Remove from a traceback the chained exceptions, and all lines that are not in the file `name`."""
    shown.stack = traceback.StackSummary.from_list([each for each in shown.stack if each.filename == name])
    shown.__cause__ = shown.__context__ = None


if __name__ == "__main__":
    sys.exit(main(sys.argv))
