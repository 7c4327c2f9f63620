"""What somebody who waits sees: on a terminal a live line, else a line as each step starts and ends."""

from __future__ import annotations

import os
import shutil
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

LIVE_INTERVAL = 0.2  # s between two paintings of the live line
GREEN, RED, PLAIN = "\033[32m", "\033[31m", "\033[0m"


class Progress:
    """Shows the steps that run, on stderr, so that the output of a command stays its own."""

    def __init__(self, stream: TextIO | None = None) -> None:
        self._stream = stream or sys.stderr
        self._live = self._stream.isatty()
        self._colour = self._live and not os.environ.get("NO_COLOR")
        self._running: dict[str, float] = {}
        self._note = ""
        self._lock = threading.Lock()

    @contextmanager
    def step(self, title: str) -> Iterator[None]:
        """Show that `title` runs, for how long, and how it ended."""
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
        """Keep the live line up to date for as long as the block runs."""
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

    def note(self, text: str) -> None:
        """Say once what is being waited for."""
        with self._lock:
            seen, self._note = self._note, text
        if text and text != seen:
            self._line(text)

    def _paint_until(self, over: threading.Event) -> None:
        while not over.wait(LIVE_INTERVAL):
            with self._lock:
                now = time.monotonic()
                parts = [f"{title} … {now - since:.0f} s" for title, since in self._running.items()]
                width = shutil.get_terminal_size().columns - 1
                self._write("\r\033[K" + "  ".join(parts)[:width])

    def _line(self, text: str) -> None:
        with self._lock:
            self._write(("\r\033[K" if self._live else "") + text + "\n")

    def _painted(self, text: str, colour: str) -> str:
        return f"{colour}{text}{PLAIN}" if self._colour else text

    def _write(self, text: str) -> None:
        self._stream.write(text)
        self._stream.flush()
