"""Find the process that offers a service, because another process could replace the student's code.

A report shows the assertions of this module only if they fail.
"""

from __future__ import annotations

import time

from course_pkg.checking.commands.folder import Running
from course_pkg.checking.context import CheckContext

PAUSE = 0.7  # A server still has to offer its service after this time in s without a call.
SERVED_HERE = """
from rospy.impl.registration import get_service_manager


def served_at(name):
    service = get_service_manager().get_service(name)
    return service.uri if service else ""
"""


def require_served_by_program(
    context: CheckContext, program: Running, *services: str, itself: bool = False
) -> None:
    """Assert that the program, or one of its child processes, listens at the address of each service.

    If `itself` is true, the child processes do not count.
    """
    seen = context.look()
    for name in services:
        service = seen.service(name)
        if service is None:
            context.fail(
                "the program itself serves its services",
                expected=f"{name} in the list of services",
                actual=f"no {name}",
                hint="The service does not exist any more. Offer the service until the program ends.",
            )
        if not program.listens_at(service.uri, itself=itself):
            context.fail(
                "the program itself serves its services",
                expected="a server in the process of the program",
                actual=f"{name} is served by the node {service.node} in another process",
                hint=(
                    "Another process provides the service of the exercise. Create this service in "
                    "your program."
                ),
            )


def require_still_served(context: CheckContext, *services: str) -> None:
    """Wait for a moment, and assert that each service still exists.

    Call this function before the last call of a check: a server must still run some time after a call.
    """
    time.sleep(PAUSE)
    seen = context.look()
    for name in services:
        if seen.service(name) is None:
            context.fail(
                "the service exists until the node is stopped",
                expected=f"{name} in the list of services",
                actual=f"no {name}, {PAUSE:g} s after a call",
                hint=(
                    "The service ended some time after a call. Offer the service until the node is "
                    "stopped, and do not end the service or the node earlier."
                ),
            )


def require_served_by_notebook(context: CheckContext, *services: str) -> None:
    """Assert that the kernel's own node serves each service."""
    context.prepare(SERVED_HERE)
    for service in filter(None, map(context.look().service, services)):
        here = context.run("served_at", service.name, worded=f"rospy.Service({service.name})")
        if here.value != service.uri:
            context.fail(
                "the node of the notebook serves the service",
                expected="a server in the kernel of the notebook",
                actual=f"{service.name} is served by the node {service.node} in another process",
                hint=(
                    "Another program provides the service with the name in the exercise. Stop "
                    "that program, and create the service in your cell."
                ),
            )
