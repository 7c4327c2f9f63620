"""Store the printed text of a handler in the handler's service.

Otherwise, the text would appear below the cell that is running.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TextIO

LIMIT = 65536  # characters


class Printed(io.TextIOBase):
    """A text stream that stores only the last 65,536 characters."""

    def __init__(self) -> None:
        self.text = ""

    def writable(self) -> bool:
        """Return True: text can be written to this stream."""
        return True

    def write(self, text: str) -> int:
        """Append `text`; if the limit is exceeded, delete the oldest characters."""
        self.text = (self.text + text)[-LIMIT:]
        return len(text)


class RoutedStream(io.TextIOBase):
    """Replaces sys.stdout or sys.stderr. Text that a handler's thread prints is stored.

    All other text goes to the original stream, which this object replaces.

    Each thread has its own destination for text; the destination is therefore stored in a context variable.
    """

    def __init__(self, stream: TextIO, destination: ContextVar[Printed | None]) -> None:
        self.stream = stream
        self._destination = destination

    def writable(self) -> bool:
        """Return True: text can be written to this stream."""
        return True

    def write(self, text: str) -> int:
        """Write `text` to this thread's destination.

        If this thread has no destination, write to the replaced stream.
        """
        return int((self._destination.get(None) or self.stream).write(text) or 0)

    def flush(self) -> None:
        """Flush the replaced stream."""
        self.stream.flush()

    def isatty(self) -> bool:
        """Return whether the replaced stream is a terminal."""
        return bool(self.stream.isatty())

    def fileno(self) -> int:
        """Return the file descriptor of the replaced stream."""
        return int(self.stream.fileno())

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """The encoding of the replaced stream."""
        return self.stream.encoding

    @property
    def errors(self) -> str | None:  # type: ignore[override]
        """The error handler of the replaced stream for characters that it cannot encode, such as "strict"."""
        return self.stream.errors

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 -- IPython's stream has more methods
        return getattr(self.stream, name)


class HandlerOutput:
    """Stores the text that this node's handlers print between install() and remove()."""

    def __init__(self) -> None:
        self._destination: ContextVar[Printed | None] = ContextVar("handler output", default=None)

    def install(self) -> None:
        """Replace sys.stdout and sys.stderr, unless they are already replaced."""
        for name in ("stdout", "stderr"):
            stream = getattr(sys, name)
            if not isinstance(stream, RoutedStream):
                setattr(sys, name, RoutedStream(stream, self._destination))

    def remove(self) -> None:
        """Put the original streams back, unless another program has replaced them since install()."""
        for name in ("stdout", "stderr"):
            stream = getattr(sys, name)
            if isinstance(stream, RoutedStream):
                setattr(sys, name, stream.stream)

    @contextmanager
    def into(self, printed: Printed) -> Iterator[None]:
        """Store in `printed` the text that this thread prints during the block."""
        token = self._destination.set(printed)
        try:
            yield
        finally:
            self._destination.reset(token)
