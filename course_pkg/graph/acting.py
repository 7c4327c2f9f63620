"""An action server in a kernel, which may be begun again: actionlib's own goes on for ever.

http://wiki.ros.org/actionlib/DetailedDescription says what goes over its five topics.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import actionlib
import rospy

ENDING = 2.0  # s for the function that is at work to notice


class ActionServer:
    """Serves the action `name` by `execute(goal, server)`, one goal after the other, until stop().

    `server` is an actionlib.SimpleActionServer: it takes feedback and result, and knows of a cancellation.
    One that nobody holds any more stops by itself, as when its cell is run again.
    """

    def __init__(self, name: str, kind: Any, execute: Callable[[Any, Any], object]) -> None:  # noqa: ANN401
        server: Any = actionlib.SimpleActionServer(
            name, kind, lambda goal: execute(goal, server), auto_start=False
        )
        server.start()
        self.name = str(rospy.resolve_name(name))
        self._server = server

    def stop(self) -> None:
        """Take the action off the graph; a goal under way is asked to end, and its thread left behind."""
        server, self._server = self._server, None
        if server is None:
            return
        with server.terminate_mutex:
            server.need_to_terminate = True
        with server.lock:
            server.preempt_request = True
        server.execute_thread.join(ENDING)
        with suppress(rospy.ROSException):
            server.action_server.stop()

    def __del__(self) -> None:
        if not rospy.is_shutdown():
            self.stop()

    def __repr__(self) -> str:
        return f"<action {self.name}>"
