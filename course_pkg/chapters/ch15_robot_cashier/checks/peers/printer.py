"""Replaces the node receipt_printer; a check can let the printer refuse lines or wait."""

from __future__ import annotations

import threading

from course_pkg.checking.peers.scripted_server import Act, Refuse
from course_pkg.srv import PrintLineRequest

PRINTING = 0.02  # PRINTING is the duration in s of printing a line.
JAM = "paper jam: two lines at once"


class Printer:
    """Serves print_line; while the error message `fault` is not empty, the printer refuses each line.

    `lines` contains the printed lines. The printing of a line waits until the event `held` is set; the
    maximum waiting time is 10 s.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.fault = ""
        self.jams = 0
        # `calls` is the number of printed lines and of lines that were refused because of `fault`.
        self.calls = 0
        self.began = threading.Event()  # This event is set when the printing of the first line begins.
        self.held = threading.Event()
        self.held.set()
        self._busy = threading.Lock()

    def answer(self, request: PrintLineRequest) -> Act:
        """Print the line in the request, or refuse the request."""
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
