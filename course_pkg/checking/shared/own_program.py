"""Recognise the programs of the course, because they must not earn points for the student."""

from __future__ import annotations

import time
from collections.abc import Collection

from course_pkg.checking.context import CheckContext
from course_pkg.ros.protocol.xmlrpc import NO_ANSWER, XmlRpcClient
from course_pkg.ros.trace.recording import GET_RECORD

TIMEOUT = 2.0  # A node has to respond within this time in s.


def require_own_nodes(context: CheckContext, space: str, besides: Collection[str] = ()) -> None:
    """Assert that no node in the namespace `space` is a program of the course; ignore the nodes in `besides`.

    The slave API of every program of the course has an additional method, which returns a record of calls. A
    program that uses only rospy or roscpp does not have this method. A report shows the assertion of this
    function only if the assertion fails.
    """
    for node in context.look().nodes:
        if node.name.startswith(f"{space}/") and node.name not in besides and _returns_a_record(node.uri):
            context.fail(
                "the node is your own program",
                expected="a program that does the work itself",
                actual="a program of the course",
                hint=(
                    "Your program starts or imports a program of the course. Write the code of the "
                    "node yourself."
                ),
            )


def require_kernel(context: CheckContext, nodes: Collection[str]) -> None:
    """Assert that each of `nodes` is the kernel's node, not the node of another program.

    A report shows the assertion of this function only if the assertion fails.
    """
    kernel = context.run("rospy.get_name").value
    others = [node for node in nodes if node != kernel]
    if others:
        context.fail(
            "your own code does the work",
            expected=f"the node {kernel}",
            actual=f"the node {others[0]}",
            hint=(
                "Your code starts another program, and this program does the work of the exercise. "
                "Write the code for this work in the cell, and do not start another program."
            ),
        )


def _returns_a_record(uri: str) -> bool:
    try:
        XmlRpcClient(uri, TIMEOUT).ask(GET_RECORD, "/check", time.monotonic())
    except (OSError, *NO_ANSWER):
        return False
    return True
