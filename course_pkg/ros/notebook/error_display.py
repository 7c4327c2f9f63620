"""Show the errors of cells, handlers, callbacks and other threads in a notebook."""

from __future__ import annotations

import logging
import sys
import threading
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from course_pkg.ros.notebook.tracebacks import HANDLER_HEADER, is_students, readable_traceback

if TYPE_CHECKING:
    from traceback import FrameSummary
    from types import TracebackType

    from IPython.core.interactiveshell import InteractiveShell

METHOD = "structured_traceback"  # IPython formats an error with this method.
DEFAULT_MODE = "Context"  # The course shortens errors only in this mode of %xmode, the default mode.
# For a SyntaxError in an imported file, an error message shows at most this many function calls.
CALLS = 2
# rospy's log messages about an exception contain this text.
TRACEBACK = "Traceback (most recent call last)"
LOGGER = "rosout"


class ErrorDisplay:
    """Shows each error in at most 12 lines; `%tb` shows the whole traceback.

    `shell` is IPython's shell.
    """

    def __init__(self, shell: InteractiveShell) -> None:
        self._shell = shell
        self._source = ""  # This is IPython's file name for the code of the current cell.
        self._all = False
        self._full: Callable[..., list[str]] = getattr(shell.InteractiveTB, METHOD)
        self._tb: Callable[[str], None] = shell.find_line_magic("tb")
        self._threads = ThreadErrors(self._place)
        setattr(shell.InteractiveTB, METHOD, self._formatted)
        self._full_syntax: Callable[..., list[str]] = getattr(shell.SyntaxTB, METHOD)
        setattr(shell.SyntaxTB, METHOD, self._formatted_syntax)
        shell.magics_manager.register_function(self._show_all, "line", "tb")

    def begin_cell(self, source: str) -> None:
        """Record that the current cell is the cell with IPython's file name `source`."""
        self._source = source
        self._threads.forget()

    def follow_threads(self) -> None:
        """Also show errors of handlers, callbacks and timers; call this method after the start of rospy."""
        self._threads.install()

    def _formatted(
        self,
        etype: type[BaseException] | None,
        evalue: BaseException | None,
        etb: TracebackType | None = None,
        *args: Any,  # noqa: ANN401 -- IPython's arguments
        **kwds: Any,  # noqa: ANN401
    ) -> list[str]:
        chosen = self._all or self._shell.InteractiveTB.mode != DEFAULT_MODE
        if chosen or not isinstance(evalue, BaseException) or isinstance(evalue, SyntaxError):
            return self._full(etype, evalue, etb, *args, **kwds)
        return readable_traceback(evalue.with_traceback(etb), self._place)

    def _formatted_syntax(
        self,
        etype: type[BaseException],
        evalue: BaseException | None,
        calls: Sequence[FrameSummary],
        *args: Any,  # noqa: ANN401
        **kwds: Any,  # noqa: ANN401
    ) -> list[str]:
        """Return a SyntaxError in IPython's format, without the frames of the import system."""
        shown = [call for call in calls if self._all or is_students(call.filename)]
        return self._full_syntax(etype, evalue, shown[-CALLS:], *args, **kwds)

    def _show_all(self, line: str) -> None:
        """Show the whole traceback of the last error."""
        self._all = True
        try:
            self._tb(line)
        finally:
            self._all = False

    def _place(self, filename: str) -> str:
        """Return the text for a file in an error message: a description of a cell, or the file's name."""
        if filename == self._source:
            return "This cell"
        kind, name = self._shell.compile.format_code_name(filename) or ("", filename)
        # In nbval, the execution count does not change, so `In[…]` does not identify a cell.
        if name == f"In[{self._shell.execution_count}]":
            return "An earlier cell"
        return f"{kind} {name}".strip()


class ThreadErrors(logging.Handler):
    """Shows an exception that rospy caught in a handler or callback, or that ended a thread."""

    def __init__(self, place_of: Callable[[str], str]) -> None:
        super().__init__(logging.WARNING)
        self._place_of = place_of
        self._shown: set[str] = set()

    def install(self) -> None:
        """Start to show the exceptions of handlers, callbacks and threads; a second call has no effect."""
        logger = logging.getLogger(LOGGER)
        if self not in logger.handlers:
            logger.addHandler(self)
        threading.excepthook = self._thread_ended

    def forget(self) -> None:
        """Delete the list of the shown errors; each error can then be shown again."""
        self._shown.clear()

    def emit(self, record: logging.LogRecord) -> None:
        """If rospy's log record is about an exception, show the exception."""
        error = sys.exc_info()[1]
        if error is not None and TRACEBACK in record.getMessage() and _in_background():
            self._show(error)

    def _thread_ended(self, ended: threading.ExceptHookArgs) -> None:
        if ended.exc_value is not None and not isinstance(ended.exc_value, SystemExit):
            self._show(ended.exc_value)

    def _show(self, error: BaseException) -> None:
        """Show the error `error`; do nothing if the cell's output already contains the same error."""
        text = "\n".join(readable_traceback(error, self._place_of, HANDLER_HEADER))
        if text not in self._shown:
            self._shown.add(text)
            sys.stderr.write(text + "\n")
            sys.stderr.flush()


def _in_background() -> bool:
    return threading.current_thread() is not threading.main_thread()
