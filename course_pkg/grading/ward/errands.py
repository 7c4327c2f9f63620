"""What a judge has done beside the kernel, in grading: commands run where the student's kernel cannot reach.

In class the desk runs them. Here a kernel could say of a build that it went well, or of a program that it
printed what it did not; so another process behind walls of its own does it, and reads the part's folder.
"""

from __future__ import annotations

import os
import socket
from pathlib import Path
from typing import Any

from course_pkg.errors import LinkError
from course_pkg.examiner.hands import Hands
from course_pkg.examiner.link import Link
from course_pkg.examiner.plain import Plain
from course_pkg.grading.namespaces import be_unreadable

OWN = "/tmp"  # noqa: S108 -- behind the wall, and of this process alone
ERRANDS = frozenset({"folder", "run", "start", "poll", "stop"})


def is_errand(do: object, name: object) -> bool:
    """Return whether a question is about commands and files, and not about what is in the kernel."""
    return do in ERRANDS or (do in ("look", "source") and str(name).startswith("file:"))


class SplitLink(Link):
    """The judge's end of the wire, in two: commands and files go to the errands, all else to the desk."""

    def __init__(self, desk: socket.socket, errands: socket.socket) -> None:
        super().__init__(desk)
        self._errands = Link(errands)

    def ask(self, do: str, *, timeout: float, **what: Plain) -> dict[str, Any]:
        """Ask whoever is to be believed in this."""
        if is_errand(do, what.get("name")):
            return self._errands.ask(do, timeout=timeout, **what)
        return super().ask(do, timeout=timeout, **what)


def run_errands(sock: socket.socket, folder: str, *, walls: bool) -> None:
    """Answer the judge until it hangs up."""
    if walls:
        be_unreadable()
        os.environ.update(ROS_LOG_DIR=OWN, ROS_HOME=OWN)  # the student's folder is for reading only
    link, hands = Link(sock), Hands({}, Path(folder))
    try:
        while True:
            question = link.receive()
            asked = is_errand(question.get("do"), question.get("name"))
            link.send(hands.answer(question if asked else {**question, "do": "nothing"}))
    except LinkError:
        hands.close()
