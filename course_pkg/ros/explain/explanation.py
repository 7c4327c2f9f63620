"""The explanation of an error, how a notebook displays it, and the table of all explanations."""

from __future__ import annotations

import re
from dataclasses import dataclass
from html import escape

from course_pkg.ros.explain.call_errors import FROM_CALLS
from course_pkg.ros.explain.graph_errors import FROM_GRAPH
from course_pkg.ros.explain.handler_errors import FROM_HANDLERS

TABLE = (*FROM_HANDLERS, *FROM_GRAPH, *FROM_CALLS)

CHAPTERS = {
    "00": "Start the graph",
    "01": "Name things and find them",
    "02": "Stream data with a topic",
    "04": "Define a service",
    "05": "Write a server",
    "06": "Write a client",
    "08": "Use the services that already exist",
    "11": "Look inside a call",
    "12": "Survive trouble",
}


@dataclass(frozen=True, repr=False)
class Explanation:
    """The cause of an error and the next step, in complete sentences that are the same in every run.

    `chapter` is the number of the chapter about this error, or "". `known` is False if no table contains the
    error.
    """

    cause: str
    remedy: str
    chapter: str = ""
    known: bool = True

    @property
    def taught(self) -> str:
        """The chapter about this error, such as "chapter 06, Write a client", or ""."""
        return taught(self.chapter)

    def as_dict(self) -> dict[str, str]:
        """Return the explanation as a dict of strings, for a page that displays it."""
        return {"cause": self.cause, "remedy": self.remedy, "taught": self.taught}

    def __repr__(self) -> str:
        lines = [f"Cause: {self.cause}", f"What to do: {self.remedy}"]
        return "\n".join([*lines, f"Taught in: {self.taught}"] if self.taught else lines)

    def _repr_html_(self) -> str:
        rows = [line.partition(": ") for line in repr(self).splitlines()]
        return "".join(f"<p><b>{escape(name)}:</b> {_marked(text)}</p>" for name, _, text in rows)


def known(message: str) -> Explanation | None:
    """Return the explanation of the error message `TypeName: message`, or None if no table contains it."""
    for pattern, cause, remedy, chapter in TABLE:
        if re.search(pattern, message):
            return Explanation(cause, remedy, chapter)
    return None


def taught(chapter: str) -> str:
    """Return the number and title of a chapter, such as "chapter 06, Write a client".

    For an unknown chapter, return "".
    """
    title = CHAPTERS.get(chapter, "")
    return f"chapter {chapter}, {title}" if title else ""


def _marked(text: str) -> str:
    """Return the text as HTML; text between backticks is shown as code."""
    parts = escape(text).split("`")
    return "".join(f"<code>{part}</code>" if index % 2 else part for index, part in enumerate(parts))
