"""Functions that start the student's parcel robot.

The functions also find out whether each name of the robot is a topic, a service or an action.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

from course_pkg.checking import CheckContext
from course_pkg.checking.commands.folder import Folder, Running, telling_line
from course_pkg.ros.protocol.snapshot import Snapshot
from course_pkg.waiting import at_this_load

FILE = "parcel_robot.py"
# The program must register its first name within this time in s; it takes 1 s on an idle machine.
STARTING = 8.0
# After its first registration, the program must register all other names within this time in s.
REGISTERING = 1.5
POLL = 0.05  # POLL is the time in s between two snapshots of the graph.
FITTING = {"battery": "topic", "door": "service", "deliver": "action"}
CAPACITY = (
    'The user sets "capacity" when the robot starts, and clients never change this value. Read '
    "the value from a private parameter."
)
UNFIT = {
    "battery": (
        "Several programs need each new value of the battery, but they send no requests. Use the "
        "kind of interface that sends values without a request."
    ),
    "door": (
        "The door moves only for a short time, and the client has to know when the move is done. "
        "Use the kind of interface that returns a response after a short action."
    ),
    "deliver": (
        "The client needs progress reports, and it must be able to cancel the delivery. Use the kind "
        "of interface that offers both."
    ),
}
MISSING = 'The node offers nothing with this name. Use the three names "battery", "door" and "deliver".'
ABSOLUTE = (
    'The name is not in the namespace of the robot. Remove the "/" or "~" at the beginning of the name.'
)


@dataclass(frozen=True)
class Robot:
    """A running copy of the student's program in a separate namespace."""

    running: Running
    space: str  # `space` is the robot's namespace, such as "/abcdef".
    node: str

    def __enter__(self) -> Robot:
        return self

    def __exit__(self, *_: object) -> None:
        self.running.__exit__(None, None, None)

    def name(self, name: str) -> str:
        """Return the full name for a relative name of the robot."""
        return f"{self.space}/{name}"


def started(context: CheckContext, folder: Folder, *arguments: str) -> Robot:
    """Start the student's program with the arguments, in a random namespace, and with a random node name."""
    space, node = f"/{context.random.word()}", context.random.word()
    line = ["python", FILE, f"__ns:={space}", f"__name:={node}", *arguments]
    return Robot(folder.start(*line, worded=f"python3 {FILE}"), space, f"{space}/{node}")


def offers_what_fits(context: CheckContext, robot: Robot) -> None:
    """Wait until the robot has registered its three names; assert that each name has the right kind.

    The kind of a name is topic, service or action.
    """
    deadline = time.monotonic() + at_this_load(STARTING)
    found: dict[str, str] = {}
    while time.monotonic() < deadline:
        if robot.running.status is not None:
            _has_ended(context, robot)
        now = {name: kind_of(context.look(), robot, name) for name in FITTING}
        if now == FITTING:
            break
        if any(now.values()) and not any(found.values()):
            deadline = min(deadline, time.monotonic() + at_this_load(REGISTERING))
        found = now
        time.sleep(POLL)
    seen = context.look()
    for name, kind in FITTING.items():
        actual = kind_of(seen, robot, name)
        context.require(
            f"{name} has the right kind of interface",
            holds=actual == kind,
            expected="the right kind of interface",
            actual=f"{'an' if actual == 'action' else 'a'} {actual}" if actual else "nothing with this name",
            hints=UNFIT[name] if actual else ABSOLUTE if _elsewhere(seen, robot, name) else MISSING,
        )
    other = kind_of(seen, robot, "capacity")
    context.require(
        '"capacity" is a setting, not an interface for clients',
        holds=not other,
        expected="a parameter",
        actual=f"a {other}",
        hints=CAPACITY,
    )


def kind_of(seen: Snapshot, robot: Robot, name: str) -> str:
    """Return "topic", "service" or "action"; return "" if the robot has registered nothing with this name."""
    return _kind(seen, robot, robot.name(name))


def _kind(seen: Snapshot, robot: Robot, full: str) -> str:
    service = seen.service(full)
    if service is not None and service.node == robot.node:
        return "service"
    uses = {topic.name: robot.node in (*topic.publishers, *topic.subscribers) for topic in seen.topics}
    if uses.get(f"{full}/goal"):
        return "action"
    return "topic" if uses.get(full) else ""


def _elsewhere(seen: Snapshot, robot: Robot, name: str) -> bool:
    """Return whether the robot uses the name as an absolute or private name, instead of a relative name."""
    return bool(_kind(seen, robot, f"/{name}") or _kind(seen, robot, f"{robot.node}/{name}"))


def _has_ended(context: CheckContext, robot: Robot) -> None:
    printed = robot.running.stop().out
    context.fail(
        f"{FILE} continues to run",
        expected="a node",
        actual=f"a program that has ended, with the output: {telling_line(printed)}",
        hint=(
            "The program has ended. Correct the error in its output; if there is no error, write "
            "rospy.spin() as the last line."
        ),
    )
