"""Replaces the node receipt_printer: prints lines, jams, refuses lines, and pauses."""

from __future__ import annotations

import threading

from course_pkg.checking.peers.scripted_server import Act, Refuse
from course_pkg.srv import PrintLineRequest

PRINTING = 0.02  # s for a line
JAM = "paper jam: two lines at once"


class Printer:
    """Serves print_line; it refuses each line if the error message `fault` is not empty.

    `lines` are the printed lines. While the event `held` is not set, each line waits, but at most 10 s.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.fault = ""
        self.jams = 0
        self.calls = 0  # number of lines that were printed, or refused because of `fault`
        self.began = threading.Event()  # set when the first line begins
        self.held = threading.Event()
        self.held.set()
        self._busy = threading.Lock()

    def answer(self, request: PrintLineRequest) -> Act:
        """Print a line, or refuse."""
        if not self._busy.acquire(blocking=False):
            self.jams += 1
            return Refuse(JAM)
        try:
            self.calls += 1
            self.began.set()
            self.held.wait(10.0)
            threading.Event().wait(PRINTING)
            if self.fault:
                return Refuse(self.fault)
            self.lines.append(request.line)
            return {}
        finally:
            self._busy.release()
