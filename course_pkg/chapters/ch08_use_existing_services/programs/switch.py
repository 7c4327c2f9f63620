"""The node `switch`: clients can open and close a switch, and read its position.

The services are `~set` (std_srvs/SetBool), `~toggle` and `~report` (std_srvs/Trigger), and `~reset`
(std_srvs/Empty). With `~set`, True opens the switch, and False closes it. The switch is closed at the start.
"""

from __future__ import annotations

import threading

import rospy
from std_srvs.srv import Empty, EmptyRequest, EmptyResponse, SetBool, SetBoolRequest, Trigger, TriggerRequest

from course_pkg.ros.node.program import serve_until_shutdown

Response = tuple[bool, str]  # The tuple contains the fields `success` and `message`.


class Switch:
    """A switch; several clients may call its services at the same time."""

    def __init__(self) -> None:
        self._open = False
        self._moves = 0
        self._lock = threading.Lock()

    def handle_set(self, request: SetBoolRequest) -> Response:
        """Open the switch for True, and close it for False.

        `success` says whether the switch moved, and the message describes the move.
        """
        with self._lock:
            if request.data == self._open:
                message = f"already {self._position()}"
                rospy.logdebug("A request to move had no effect: %s", message)
                return False, message
            return True, self._moved(request.data)

    def handle_toggle(self, _: TriggerRequest) -> Response:
        """Open the switch if it is closed, and close it if it is open; the message describes the move."""
        with self._lock:
            return True, self._moved(not self._open)

    def handle_report(self, _: TriggerRequest) -> Response:
        """Return the position, "open" or "closed", as the message."""
        with self._lock:
            rospy.logdebug("Position: %s; moves so far: %d", self._position(), self._moves)
            return True, self._position()

    def handle_reset(self, _: EmptyRequest) -> EmptyResponse:
        """Close the switch, and set the number of moves to zero; the response is empty."""
        with self._lock:
            self._open, self._moves = False, 0
            rospy.logdebug("Reset")
        return EmptyResponse()

    def _moved(self, to_open: bool) -> str:
        self._open = to_open
        self._moves += 1
        message = "opened" if to_open else "closed"
        rospy.loginfo("%s", message.capitalize())
        return message

    def _position(self) -> str:
        return "open" if self._open else "closed"


def main() -> None:
    """Serve until the node is shut down."""
    switch = Switch()
    serve_until_shutdown(
        "switch",
        {
            "~set": (SetBool, switch.handle_set),
            "~toggle": (Trigger, switch.handle_toggle),
            "~report": (Trigger, switch.handle_report),
            "~reset": (Empty, switch.handle_reset),
        },
    )
