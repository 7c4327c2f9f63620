"""What is wrong with a package, where, and what to do about it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Fault:
    """One fault. `file` is relative to the workspace's src, `line` counts from 1; 0 where no line is known.

    `problem` and `remedy` are whole sentences.
    """

    problem: str
    remedy: str
    file: str = ""
    line: int = 0

    @property
    def place(self) -> str:
        """Where it is, such as "my_services/CMakeLists.txt, line 6"; empty where nobody knows."""
        return f"{self.file}, line {self.line}" if self.line else self.file

    def __str__(self) -> str:
        words = f"{self.problem} {self.remedy}"
        return f"{self.place}: {words}" if self.place else words
