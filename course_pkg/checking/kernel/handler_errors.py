"""Stores the exceptions that rospy catches in handlers; a check can then show the student's lines."""

from __future__ import annotations

import logging
import sys
from pathlib import Path

from course_pkg.ros.notebook.tracebacks import readable_traceback, students_frames

LOGGER = "rosout"
# rospy's log message about an exception in a handler begins with this text.
ABOUT = "Error processing request"
HEADER = "Traceback of the handler (most recent call last):"


class HandlerErrors(logging.Handler):
    """Stores the last exception that a handler raised in this process, between open() and close()."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self._last = ""

    def open(self) -> None:
        """Begin to store exceptions."""
        logging.getLogger(LOGGER).addHandler(self)

    def close(self) -> None:
        """Stop storing exceptions."""
        logging.getLogger(LOGGER).removeHandler(self)
        super().close()

    def emit(self, record: logging.LogRecord) -> None:
        """If the log record is about an exception in a handler, store this exception."""
        error = sys.exc_info()[1]
        if error is None or not record.getMessage().startswith(ABOUT):
            return
        # If rospy called the handler with a wrong number of arguments, the traceback contains no line of the
        # student.
        began = any(students_frames(error.__traceback__))
        self._last = "\n".join(readable_traceback(error, _place, HEADER)) if began else ""

    def take(self) -> str:
        """Return and delete the traceback of the last exception, or return ""."""
        last, self._last = self._last, ""
        return last


def _place(filename: str) -> str:
    """Return the file name for a traceback, or "Your cell" for the code of a cell."""
    path = Path(filename)
    return path.name if path.is_file() else "Your cell"
