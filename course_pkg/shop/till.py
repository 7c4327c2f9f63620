"""A till: what each item costs, and a printer that has to write it down first. No ROS."""

from __future__ import annotations

import threading
import time

from course_pkg.errors import PrinterFailed

LINE = 0.01  # s for a line


class Printer:
    """Prints a receipt, one line at a time: it jams when it is told two at once. `lines` is what is on it."""

    def __init__(self, paper: int = 1000) -> None:
        self.lines: list[str] = []
        self.paper = paper  # lines that are left
        self._busy = threading.Lock()

    def print(self, text: str) -> None:
        """Print a line, which takes a moment. Raises PrinterFailed, and has printed nothing then."""
        if not self._busy.acquire(blocking=False):
            raise PrinterFailed("paper jam: two lines at once")
        try:
            time.sleep(LINE)
            if self.paper <= len(self.lines):
                raise PrinterFailed("out of paper")
            self.lines.append(text)
        finally:
            self._busy.release()


class OpenTill:
    """Knows what each item costs; `turn` is a lock that is held while `amounts` change or are added up."""

    def __init__(self, printer: Printer) -> None:
        self.turn = threading.Lock()
        self.amounts: dict[str, int] = {}  # cents by item
        self.printer = printer

    def total(self) -> int:
        """Return the sum in cents; takes its turn."""
        with self.turn:
            return sum(self.amounts.values())

    def put(self, item: str, cents: int) -> int:
        """Print and note what an item costs, and return the sum; takes its turn. Raises PrinterFailed."""
        with self.turn:
            amounts = {**self.amounts, item: cents}
            self.printer.print(f"{item} {cents}")
            self.amounts = amounts
            return sum(amounts.values())
