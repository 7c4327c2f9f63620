"""A program that is a node: it serves until it is told to end, or asks once and prints the answer."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import rospy

from course_pkg.errors import CourseError
from course_pkg.graph.calls import BoundedProxy
from course_pkg.graph.master import master_uri
from course_pkg.graph.preparation import prepare_node
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.stepping import step_onto_graph
from course_pkg.graph.types import service_class

ENDINGS = (signal.SIGINT, signal.SIGTERM)
PATIENCE = 5.0  # s to wait for a server, and again for its answer

Offered = tuple[Any, Callable[[Any], Any]]  # a service's type and its handler


def serve_until_shutdown(node: str, services: Mapping[str, Offered]) -> None:
    """Be the node `node` and serve `services`, by name, as soon as there is a master and until Ctrl-C."""
    if not step_onto_graph(node):
        return
    with undisturbed():
        for name, (kind, handler) in services.items():
            rospy.loginfo("Serving %s", rospy.Service(name, kind, handler).resolved_name)
    rospy.spin()


@contextmanager
def undisturbed() -> Iterator[None]:
    """Put Ctrl-C off for the block: while rospy registers, it holds a lock that its end needs, too."""
    came: list[int] = []
    before = {number: signal.signal(number, lambda number, _: came.append(number)) for number in ENDINGS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        if came:
            signal.raise_signal(came[0])


def ask_once(node: str, service: str, kind: Any, *values: Any) -> Any:  # noqa: ANN401 -- a generated class
    """Be the node `node` for one call of `service`, which may come within 5 s, and return the response.

    `kind` is a class, or a type made from text. Raises ROSException when nobody serves it in time, what rospy
    raises for a failed call, CallTimeout, and MasterUnreachable at once.
    """
    MasterClient(master_uri()).pid()  # init_node would wait for a master for ever
    rospy.init_node(node)
    prepare_node()
    rospy.wait_for_service(service, timeout=PATIENCE)
    return BoundedProxy(service, service_class(kind), timeout=PATIENCE)(*values)


def print_answer(question: Callable[[], str]) -> int:
    """Print what `question` returns, or why it got no answer; return the exit status, 0 or 1."""
    try:
        print(question())  # noqa: T201 -- the program's answer
    except (rospy.ROSException, rospy.ServiceException, CourseError) as error:
        return complain(str(error), 1)
    return 0


def complain(words: str, status: int) -> int:
    """Print `words` to stderr and return `status`."""
    sys.stderr.write(f"{words}\n")
    return status
