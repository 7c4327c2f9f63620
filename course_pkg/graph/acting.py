"""An action server in a kernel, which may be begun again and does not keep the kernel from ending.

actionlib has a thread for goals that does not end with its process. So goals are taken here by the other way
that it has: http://wiki.ros.org/actionlib_tutorials/Tutorials, "Goal Callback Method".
"""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import actionlib
import rospy

ENDING = 2.0  # s for the function that is at work to notice
LOOK = 0.5  # s between looks whether rospy has ended

Execute = Callable[[Any, Any], object]


class ActionServer:
    """Serves the action `name` by `execute(goal, server)`, one goal after the other, until stop().

    `server` is an actionlib.SimpleActionServer: it takes feedback and result, and knows of a cancellation.
    One that nobody holds any more stops by itself, as when its cell is run again.
    """

    def __init__(self, name: str, kind: Any, execute: Execute) -> None:  # noqa: ANN401 -- a generated class
        self.name = str(rospy.resolve_name(name))
        self._over, self._came = threading.Event(), threading.Event()
        self._server: Any = actionlib.SimpleActionServer(name, kind, auto_start=False)
        self._server.register_goal_callback(self._came.set)
        work = (self._server, execute, self._came, self._over)  # without self, which nobody may hold then
        self._thread = threading.Thread(target=_work, args=work, daemon=True)
        self._thread.start()
        self._server.start()

    def stop(self) -> None:
        """Take the action off the graph; a goal under way is called off, and its thread left behind."""
        if self._over.is_set():
            return
        self._over.set()
        self._came.set()
        self._server.preempt_request = True
        if self._thread is not threading.current_thread():
            self._thread.join(ENDING)
        with suppress(rospy.ROSException):
            self._server.action_server.stop()

    def __del__(self) -> None:
        if not rospy.is_shutdown():
            self.stop()

    def __repr__(self) -> str:
        return f"<action {self.name}>"


def _work(server: Any, execute: Execute, came: threading.Event, over: threading.Event) -> None:  # noqa: ANN401
    """Carry out each goal that comes, until it is over."""
    while not over.is_set() and not rospy.is_shutdown():
        if not came.wait(LOOK):
            continue
        came.clear()
        while not over.is_set() and server.is_new_goal_available():
            _carry_out(server, execute, server.accept_new_goal())


def _carry_out(server: Any, execute: Execute, goal: Any) -> None:  # noqa: ANN401
    """Have a goal carried out; whatever becomes of the function, the goal ends."""
    try:
        execute(goal, server)
        words = "No terminal state was set."
    except Exception as error:  # noqa: BLE001 -- a student's function may raise anything
        rospy.logerr("%s", traceback.format_exc())
        words = f"Exception in execute callback: {error}"
    if server.is_active():
        server.set_aborted(None, words)
