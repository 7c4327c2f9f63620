"""What a handler prints, kept with the handler instead of under whichever cell runs at the time."""

from __future__ import annotations

import io
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

LIMIT = 65536  # characters kept


class Printed(io.TextIOBase):
    """The end of what was written, as text."""

    def __init__(self) -> None:
        self.text = ""

    def writable(self) -> bool:
        """Say yes, as print() expects."""
        return True

    def write(self, text: str) -> int:
        """Keep `text`, and as much of what came before as there is room for."""
        self.text = (self.text + text)[-LIMIT:]
        return len(text)


class RoutedStream(io.TextIOBase):
    """In front of sys.stdout or sys.stderr: a handler's thread writes to its own place, others through.

    The place is a context variable, so it holds for a handler's thread and not for threads beside it.
    """

    def __init__(self, through: Any, place: ContextVar[Printed | None]) -> None:  # noqa: ANN401 -- as sys.stdout is
        self.through = through
        self._place = place

    def writable(self) -> bool:
        """Say yes, as print() expects."""
        return True

    def write(self, text: str) -> int:
        """Write where this thread's output belongs."""
        return int((self._place.get(None) or self.through).write(text) or 0)

    def flush(self) -> None:
        """Flush what is behind."""
        self.through.flush()

    def isatty(self) -> bool:
        """Say what the stream behind says."""
        return bool(self.through.isatty())

    def fileno(self) -> int:
        """Return the descriptor of the stream behind."""
        return int(self.through.fileno())

    @property
    def encoding(self) -> Any:  # type: ignore[override]  # noqa: ANN401
        """The encoding of the stream behind."""
        return self.through.encoding

    @property
    def errors(self) -> Any:  # type: ignore[override]  # noqa: ANN401
        """How the stream behind treats what it cannot encode."""
        return self.through.errors

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 -- IPython's stream has methods of its own
        return getattr(self.through, name)


class HandlerOutput:
    """Routes what this node's handlers print, between install() and remove()."""

    def __init__(self) -> None:
        self._place: ContextVar[Printed | None] = ContextVar("handler output", default=None)

    def install(self) -> None:
        """Put the routes in front of sys.stdout and sys.stderr, unless they are there."""
        for name in ("stdout", "stderr"):
            stream = getattr(sys, name)
            if not isinstance(stream, RoutedStream):
                setattr(sys, name, RoutedStream(stream, self._place))

    def remove(self) -> None:
        """Take the routes away, unless somebody has put another stream in front since."""
        for name in ("stdout", "stderr"):
            stream = getattr(sys, name)
            if isinstance(stream, RoutedStream):
                setattr(sys, name, stream.through)

    @contextmanager
    def into(self, printed: Printed) -> Iterator[None]:
        """Have what this thread prints go to `printed`."""
        token = self._place.set(printed)
        try:
            yield
        finally:
            self._place.reset(token)
