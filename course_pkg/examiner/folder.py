"""A folder of the check's own beside the kernel, as the judge sees it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from types import TracebackType

from course_pkg.errors import LinkError
from course_pkg.examiner.link import Link
from course_pkg.examiner.outcome import Finished

SLACK = 3.0  # s for the kernel to answer beyond what the work itself may take
ENDING = 5.0  # s for a command to end when it is asked to, or killed


class Folder:
    """Holds copies of the student's files, and the check's own; gone when the check is over.

    `doing` is told what is under way.
    """

    def __init__(
        self, link: Link, files: Sequence[str], texts: Mapping[str, str], doing: Callable[[str], None]
    ) -> None:
        self._link = link
        self._doing = doing
        answer = link.ask("folder", timeout=SLACK, files=list(files), texts=dict(texts))
        self._number = answer.get("folder")

    def command(self, *argv: str, within: float = 10.0, worded: str = "") -> Finished:
        """Run a command here; "python" stands for the kernel's own interpreter. It is ended after `within` s.

        The environment is the course's, without what the student has sourced. A report says what was run, or
        `worded` in its place.
        """
        self._doing(worded or " ".join(argv))
        what = {"argv": list(argv), "folder": self._number, "within": within}
        return Finished(self._link.ask("run", timeout=within + SLACK, **what))

    def start(self, *argv: str, worded: str = "") -> Running:
        """Start a command here that goes on until it is stopped; a context manager."""
        self._doing(worded or " ".join(argv))
        answer = self._link.ask("start", timeout=SLACK, argv=list(argv), folder=self._number)
        return Running(self._link, answer.get("process"))


class Running:
    """A command that goes on, such as a node."""

    def __init__(self, link: Link, number: object) -> None:
        self._link = link
        self._number = number

    @property
    def status(self) -> int | None:
        """The exit status, None while it runs."""
        status = self._link.ask("poll", timeout=SLACK, process=self._number).get("status")
        return status if isinstance(status, int) else None

    def stop(self) -> Finished:
        """End it; its status is None where it still ran. What it printed is in `out`, both streams."""
        return Finished(self._link.ask("stop", timeout=ENDING, process=self._number))

    def __enter__(self) -> Running:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(LinkError):  # a kernel that is gone has ended it
            self.stop()
