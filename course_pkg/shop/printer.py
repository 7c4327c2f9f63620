"""The printer of a cash register.

This module does not need ROS.
"""

from __future__ import annotations

import threading
import time

from course_pkg.errors import PrinterFailed

LINE = 0.01  # Printing a line takes this time in s.


class Printer:
    """Prints one line at a time, and stores the lines in `lines`.

    The paper jams if two threads print at the same time.
    """

    def __init__(self, paper: int = 1000) -> None:
        self.lines: list[str] = []
        self.paper = paper  # This number of lines fits on the paper.
        self._busy = threading.Lock()

    def print(self, text: str) -> None:
        """Print a line; this takes 10 ms. Raises PrinterFailed if the printer cannot print the line."""
        if not self._busy.acquire(blocking=False):
            raise PrinterFailed("paper jam: two lines at once")
        try:
            time.sleep(LINE)
            if self.paper <= len(self.lines):
                raise PrinterFailed("out of paper")
            self.lines.append(text)
        finally:
            self._busy.release()
