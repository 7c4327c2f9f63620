"""Record in `Cells` which objects of rospy and actionlib a cell creates, and shut these objects down.

rospy has no list of its Publisher and Subscriber objects. This module therefore replaces the methods that
create these objects; each new method also records the object. A method with unexpected parameters is not
replaced.
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

GOAL_TIMEOUT = 2.0  # A goal has to end within this time in s after its cancellation.
# rospy raises one of these errors if a topic is closed, the node is shut down, or the master does not answer.
EXPECTED = (rospy.ROSException, rospy.ServiceException, AssertionError, KeyError, GraphError)
# This value replaces the address of a service that has ended. With the old address, another shutdown() of the
# ended service would unregister a newer service of this process with the same name.
UNREGISTERED = "rosrpc://unregistered:0"
LOOK = 0.5  # This is the time in s between two polls in _end_with_process().


def note_creations(cells: Cells) -> None:
    """Start to record in `cells` which objects this process creates with rospy and actionlib.

    A second call has no effect.
    """
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
    """Shut down the objects of a run, from newest to oldest.

    Action servers end before all other objects, because they publish results at their end.
    """
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
    """During the `with` block, skip unregistrations if the master does not answer.

    Otherwise, rospy would wait for ever.
    """
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
    """Return a decorator that makes an `__init__` method record the new object."""

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
    """Return whether a new service may replace the service `before`; if `before` has to end, shut it down.

    A check must not shut down the service of a cell. A check may create a second object of a student's class,
    and the `__init__` of this class may create a service. The service of the second object must not replace
    the service of the first object.
    """
    ours = _Identity(before) in run.created
    if run.temporary and not ours:
        return False
    if run.temporary or not ours:
        _close_service(before)
    if not run.temporary and not ours:
        name = before.resolved_name
        sys.stdout.write(f"The service {name} of this cell replaces the service that another cell created.\n")
    return True


def _close_service(service: ServiceImpl) -> None:
    """Shut a service down; a connected client then gets error messages."""
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
    """End an action server and cancel a running goal.

    A goal continues if its callback ignores the cancellation.
    """
    with server.terminate_mutex:
        server.need_to_terminate = True
    server.preempt_request = True
    thread = server.execute_thread
    if thread is not None and thread is not threading.current_thread():
        thread.join(GOAL_TIMEOUT)
    _close_action(server.action_server)


def _end_with_process(server: actionlib.SimpleActionServer) -> None:
    """End an action server's thread when the main thread ends.

    Otherwise, Python would wait for ever for the end of the action server's thread.
    """
    main = threading.main_thread()
    while main.is_alive() and not server.need_to_terminate:
        main.join(LOOK)
    with server.terminate_mutex:
        server.need_to_terminate = True


class _Identity:
    """A dict key that is equal to another key only if both contain the same object (`is`)."""

    def __init__(self, thing: object) -> None:
        self.thing = thing

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Identity) and other.thing is self.thing

    def __hash__(self) -> int:
        return id(self.thing)
