"""The last messages of a topic, each in one line, and the latest in full."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from typing import Any

from course_pkg.interfaces import MessageType
from course_pkg.panels.forms.rows import Row, rows, summary
from course_pkg.panels.forms.texts import compact

KEPT = 10  # messages
LINES = 40  # of the latest message


class Echo:
    """Takes in what a station has heard."""

    def __init__(self) -> None:
        self._entries: deque[dict[str, Any]] = deque(maxlen=KEPT)
        self.latest: list[Row] = []

    @property
    def entries(self) -> list[dict[str, Any]]:
        """The messages, the latest first: number, ago (s, when it was told), peer, and a line of text."""
        return list(self._entries)

    def take(self, echo: Iterable[Mapping[str, Any]], kind: MessageType | None) -> None:
        """Take new messages in, oldest first."""
        for each in echo:
            lines = _rows(each, kind)
            about = {name: each[name] for name in ("number", "ago", "peer")}
            understood = lines is not None
            line = (summary(lines) or "no fields") if lines is not None else _stranger(each, kind)
            self._entries.appendleft({**about, "line": line, "understood": understood})
            if lines is not None:
                self.latest = lines


def _rows(message: Mapping[str, Any], kind: MessageType | None) -> list[Row] | None:
    if kind is None or message["texts"] is None or message["md5"] != kind.md5:
        return None
    return rows(kind.fields, compact(kind.fields, message["texts"]), LINES)


def _stranger(message: Mapping[str, Any], kind: MessageType | None) -> str:
    size = f"{message['size']:,} bytes"
    if kind is None or message["md5"] == kind.md5:
        return f"{size}, too long to be shown here" if kind else size
    return f"another type: {message['type']}, {size}"
