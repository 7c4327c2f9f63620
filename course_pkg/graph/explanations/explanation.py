"""An explanation, and how it looks in a notebook."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape

CHAPTERS = {
    "00": "Start the graph",
    "01": "Name things and find them",
    "02": "Stream data with a topic",
    "04": "Define a service",
    "05": "Write a server",
    "06": "Write a client",
    "07": "Use the services that already exist",
    "09": "Look inside a call",
    "10": "Survive trouble",
}


@dataclass(frozen=True, repr=False)
class Explanation:
    """The cause of an error and the next step, in whole sentences that are the same in every run.

    `chapter` is the number of the chapter that teaches it, "" for none; `known` is False for words that are
    in no table.
    """

    cause: str
    remedy: str
    chapter: str = ""
    known: bool = True

    @property
    def taught(self) -> str:
        """Where it is taught, in words; "" where no chapter is meant."""
        return taught(self.chapter)

    def as_dict(self) -> dict[str, str]:
        """Return what a page shows of it."""
        return {"cause": self.cause, "remedy": self.remedy, "taught": self.taught}

    def __repr__(self) -> str:
        lines = [f"Cause: {self.cause}", f"What to do: {self.remedy}"]
        return "\n".join([*lines, f"Taught in: {self.taught}"] if self.taught else lines)

    def _repr_html_(self) -> str:
        rows = [line.partition(": ") for line in repr(self).splitlines()]
        return "".join(f"<p><b>{escape(name)}:</b> {_marked(text)}</p>" for name, _, text in rows)


def taught(chapter: str) -> str:
    """Return words for a chapter, such as "chapter 06, Write a client"; "" where no chapter is meant."""
    title = CHAPTERS.get(chapter, "")
    return f"chapter {chapter}, {title}" if title else ""


def _marked(text: str) -> str:
    """Return text as HTML in which words between backticks are code."""
    parts = escape(text).split("`")
    return "".join(f"<code>{part}</code>" if index % 2 else part for index, part in enumerate(parts))
