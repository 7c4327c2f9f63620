"""The node `switch`: opens, closes, and says what it did.

Its services are `~set` (std_srvs/SetBool: True opens, False closes), `~toggle` and `~report`
(std_srvs/Trigger), and `~reset` (std_srvs/Empty). It starts closed.
"""

from __future__ import annotations

import threading
from typing import Any

import rospy
from std_srvs.srv import Empty, SetBool, Trigger

from course_pkg.graph.program import serve_until_shutdown

Request = Any  # a class that catkin generates
Told = tuple[bool, str]  # success and message


class Switch:
    """A switch that several clients may ask at the same moment."""

    def __init__(self) -> None:
        self._open = False
        self._moves = 0
        self._turn = threading.Lock()

    def handle_set(self, request: Request) -> Told:
        """Go where `data` says; success is whether it moved, and the message says what it did."""
        with self._turn:
            if request.data == self._open:
                words = f"already {self._where()}"
                rospy.logdebug("Asked to move, and did not: %s", words)
                return False, words
            return True, self._moved(request.data)

    def handle_toggle(self, _: Request) -> Told:
        """Go where it is not, and say what it did."""
        with self._turn:
            return True, self._moved(not self._open)

    def handle_report(self, _: Request) -> Told:
        """Say where it stands: open or closed."""
        with self._turn:
            rospy.logdebug("Asked where it stands: %s; moves so far: %d", self._where(), self._moves)
            return True, self._where()

    def handle_reset(self, _: Request) -> list[Any]:
        """Close without a word, and count the moves from zero."""
        with self._turn:
            self._open, self._moves = False, 0
            rospy.logdebug("Reset")
        return []

    def _moved(self, to_open: bool) -> str:
        self._open = to_open
        self._moves += 1
        words = "opened" if to_open else "closed"
        rospy.loginfo("%s", words.capitalize())
        return words

    def _where(self) -> str:
        return "open" if self._open else "closed"


def main() -> None:
    """Serve until the node is shut down."""
    switch = Switch()
    services = {
        "~set": (SetBool, switch.handle_set),
        "~toggle": (Trigger, switch.handle_toggle),
        "~report": (Trigger, switch.handle_report),
        "~reset": (Empty, switch.handle_reset),
    }
    serve_until_shutdown("switch", services)
