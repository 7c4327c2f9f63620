"""Store the text that a handler prints in the handler's service, not in the cell that is running."""

from __future__ import annotations

import io
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TextIO

LIMIT = 65536  # A `Printed` stores at most this many characters.


class Printed(io.TextIOBase):
    """A text stream that stores only the last 65,536 characters."""

    def __init__(self) -> None:
        self.text = ""

    def writable(self) -> bool:
        """Return True."""
        return True

    def write(self, text: str) -> int:
        """Append `text`; above the limit, delete the oldest characters."""
        self.text = (self.text + text)[-LIMIT:]
        return len(text)


class RoutedStream(io.TextIOBase):
    """Replaces sys.stdout or sys.stderr.

    Text that a handler's thread prints is stored. Text of all other threads goes to the original stream. The
    destination of each thread is stored in a context variable.
    """

    def __init__(self, stream: TextIO, destination: ContextVar[Printed | None]) -> None:
        self.stream = stream
        self._destination = destination

    def writable(self) -> bool:
        """Return True."""
        return True

    def write(self, text: str) -> int:
        """Write `text` to this thread's destination, or to the original stream."""
        return int((self._destination.get(None) or self.stream).write(text) or 0)

    def flush(self) -> None:
        """Flush the original stream."""
        self.stream.flush()

    def isatty(self) -> bool:
        """Return whether the original stream is a terminal."""
        return bool(self.stream.isatty())

    def fileno(self) -> int:
        """Return the file descriptor of the original stream."""
        return int(self.stream.fileno())

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """The encoding of the original stream."""
        return self.stream.encoding

    @property
    def errors(self) -> str | None:  # type: ignore[override]
        """The encoding error handler of the original stream, such as "strict"."""
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
        """Restore the original streams, unless another program has replaced them since install()."""
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
