"""Show the progress of long steps: one updated line on a terminal, or a few lines in other outputs."""

from __future__ import annotations

import os
import shutil
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

LIVE_INTERVAL = 0.2  # This is the time in s between two updates of the line on a terminal.
# In other outputs than a terminal, this is the time in s between two lines with the count.
LINE_INTERVAL = 10.0
BAR = 20  # The progress bar has this width in characters.
GREEN, RED, PLAIN = "\033[32m", "\033[31m", "\033[0m"


class Progress:
    """Shows the running steps on stderr.

    If `total` is given, the progress line also contains the number of finished items and the estimated
    remaining time. `unit` is the plural name of the items, such as "cells".
    """

    def __init__(self, stream: TextIO | None = None, *, total: int = 0, unit: str = "") -> None:
        self._stream = stream or sys.stderr
        self._total, self._unit = total, unit
        self._done = self._kept = 0
        self._began = self._told = time.monotonic()
        self._live = self._stream.isatty()
        self._colour = self._live and not os.environ.get("NO_COLOR")
        self._running: dict[str, float] = {}
        self._note = ""
        self._lock = threading.Lock()

    @contextmanager
    def step(self, title: str) -> Iterator[None]:
        """Show the step `title` and its duration during the `with` block, and its result after the block."""
        started = time.monotonic()
        with self._lock:
            self._running[title] = started
        if not self._live:
            self._line(f"{title} …")
        outcome = "failed"
        try:
            yield
            outcome = "done"
        finally:
            with self._lock:
                del self._running[title]
            colour = GREEN if outcome == "done" else RED
            self._line(f"{title}: {self._painted(outcome, colour)} ({time.monotonic() - started:.1f} s)")

    @contextmanager
    def painting(self) -> Iterator[None]:
        """Update the line on the terminal during the `with` block."""
        over = threading.Event()
        painter = threading.Thread(target=self._paint_until, args=(over,), daemon=True)
        if self._live:
            painter.start()
        try:
            yield
        finally:
            over.set()
            if self._live:
                painter.join()
                self._write("\r\033[K")

    def advance(self, count: int = 1, *, kept: bool = False) -> None:
        """Add `count` to the number of finished items.

        If `kept` is true, an earlier run has finished the items; they took no time in this run.
        """
        with self._lock:
            self._done += count
            self._kept += count if kept else 0
            now = time.monotonic()
            due = not self._live and not kept and now - self._told >= LINE_INTERVAL
            self._told = now if due else self._told
        if due:
            self._line(self._counted(now))

    def note(self, text: str) -> None:
        """Show the text `text`, which explains a wait.

        Do nothing if the previous call showed the same text.
        """
        with self._lock:
            seen, self._note = self._note, text
        if text and text != seen:
            self._line(text)

    def _paint_until(self, over: threading.Event) -> None:
        while not over.wait(LIVE_INTERVAL):
            with self._lock:
                now = time.monotonic()
                parts = [self._bar() + self._counted(now)] if self._total else []
                parts += [f"{title} … {now - since:.0f} s" for title, since in self._running.items()]
                width = shutil.get_terminal_size().columns - 1
                self._write("\r\033[K" + "  ".join(parts)[:width])

    def _bar(self) -> str:
        filled = BAR * self._done // self._total
        return f"[{'#' * filled}{'.' * (BAR - filled)}] "

    def _counted(self, now: float) -> str:
        """Return the number of finished items, and the estimated remaining time."""
        counted = f"{self._done} of {self._total} {self._unit}"
        left, here = self._total - self._done, self._done - self._kept
        if not left or not here:
            return counted
        seconds = (now - self._began) / here * left
        shown = f"{seconds:.0f} s" if seconds < 90 else f"{seconds / 60:.0f} min"
        return f"{counted}, about {shown} left"

    def _line(self, text: str) -> None:
        with self._lock:
            self._write(("\r\033[K" if self._live else "") + text + "\n")

    def _painted(self, text: str, colour: str) -> str:
        return f"{colour}{text}{PLAIN}" if self._colour else text

    def _write(self, text: str) -> None:
        self._stream.write(text)
        self._stream.flush()
