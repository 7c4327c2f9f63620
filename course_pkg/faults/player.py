"""Runs one short program of a case, as `python FILE` would, in a process that waits for a signal to begin.

usage: player.py READY GO NAME CODE [ARGUMENT …]

READY is a descriptor to which a byte is written when the interpreter and rospy are loaded, and the exit
status as another when the code has ended; GO is one from which a byte is read before the code begins. So the
time to start an interpreter is not measured, and can be spent before the program is needed.
"""

from __future__ import annotations

import linecache
import os
import sys
import traceback


def main(argv: list[str]) -> int:
    """Run the code and return its exit status; a traceback begins in the code, not here."""
    ready, go = int(argv[1]), int(argv[2])
    name, code = argv[3:5]
    del sys.path[0]  # the folder of this file: its other modules are not for the program
    import rospy  # noqa: F401 -- slow imports come before the first byte
    import std_srvs.srv  # noqa: F401

    sys.argv = [name, *argv[5:]]
    linecache.cache[name] = (len(code), None, code.splitlines(keepends=True), name)
    os.write(ready, b"r")
    os.read(go, 1)
    status = _run(name, code)
    sys.stdout.flush()
    sys.stderr.flush()
    os.write(ready, bytes([status & 255]))
    os.read(go, 1)  # until it is ended from outside: rospy's own end takes 0.6 s, and longer without a master
    return status


def _run(name: str, code: str) -> int:
    try:
        exec(compile(code, name, "exec"), {"__name__": "__main__"})  # noqa: S102 -- a program of the catalogue
    except SystemExit as end:
        return int(end.code or 0)
    except BaseException as error:  # noqa: BLE001 -- shown as Python shows it
        shown = traceback.TracebackException.from_exception(error)
        _cut(shown, name)
        sys.stderr.write("".join(shown.format()))
        return 1
    return 0


def _cut(shown: traceback.TracebackException, name: str) -> None:
    """Leave in a traceback the lines of the program itself, and no causes inside rospy."""
    shown.stack = traceback.StackSummary.from_list([each for each in shown.stack if each.filename == name])
    shown.__cause__ = shown.__context__ = None


if __name__ == "__main__":
    sys.exit(main(sys.argv))
