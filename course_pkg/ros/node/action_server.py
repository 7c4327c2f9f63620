"""An action server in a Jupyter kernel; you may run the cell that creates it again.

The thread of a SimpleActionServer would prevent the end of the process. This module therefore uses goal
callbacks: http://wiki.ros.org/actionlib_tutorials/Tutorials, "Goal Callback Method".
"""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable
from contextlib import suppress

import actionlib
import rospy

from course_pkg.ros.node.type_lookup import Message

END_TIMEOUT = 2.0  # After a goal was cancelled, wait up to this time in s for the end of `execute`.
INTERVAL = 0.5  # Every `INTERVAL` s, the server tests whether rospy has been shut down.

Execute = Callable[[Message, actionlib.SimpleActionServer], object]


class ActionServer:
    """Serves the action `name` of type `kind`; calls `execute(goal, server)` for one goal after another.

    `server` is an actionlib.SimpleActionServer. With this object, `execute` sends feedback and the result,
    and checks whether the goal was cancelled.

    An ActionServer ends when stop() is called, or when no variable refers to it any more. For example, this
    happens when the cell that created the ActionServer runs again.
    """

    def __init__(self, name: str, kind: type, execute: Execute) -> None:
        self.name = str(rospy.resolve_name(name))
        self._stopped, self._goal_came = threading.Event(), threading.Event()
        self._server = actionlib.SimpleActionServer(name, kind, auto_start=False)
        self._server.register_goal_callback(self._goal_came.set)
        # The thread gets no reference to `self`: such a reference would prevent Python from deleting the
        # ActionServer.
        work = (self._server, execute, self._goal_came, self._stopped)
        self._thread = threading.Thread(target=_work, args=work, daemon=True)
        self._thread.start()
        self._server.start()

    def stop(self) -> None:
        """Remove the action from the graph and cancel a running goal; the thread of the goal may continue."""
        if self._stopped.is_set():
            return
        self._stopped.set()
        self._goal_came.set()
        self._server.preempt_request = True
        if self._thread is not threading.current_thread():
            self._thread.join(END_TIMEOUT)
        with suppress(rospy.ROSException):
            self._server.action_server.stop()

    def __del__(self) -> None:
        if not rospy.is_shutdown():
            self.stop()

    def __repr__(self) -> str:
        return f"<action {self.name}>"


def _work(
    server: actionlib.SimpleActionServer,
    execute: Execute,
    goal_came: threading.Event,
    stopped: threading.Event,
) -> None:
    """Execute each goal that arrives, until the server is stopped."""
    while not stopped.is_set() and not rospy.is_shutdown():
        if not goal_came.wait(INTERVAL):
            continue
        goal_came.clear()
        while not stopped.is_set() and server.is_new_goal_available():
            _execute(server, execute, server.accept_new_goal())


def _execute(server: actionlib.SimpleActionServer, execute: Execute, goal: Message) -> None:
    """Execute a goal and set its terminal state, even if `execute` raises an exception."""
    try:
        execute(goal, server)
        message = "The function ended without a final state."
    except Exception as error:  # noqa: BLE001 -- a student's function may raise anything
        rospy.logerr("%s", traceback.format_exc())
        message = f"Exception in execute callback: {error}"
    if server.is_active():
        server.set_aborted(None, message)
