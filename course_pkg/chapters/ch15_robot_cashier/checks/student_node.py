"""A program of the student that a check runs as a node in a namespace of the check."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from course_pkg.chapters.ch07_build_a_package.checks.program import (
    ENDINGS,
    Program,
    can_be_imported,
    is_a_script,
    is_executable,
)
from course_pkg.chapters.ch15_robot_cashier.checks.packages import MY_CASHIER, file_of, program
from course_pkg.checking import CheckContext, matches
from course_pkg.checking.commands.folder import Running
from course_pkg.checking.shared.catkin_package import BuiltPackage, copied
from course_pkg.checking.shared.own_program import require_own_nodes
from course_pkg.checking.shared.script import own_line
from course_pkg.ros import Snapshot
from course_pkg.workspace import explain

# A node must be on the graph within this time in s; it takes 1 s on an idle machine.
STARTING = 40.0
# All names of a node must exist within this time in s after its first name. A node that started late gets
# more time.
COMPLETE = 3.0
POLL = 0.1  # POLL is the time in s between two snapshots of the graph.
# The check remaps global names to this namespace, so the check detects programs that use global names.
WITH_SLASH = "with_slash"
MISSING = (
    "The node called a service that did not exist yet, and rospy.ServiceException ended the node. "
    "Catch this exception, and call the service again later."
)
OF_EVERY_NODE = ("/get_loggers", "/set_logger_level")


@dataclass(frozen=True)
class Interface:
    """The relative names of a node's services, of its published topics, and of its subscribed topics."""

    services: Sequence[str] = ()
    publishes: Sequence[str] = ()
    subscribes: Sequence[str] = ()

    @property
    def names(self) -> list[str]:
        """The names of all services and topics of the node."""
        return [*self.services, *self.publishes, *self.subscribes]

    def missing(self, seen: Snapshot, space: str, node: str) -> list[str]:
        """Return the missing names of the node `node`, such as "serves till/set"."""
        topics = {topic.name: topic for topic in seen.topics}
        served = {service.name for service in seen.services if service.node == node}
        lacking = [f"serves {name}" for name in self.services if f"{space}/{name}" not in served]
        for verb, names, side in (
            ("publishes", self.publishes, "publishers"),
            ("subscribes to", self.subscribes, "subscribers"),
        ):
            for name in names:
                topic = topics.get(f"{space}/{name}")
                if topic is None or node not in getattr(topic, side):
                    lacking.append(f"{verb} {name}")
        return lacking


@contextmanager
def student_node(
    context: CheckContext, name: str, interface: Interface, *, calls: Sequence[str] = ()
) -> Iterator[str]:
    """Start the student's program `name` with rosrun; when the node is complete, yield its namespace.

    A node is complete if all names of its interface exist.

    `calls` are the services that the program calls as a client.
    """
    package = examined(context, name)
    space = f"/{context.random.word()}"
    with started(package, name, space, [*interface.names, *calls]) as running:
        complete(context, running, program(name), space, interface)
        yield space


def examined(context: CheckContext, name: str) -> BuiltPackage:
    """Assert that the student's script can run and can be imported; return a copy of the package."""
    script = program(name)
    is_a_script(context, file_of(name))
    is_executable(context, file_of(name))
    package = copied(context, MY_CASHIER, examined=script.file)
    can_be_imported(context, package, script)
    return package


def started(
    package: BuiltPackage,
    name: str,
    space: str,
    names: Sequence[str],
    parameters: Mapping[str, float] | None = None,
) -> Running:
    """Start a program in the namespace `space`.

    The global names in `names`, such as /till/set, are remapped to names in this namespace.
    """
    remapped = [f"/{each}:={space}/{WITH_SLASH}/{each}" for each in names]
    given = [f"_{key}:={value}" for key, value in (parameters or {}).items()]
    line = f"rosrun my_cashier {name}.py"
    return package.start(
        " ".join([line, f"__ns:={space}", *remapped, *given]), worded=" ".join([line, *given])
    )


def complete(
    context: CheckContext, running: Running, script: Program, space: str, interface: Interface
) -> None:
    """Wait until the node has all names of its interface; if a name does not appear, report the reason."""
    assertion = f"rosrun starts the node {script.node} with all its services and topics"
    node = f"{space}/{script.node}"
    seen = context.look()
    started = time.monotonic()
    patience = deadline = started + STARTING
    while lacking := interface.missing(seen, space, node):
        here = _names_in(seen, space)
        if here:
            patience = min(patience, still(started, COMPLETE))
        if running.status is not None or time.monotonic() > min(deadline, patience):
            done = running.stop()
            context.fail(
                assertion,
                expected=f"a node that {lacking[0]}",
                actual=_seen(done.status, done.out, here),
                hint=_why_incomplete(script, done.status, done.out, here, lacking[0]),
            )
        time.sleep(POLL)
        seen = context.look()
    context.require(assertion, holds=True)
    require_own_nodes(context, space)


def still(started: float, least: float) -> float:
    """Return the time until which a node must have all its names; the node has its first name now.

    `least` is the minimum time in s from now. If the node has started slowly, the node gets more time.

    `started` and the result are in s of time.monotonic().
    """
    now = time.monotonic()
    return now + max(least, 3 * (now - started))


def _names_in(seen: Snapshot, space: str) -> list[str]:
    """Return the relative names of the nodes, topics and services in the namespace."""
    names = [node.name for node in seen.nodes] + [topic.name for topic in seen.topics]
    names += [service.name for service in seen.services if not service.name.endswith(OF_EVERY_NODE)]
    return [name.removeprefix(f"{space}/") for name in names if name.startswith(f"{space}/")]


def _seen(status: int | None, printed: str, here: list[str]) -> str:
    if status is None:
        return f"a program with the names {', '.join(sorted(here))}" if here else "a program without a node"
    last = printed.strip().rpartition("\n")[2]
    return f"exit status {status}{f', and {last}' if last else ', and no output'}"


def _why_incomplete(script: Program, status: int | None, printed: str, here: list[str], lacking: str) -> str:
    if status is not None:
        return why_ended(script, printed)
    with_slash = [name.removeprefix(WITH_SLASH) for name in here if name.startswith(f"{WITH_SLASH}/")]
    if with_slash:
        return (
            f"The program uses the global name {with_slash[0]}. Remove the slash at the beginning "
            "of the name."
        )
    if script.node not in here:
        return (
            f'The program did not create the right node. First call rospy.init_node("{script.node}"), '
            "without anonymous=True."
        )
    return (
        f"The program runs, but the check found no node that {lacking}. Compare your names with the "
        "names in the exercise, letter by letter."
    )


def why_ended(script: Program, printed: str) -> str:
    """Return the hint for a node that has ended."""
    for pattern, hint in ENDINGS:
        if re.search(pattern, printed):
            return hint.format(own=MY_CASHIER.name)
    if matches(r"ServiceException: service \[.*unavailable").search(printed):
        return MISSING
    if "Traceback" in printed or "Error" in printed:
        fault = explain(printed)
        return f"{fault.problem} {fault.remedy}" if fault else own_line(script.name, printed)
    return "The program reached its last line, so the node ended. Write rospy.spin() as the last line."
