"""An action server in a kernel: a cell may create it again, and the kernel can end while it exists.

actionlib's own thread for goals would keep the process running. This module therefore uses actionlib's
second method: http://wiki.ros.org/actionlib_tutorials/Tutorials, "Goal Callback Method".
"""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable
from contextlib import suppress

import actionlib
import rospy

from course_pkg.ros.node.type_lookup import Message

END_TIMEOUT = 2.0  # s for a running `execute` to end after its goal was cancelled
INTERVAL = 0.5  # s between checks if rospy has ended

Execute = Callable[[Message, actionlib.SimpleActionServer], object]


class ActionServer:
    """Serves the action `name` of type `kind`: calls `execute(goal, server)` for one goal after the other.

    `server` is an actionlib.SimpleActionServer: `execute` sends feedback and the result through it, and
    asks it if the goal was cancelled. An ActionServer ends with stop(), or when no variable refers to it.
    This happens, for example, when its cell runs again.
    """

    def __init__(self, name: str, kind: type, execute: Execute) -> None:
        self.name = str(rospy.resolve_name(name))
        self._stopped, self._goal_came = threading.Event(), threading.Event()
        self._server = actionlib.SimpleActionServer(name, kind, auto_start=False)
        self._server.register_goal_callback(self._goal_came.set)
        # With a reference to self, the thread would keep this object alive, and __del__ would never run.
        work = (self._server, execute, self._goal_came, self._stopped)
        self._thread = threading.Thread(target=_work, args=work, daemon=True)
        self._thread.start()
        self._server.start()

    def stop(self) -> None:
        """Remove the action from the graph; a running goal is cancelled, but its thread may run longer."""
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
    """Execute a goal, and set a terminal state even if the student's function raises an exception."""
    try:
        execute(goal, server)
        message = "No terminal state was set."
    except Exception as error:  # noqa: BLE001 -- a student's function may raise anything
        rospy.logerr("%s", traceback.format_exc())
        message = f"Exception in execute callback: {error}"
    if server.is_active():
        server.set_aborted(None, message)
