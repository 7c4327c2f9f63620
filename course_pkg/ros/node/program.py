"""Functions for a node program: serve until a signal arrives, or make one call and print the response."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

import rospy

from course_pkg import waiting
from course_pkg.errors import CourseError
from course_pkg.ros.node.preparation import prepare_node
from course_pkg.ros.node.proxy import BoundedProxy
from course_pkg.ros.node.type_lookup import Message, ServiceKind, service_class
from course_pkg.ros.process.master import wait_for_master
from course_pkg.ros.protocol.master_api import MasterClient, master_uri

END_SIGNALS = (signal.SIGINT, signal.SIGTERM)
TIMEOUT = 5.0  # A program waits up to 5 s until a server is registered, and then up to 5 s for the response.
INTERVAL = 0.02  # wait_until() checks its condition again after this time in s.

Offered = tuple[type, Callable[[Message], Message]]  # The class of a service, and its handler.


def start_node(name: str) -> bool:
    """Wait for a master and become the node `name`; return False if Ctrl-C ends the wait.

    Raises MalformedMasterUri if ROS_MASTER_URI is invalid, and NotAMaster if the program at this address is
    not a master.
    """
    try:
        wait_for_master(rospy.logwarn)
    except KeyboardInterrupt:
        return False
    # The start and the shutdown of rospy use the same locks, so Ctrl-C is delayed until the start has ended.
    # The signals are blocked, because rospy replaces the signal handlers during its start.
    signal.pthread_sigmask(signal.SIG_BLOCK, END_SIGNALS)
    try:
        rospy.init_node(name)
        prepare_node()
    finally:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, END_SIGNALS)
    return True


def serve_until_shutdown(node: str, services: Mapping[str, Offered]) -> None:
    """Wait for a master, start the node `node`, and offer the services until Ctrl-C.

    The keys of `services` are the names of the services.
    """
    if not start_node(node):
        return
    with undisturbed():
        for name, (cls, handler) in services.items():
            rospy.loginfo("Serving %s", rospy.Service(name, cls, handler).resolved_name)
    rospy.spin()


@contextmanager
def undisturbed() -> Iterator[None]:
    """Delay Ctrl-C until the end of the `with` block.

    While rospy calls the master, it holds a lock that its shutdown also needs. rospy calls the master when it
    registers a service or a topic, reads a parameter, or writes a log message.
    """
    came: list[int] = []
    before = {number: signal.signal(number, lambda number, _: came.append(number)) for number in END_SIGNALS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        if came:
            signal.raise_signal(came[0])


def call_once(node: str, service: str, kind: ServiceKind, *values: object) -> Message:
    """Start a node, wait up to 5 s for a service, call the service once, and return the response.

    `kind` is a service class, a ServiceType, or a name such as "std_srvs/Trigger". Raises ROSException if no
    node offers the service within 5 s, CallTimeout if the response takes longer than 5 s, and rospy's errors
    for a failed call. Raises MasterUnreachable at once if no master answers.
    """
    # This call raises an error if no master answers; init_node would wait for ever.
    MasterClient(master_uri()).pid()
    rospy.init_node(node)
    prepare_node()
    rospy.wait_for_service(service, timeout=TIMEOUT)
    return BoundedProxy(service, service_class(kind), timeout=TIMEOUT)(*values)


def print_response(call: Callable[[], str]) -> int:
    """Print the result or the error message of the function `call`, and return the exit status 0 or 1."""
    try:
        print(call())  # noqa: T201 -- the program's result
    except (rospy.ROSException, rospy.ServiceException, CourseError) as error:
        return complain(str(error), 1)
    return 0


def complain(message: str, status: int) -> int:
    """Print the message to stderr, and return the exit status `status`."""
    sys.stderr.write(f"{message}\n")
    return status


def number_parameter(name: str, default: float, least: float, most: float) -> float:
    """Return the value of a private parameter such as `_rate:=5`, in the parameter's unit.

    The program ends with an error message if the value is not a number from `least` to `most`.
    """
    with undisturbed():
        given = rospy.get_param(name, default)
    try:
        value = float(given)
    except (TypeError, ValueError):
        value = float("nan")
    if not least <= value <= most:
        allowed = f"a number from {least:g} to {most:g}"
        sys.exit(f"{rospy.resolve_name(name)} is {given!r}, but it has to be {allowed}.")
    return value


def wait_until(condition: Callable[[], object], seconds: float) -> bool:
    """Wait until the condition is true; return False after `seconds` s, or when the node is shut down."""
    outcome = waiting.wait_until(
        lambda: "met" if condition() else rospy.is_shutdown() and "shut down", seconds, INTERVAL
    )
    return outcome == "met"
