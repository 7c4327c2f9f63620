"""Find the process that offers a service, because another process could replace the student's code.

A report shows the assertions of this module only if they fail.
"""

from __future__ import annotations

from course_pkg.checking.commands.folder import Running
from course_pkg.checking.context import CheckContext

SERVED_HERE = """
from rospy.impl.registration import get_service_manager


def served_at(name):
    service = get_service_manager().get_service(name)
    return service.uri if service else ""
"""


def require_served_by_program(context: CheckContext, program: Running, *services: str) -> None:
    """Assert that the program, or one of its child processes, listens at the address of each service."""
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
        if not program.listens_at(service.uri):
            context.fail(
                "the program itself serves its services",
                expected="a server in the process of the program",
                actual=f"{name} is served by the node {service.node} in another process",
                hint=(
                    "Another process provides the service with the name in the exercise. Create "
                    "this service in your program."
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
