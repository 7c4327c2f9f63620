"""An action server in a kernel, which a cell may create again and which does not keep the kernel from ending.

actionlib has a thread for goals that does not end with its process. So goals are accepted here by the other
way that it has: http://wiki.ros.org/actionlib_tutorials/Tutorials, "Goal Callback Method".
"""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable
from contextlib import suppress

import actionlib
import rospy

from course_pkg.ros.node.type_lookup import Message

END_TIMEOUT = 2.0  # s for a running `execute` to end after it was told to
INTERVAL = 0.5  # s between checks whether rospy has ended

Execute = Callable[[Message, actionlib.SimpleActionServer], object]


class ActionServer:
    """Serves the action `name` of type `kind` by `execute(goal, server)`, one goal after the other.

    `server` is an actionlib.SimpleActionServer: it takes feedback and result, and tells whether the goal was
    cancelled. An ActionServer ends by stop(), or when the last reference to it is gone, as when its cell runs
    again.
    """

    def __init__(self, name: str, kind: type, execute: Execute) -> None:
        self.name = str(rospy.resolve_name(name))
        self._stopped, self._goal_came = threading.Event(), threading.Event()
        self._server = actionlib.SimpleActionServer(name, kind, auto_start=False)
        self._server.register_goal_callback(self._goal_came.set)
        work = (self._server, execute, self._goal_came, self._stopped)  # no reference to self
        self._thread = threading.Thread(target=_work, args=work, daemon=True)
        self._thread.start()
        self._server.start()

    def stop(self) -> None:
        """Take the action off the graph. A running goal is cancelled; its thread may outlive this call."""
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
    """Execute each goal that comes, until the server is stopped."""
    while not stopped.is_set() and not rospy.is_shutdown():
        if not goal_came.wait(INTERVAL):
            continue
        goal_came.clear()
        while not stopped.is_set() and server.is_new_goal_available():
            _execute(server, execute, server.accept_new_goal())


def _execute(server: actionlib.SimpleActionServer, execute: Execute, goal: Message) -> None:
    """Execute a goal; it ends in a terminal state even if the function raises."""
    try:
        execute(goal, server)
        message = "No terminal state was set."
    except Exception as error:  # noqa: BLE001 -- a student's function may raise anything
        rospy.logerr("%s", traceback.format_exc())
        message = f"Exception in execute callback: {error}"
    if server.is_active():
        server.set_aborted(None, message)
