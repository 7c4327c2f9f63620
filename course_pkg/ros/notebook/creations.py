"""What rospy and actionlib create in a cell, noted for `Cells`, and how each of these things is ended.

rospy offers no list of its Publisher and Subscriber objects, only of the topics behind them. So the methods
that create these objects are replaced by ones that also note them; a rospy with other methods is left
unchanged.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any

import actionlib
import genpy
import rospy
from rospy.impl.registration import get_service_manager
from rospy.impl.tcpros_service import ServiceImpl
from rospy.service import ServiceManager
from rospy.timer import Timer
from rospy.topics import Topic

from course_pkg.errors import GraphError
from course_pkg.ros.notebook.cells import CellRun, Cells, Close
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.protocol.rospy_registrations import registration_manager
from course_pkg.ros.trace.hooks import Hook, Method

GOAL_TIMEOUT = 2.0  # s for a goal to end after it was told to
# What rospy raises for a topic that is closed already, or when the node has been shut down; and ours.
EXPECTED = (rospy.ROSException, rospy.ServiceException, AssertionError, KeyError, GraphError)
# The address of a service that is not served any more. With its own, shutdown() would unregister whichever
# service of this process has its name by then.
UNREGISTERED = "rosrpc://unregistered:0"
LOOK = 0.5  # s between looks whether an action server has been ended


def note_creations(cells: Cells) -> None:
    """Have `cells` note what this process creates by rospy and actionlib; a second call changes nothing."""
    simple = ("self", "name", "ActionSpec", "execute_cb", "auto_start")
    action = ("self", "ns", "ActionSpec", "goal_cb", "cancel_cb", "auto_start")
    hooks = (
        Hook(ServiceManager, "register", ("self", "resolved_service_name", "service"), _registering(cells)),
        Hook(Topic, "__init__", ("self", "name", "data_class", "reg_type"), _noting(cells, _close_topic)),
        Hook(
            Timer,
            "__init__",
            ("self", "period", "callback", "oneshot", "reset"),
            _noting(cells, Timer.shutdown),
        ),
        Hook(actionlib.ActionServer, "__init__", action, _noting(cells, _close_action)),
        Hook(actionlib.SimpleActionServer, "__init__", simple, _serving_actions(cells)),
    )
    for hook in hooks:
        if hook.fits():
            hook.install()


def close_all(closes: list[Close]) -> None:
    """End what a run has created: action servers first, since they publish results; then the newest first."""
    if not closes:
        return
    servers = [close for close in closes if _ends_goals(close)]
    others = [close for close in reversed(closes) if not _ends_goals(close)]
    with _unregistering_in_bounded_time():
        for close in (*servers, *others):
            with suppress(*EXPECTED):
                close()


def _ends_goals(close: Close) -> bool:
    return isinstance(close, partial) and close.func is _close_simple_action


@contextmanager
def _unregistering_in_bounded_time() -> Iterator[None]:
    """Keep rospy from unregistering while the master does not answer: its attempt has no time limit."""
    manager = registration_manager()
    known = getattr(manager, "master_uri", None)
    try:
        MasterClient(master_uri()).pid()
    except GraphError:
        if manager is not None:
            manager.master_uri = None
    try:
        yield
    finally:
        if manager is not None:
            manager.master_uri = known


def _noting(cells: Cells, close: Callable[[Any], None]) -> Callable[[Method], Method]:
    """Return a replacement of an `__init__` by one that notes what it creates."""

    def replace(method: Method) -> Method:
        def __init__(self: Any, *args: Any, **kwds: Any) -> None:  # noqa: ANN401, N807 -- of rospy's classes
            method(self, *args, **kwds)
            cells.created(_Identity(self), partial(close, self))

        return __init__

    return replace


def _serving_actions(cells: Cells) -> Callable[[Method], Method]:
    noting = _noting(cells, _close_simple_action)

    def replace(method: Method) -> Method:
        note = noting(method)

        def __init__(self: Any, *args: Any, **kwds: Any) -> None:  # noqa: ANN401, N807 -- of actionlib's class
            note(self, *args, **kwds)
            if self.execute_thread is not None:
                threading.Thread(target=_end_with_process, args=(self,), daemon=True).start()

        return __init__

    return replace


def _registering(cells: Cells) -> Callable[[Method], Method]:
    def replace(method: Method) -> Method:
        def register(self: ServiceManager, resolved_service_name: str, service: ServiceImpl) -> None:
            run, before = cells.run, self.get_service(resolved_service_name)
            if run is not None and before is not None and not _make_room(run, before):
                service.uri = UNREGISTERED
                return
            method(self, resolved_service_name, service)
            cells.created(_Identity(service), partial(_close_service, service))

        return register

    return replace


def _make_room(run: CellRun, before: ServiceImpl) -> bool:
    """Shut down the service of another cell, and return True; False if it has to go on, because of a check.

    A check may create a second object of a class that serves in its `__init__`. The first one still answers.
    """
    ours = _Identity(before) in run.created
    if run.temporary and not ours:
        return False
    if run.temporary or not ours:
        _close_service(before)
    if not run.temporary and not ours:
        name = before.resolved_name
        sys.stdout.write(f"This cell's service {name} replaces the one that another cell created.\n")
    return True


def _close_service(service: ServiceImpl) -> None:
    """Shut a service down; a client that is still connected is told so, and does not get the old answers."""
    if get_service_manager().get_service(service.resolved_name) is service:
        service.shutdown("its cell runs again")
    service.uri = UNREGISTERED

    def handle(_request: genpy.Message) -> None:
        raise rospy.ServiceException(
            f"{service.resolved_name} was shut down when its cell ran again. "
            "Create the persistent proxy again."
        )

    service.handler = handle


def _close_topic(topic: Topic) -> None:
    topic.unregister()


def _close_action(server: actionlib.ActionServer) -> None:
    if server.started:
        server.stop()


def _close_simple_action(server: actionlib.SimpleActionServer) -> None:
    """End an action server; a running goal is cancelled, and may outlive this call if it does not end."""
    with server.terminate_mutex:
        server.need_to_terminate = True
    server.preempt_request = True
    thread = server.execute_thread
    if thread is not None and thread is not threading.current_thread():
        thread.join(GOAL_TIMEOUT)
    _close_action(server.action_server)


def _end_with_process(server: actionlib.SimpleActionServer) -> None:
    """End the thread of an action server with the main thread: Python would wait for it for ever."""
    main = threading.main_thread()
    while main.is_alive() and not server.need_to_terminate:
        main.join(LOOK)
    with server.terminate_mutex:
        server.need_to_terminate = True


class _Identity:
    """Makes an object a key of a dict by its identity, even if its class defines equality."""

    def __init__(self, thing: object) -> None:
        self.thing = thing

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Identity) and other.thing is self.thing

    def __hash__(self) -> int:
        return id(self.thing)
