"""The printer of a till. It needs no ROS."""

from __future__ import annotations

import threading
import time

from course_pkg.errors import PrinterFailed

LINE = 0.01  # s for a line


class Printer:
    """Prints a receipt, one line at a time. It jams if two threads print at once. `lines` are its lines."""

    def __init__(self, paper: int = 1000) -> None:
        self.lines: list[str] = []
        self.paper = paper  # lines that are left
        self._busy = threading.Lock()

    def print(self, text: str) -> None:
        """Print a line, which takes 10 ms. Raises PrinterFailed if nothing was printed."""
        if not self._busy.acquire(blocking=False):
            raise PrinterFailed("paper jam: two lines at once")
        try:
            time.sleep(LINE)
            if self.paper <= len(self.lines):
                raise PrinterFailed("out of paper")
            self.lines.append(text)
        finally:
            self._busy.release()
