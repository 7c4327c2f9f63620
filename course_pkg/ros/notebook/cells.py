"""Record the runs of a notebook's cells and the objects that each run created.

When a cell runs again, this module shuts down the objects that the cell's last run created, such as services.

A front end sends the cell's id with each execution. nbclient sends no id, so each execution without an id
counts as a separate cell.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import FrameType
from weakref import WeakSet

CALLBACK = "rospy."  # Functions of modules with this prefix call handlers and callbacks.

Close = Callable[[], None]
CloseAll = Callable[[list[Close]], None]


@dataclass
class CellRun:
    """One run of a cell, or one check of an answer.

    `source` is IPython's file name for the code of the cell.
    """

    source: str = ""
    # `temporary` is True if the run is a check. The objects that a check created are shut down at its end.
    temporary: bool = False
    error: str = ""  # This is the class name of the exception that ended the run.
    # The dict maps each created object to the function that shuts it down. The oldest object comes first.
    created: dict[Hashable, Close] = field(default_factory=dict)
    # These threads were running when the run began. Thread identifiers are not sufficient: after the end of a
    # thread, a new thread can get the same identifier.
    threads: WeakSet[threading.Thread] = field(default_factory=WeakSet)

    def owns_this_thread(self) -> bool:
        """Return whether the current thread belongs to this run, not to a handler or to an earlier cell."""
        thread = threading.current_thread()
        if thread is threading.main_thread():
            return True
        return thread not in self.threads and not _within_callback(sys._getframe())


class Cells:
    """The last run of each cell of this kernel's notebook.

    The function `close_all` shuts down the objects that a run created.
    """

    def __init__(self, close_all: CloseAll) -> None:
        self._close_all = close_all
        self._runs: dict[str, CellRun] = {}
        self._cells: dict[str, str] = {}  # The dict maps the `source` of a run to the id of its cell.
        self._current: CellRun | None = None
        # This is the number of cell runs that began inside the current run. For example, %%capture begins
        # such a run.
        self._depth = 0
        self._paused = 0

    def begin(self, cell: str | None, source: str = "") -> None:
        """Begin a run of the cell, and shut down the objects that the last run of this cell created."""
        if self._current is not None:
            self._depth += 1
            return
        run = self._current = CellRun(source, threads=WeakSet(threading.enumerate()))
        if cell is not None:
            previous, self._runs[cell] = self._runs.get(cell), run
            self._cells[source] = cell
            if previous is not None:
                self._close_all(list(previous.created.values()))

    def end(self, error: BaseException | None = None) -> None:
        """End the current run; `error` is the exception that ended the run, or None if the cell succeeded."""
        if self._depth:
            self._depth -= 1
        elif self._current is not None:
            self._current.error = type(error).__name__ if error is not None else ""
            self._current = None

    @property
    def run(self) -> CellRun | None:
        """The run that records the new objects of this thread, or None if there is no such run."""
        run = self._current
        return run if run is not None and not self._paused and run.owns_this_thread() else None

    def created(self, thing: Hashable, close: Close) -> None:
        """Record that the current run, if any, created an object; the function `close` shuts it down."""
        if run := self.run:
            run.created[thing] = close

    @contextmanager
    def paused(self) -> Iterator[None]:
        """Do not record the objects that are created in the `with` block.

        Objects that are created in the `with` block are not shut down when the cell runs again.
        """
        self._paused += 1
        try:
            yield
        finally:
            self._paused -= 1

    @contextmanager
    def check(self) -> Iterator[None]:
        """After the `with` block, shut down all objects that the block created.

        A service that is created in the `with` block does not replace a service that a cell has created.
        """
        before, self._current = self._current, CellRun(temporary=True, threads=WeakSet(threading.enumerate()))
        run = self._current
        try:
            yield
        finally:
            self._current = before
            self._close_all(list(run.created.values()))

    def later_run(self, source: str) -> CellRun | None:
        """Return the last run of a cell; `source` is IPython's file name of any run of this cell.

        If `source` belongs to the last run, return None.
        """
        run = self._runs.get(self._cells.get(source, ""))
        return run if run is not None and run.source != source else None


def _within_callback(frame: FrameType | None) -> bool:
    """Return whether rospy called the function of the stack frame, directly or indirectly."""
    while frame is not None:
        module = str(frame.f_globals.get("__name__", ""))
        if module.startswith(CALLBACK) and frame.f_code.co_name != "__init__":
            return True
        frame = frame.f_back
    return False
