"""The runs of a notebook's cells, and what each run created, so that a cell can run again.

A front end that shows a notebook sends the cell's id with each execution. nbclient sends none and runs each
cell once, so every execution without an id counts as a cell of its own.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import FrameType

CALLBACK = "rospy."  # the modules that call handlers and callbacks

Close = Callable[[], None]
CloseAll = Callable[[list[Close]], None]


@dataclass
class CellRun:
    """One run of a cell, or one check; `source` names the file that the code of the cell belongs to."""

    source: str = ""
    temporary: bool = False  # a check: what it creates ends with it
    error: str = ""  # the class of the exception that ended it
    created: dict[Hashable, Close] = field(default_factory=dict)  # by what identifies it, oldest first
    threads: frozenset[int] = frozenset()  # those that ran when it began

    def owns_this_thread(self) -> bool:
        """Return whether this thread works for the run, and not for a handler or an earlier cell."""
        thread = threading.current_thread()
        if thread is threading.main_thread():
            return True
        return thread.ident not in self.threads and not _within_callback(sys._getframe())


class Cells:
    """The last run of each cell of this kernel's notebook. `close_all` ends what a run has created."""

    def __init__(self, close_all: CloseAll) -> None:
        self._close_all = close_all
        self._runs: dict[str, CellRun] = {}
        self._cells: dict[str, str] = {}  # by the file that the code of a run belongs to
        self._current: CellRun | None = None
        self._depth = 0  # cells that run within the current one, as by %%capture
        self._paused = 0

    def begin(self, cell: str | None, source: str = "") -> None:
        """Begin a run of `cell`, after ending what its last run has created."""
        if self._current is not None:
            self._depth += 1
            return
        run = self._current = CellRun(source, threads=_thread_ids())
        if cell is not None:
            previous, self._runs[cell] = self._runs.get(cell), run
            self._cells[source] = cell
            if previous is not None:
                self._close_all(list(previous.created.values()))

    def end(self, error: BaseException | None = None) -> None:
        """End the current run, which `error` has ended if it is given."""
        if self._depth:
            self._depth -= 1
        elif self._current is not None:
            self._current.error = type(error).__name__ if error is not None else ""
            self._current = None

    @property
    def run(self) -> CellRun | None:
        """The run that creates what this thread creates now, if any."""
        run = self._current
        return run if run is not None and not self._paused and run.owns_this_thread() else None

    def created(self, thing: Hashable, close: Close) -> None:
        """Note that the current run, if there is one, has created `thing`, which `close` ends."""
        if run := self.run:
            run.created[thing] = close

    @contextmanager
    def paused(self) -> Iterator[None]:
        """Let what is created in the block belong to no cell."""
        self._paused += 1
        try:
            yield
        finally:
            self._paused -= 1

    @contextmanager
    def check(self) -> Iterator[None]:
        """End what is created in the block after it. It takes no service's place."""
        before, self._current = self._current, CellRun(temporary=True, threads=_thread_ids())
        run = self._current
        try:
            yield
        finally:
            self._current = before
            self._close_all(list(run.created.values()))

    def later_run(self, source: str) -> CellRun | None:
        """Return the last run of the cell that the file `source` belongs to, if its code is another now."""
        run = self._runs.get(self._cells.get(source, ""))
        return run if run is not None and run.source != source else None


def _thread_ids() -> frozenset[int]:
    return frozenset(thread.ident for thread in threading.enumerate() if thread.ident is not None)


def _within_callback(frame: FrameType | None) -> bool:
    """Return whether rospy has called the function of `frame`, or one that has called it."""
    while frame is not None:
        module = str(frame.f_globals.get("__name__", ""))
        if module.startswith(CALLBACK) and frame.f_code.co_name != "__init__":
            return True
        frame = frame.f_back
    return False
