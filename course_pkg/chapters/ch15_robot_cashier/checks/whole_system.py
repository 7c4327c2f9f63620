"""15.11: the student's whole system; the check launches it, acts as a customer, and causes faults."""

from __future__ import annotations

import time
from contextlib import suppress

from course_pkg.chapters.ch15_robot_cashier.checks.launch_file import (
    FILE,
    READING,
    longest_delay,
    passes_the_argument,
    reader_line,
    starts_no_hardware,
    starts_programs,
    starts_the_hardware,
)
from course_pkg.chapters.ch15_robot_cashier.checks.packages import LAUNCH, MY_CASHIER, NODES
from course_pkg.chapters.ch15_robot_cashier.checks.peers.joint_states import JOINTS
from course_pkg.chapters.ch15_robot_cashier.checks.peers.printer import Printer
from course_pkg.chapters.ch15_robot_cashier.checks.shop import POLL, WAIT, Counter, Shop
from course_pkg.chapters.ch15_robot_cashier.checks.student_node import still
from course_pkg.checking import CheckContext, part
from course_pkg.checking.commands.folder import Running, telling_line
from course_pkg.checking.shared.catkin_package import BuiltPackage, copied
from course_pkg.ros import Snapshot
from course_pkg.ros.protocol.xmlrpc import NO_ANSWER, XmlRpcClient, items, port_of
from course_pkg.waiting import wait_until

# On a busy machine, the system may take up to this time in s to start; it takes 3 s on an idle machine.
STARTING = 40.0
# All other nodes must exist within this time in s after the first node. If the first node started late, the
# other nodes get more time.
COMPLETE = 6.0
# Killed nodes must run again within this time in s. If the start of the system took more than half of this
# time, the killed nodes get twice the start time.
BACK = 8.0
SERVICES = {
    "detect_customer": "customer_detector",
    "till/set": "till",
    "till/total": "till",
    "till/reset": "till",
}
TOPICS = {"customer_seen": "vision", "mirrored_joints": "robot_cashier", "greetings": "robot_cashier"}
SYSTEM = "roslaunch starts the whole system"

NOT_LAUNCHED = (
    "The command roslaunch ended. Type `roslaunch my_cashier cashier.launch hardware:=false` in the "
    "terminal, and read its output."
)
NOT_FOUND = (
    "roslaunch does not find a program, or its file is not executable. Compare the attribute type with the "
    "files in src/my_cashier/scripts, and type `chmod +x src/my_cashier/scripts/*.py` in the terminal."
)
RESPAWN = (
    'roslaunch did not start a node again. Add respawn="true" to the <node> tag of each of your nodes, and '
    'remove required="true".'
)
DELAYED = (
    "The attribute respawn_delay makes roslaunch wait too long before it starts a node again. Remove "
    "this attribute."
)
# This code kills the process that listens at each of the given ports. A node could return the process id of
# another process.
KILLER = """
import sys
from contextlib import suppress
import psutil
for process in psutil.process_iter():
    with suppress(psutil.Error):
        sockets = process.net_connections("tcp")
        if any(sock.status == psutil.CONN_LISTEN and str(sock.laddr.port) in sys.argv for sock in sockets):
            process.kill()
"""
RESTARTED = "roslaunch starts a killed node again"  # The text is the title of an assertion.


@part(
    "15.11",
    points=3,
    goal=(
        "Change cashier.launch: roslaunch has to restart each of your nodes if the node ends. This "
        "check then tests the whole system."
    ),
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=(
        f"%%writefile {FILE}\n"
        "<!-- Copy your file of exercise 15.10 into this cell, and change the copy. -->\n..."
    ),
    # The check starts the course's programs in place of missing programs of the student.
    runs=[*NODES, "simulator", "watch", "pictures"],
)
def the_whole_system(context: CheckContext) -> None:
    """Let customers come and leave, let the printer and the camera fail, and kill all nodes."""
    package = copied(context, MY_CASHIER, examined=LAUNCH)
    given = ["hardware:=false", f"wait:={WAIT}"]
    programs = package.start(reader_line(*given), worded="roslaunch")
    everything = package.start(reader_line(), worded="roslaunch")
    space = f"/{context.random.word()}"
    printer = Printer()
    context.serve(f"{space}/print_line", "course_pkg/PrintLine", printer.answer)
    greetings = context.subscribe(f"{space}/greetings", "std_msgs/String")
    mirrored = context.subscribe(f"{space}/mirrored_joints", JOINTS)
    seen = context.subscribe(f"{space}/customer_seen", "std_msgs/Bool")
    counter = Counter(context, f"{space}/frames")
    states = [{"name": ["a"], "position": [0.1]}]
    arm = context.publish(f"{space}/joint_states", JOINTS, states, every=0.05)
    line = " ".join(["roslaunch my_cashier cashier.launch", *given])
    with package.start(f"env ROS_NAMESPACE={space} {line}", worded=line) as running:
        took = _comes_up(context, running, space)
        wait_until(lambda: programs.status is not None, READING)
        described = programs.stop().out
        starts_programs(context, described, SYSTEM)
        starts_no_hardware(context, described, SYSTEM)
        passes_the_argument(context, described, WAIT, given)
        wait_until(lambda: everything.status is not None, READING)
        starts_the_hardware(context, everything.stop().out, SYSTEM)
        greetings.published()
        mirrored.published()
        shop = Shop(context, space, printer, greetings, seen, counter)
        shop.looks_at_frames()
        shop.serves_two_customers(mirrored, arm)
        shop.notices_a_silent_camera()
        _waits_briefly(context, longest_delay(described))
        _restarts_killed_nodes(context, package, space, max(BACK, 2 * took))
        shop.greets_after_the_restart()


def _comes_up(context: CheckContext, running: Running, space: str) -> float:
    """Wait until all services and topics exist; if a name does not appear in time, report this name.

    Return the time in s that the system needed to start.
    """
    started = time.monotonic()
    patience = deadline = started + STARTING
    while missing := _missing(seen := context.look(), space):
        if any(node.name.startswith(f"{space}/") for node in seen.nodes):
            patience = min(patience, still(started, COMPLETE))
        if running.status is not None or time.monotonic() > min(deadline, patience):
            status, printed = running.status, running.stop().out
            name, node = missing[0]
            context.fail(
                SYSTEM,
                expected=f"{name} of the node {node}",
                actual=telling_line(printed) if status is not None else f"no {name}",
                hint=NOT_FOUND
                if "Cannot locate node" in printed
                else NOT_LAUNCHED
                if status is not None
                else (
                    f"The node {node} is missing, or the node has no {name}. Go to the exercise in "
                    "which you wrote this node, and run the check of that exercise again."
                ),
            )
        time.sleep(POLL)
    context.require(SYSTEM, holds=True)
    return time.monotonic() - started


def _missing(seen: Snapshot, space: str) -> list[tuple[str, str]]:
    """Return the missing services and topics, each with the name of its node."""
    published = {(topic.name, node) for topic in seen.topics for node in topic.publishers}
    served = {(service.name, service.node) for service in seen.services if service.reachable}
    return [
        (name, node)
        for names, found in ((SERVICES, served), (TOPICS, published))
        for name, node in names.items()
        if (f"{space}/{name}", f"{space}/{node}") not in found
    ]


def _waits_briefly(context: CheckContext, delay: float) -> None:
    """Report a failure if `delay`, the time in s before roslaunch restarts a node, is too long.

    On a busy machine, the deadline for the restart is longer than `BACK`, so the check also tests the
    delay in the launch file.
    """
    if delay > BACK:
        expected = f"a restart within {BACK:g} s"
        context.fail(RESTARTED, expected=expected, actual=f"respawn_delay of {delay:g} s", hint=DELAYED)


def _restarts_killed_nodes(context: CheckContext, package: BuiltPackage, space: str, within: float) -> None:
    """Kill the four nodes; each node must run again in time as a new process.

    `within` is the time limit in s.
    """
    started = context.look()
    before = {node: _pid(started, f"{space}/{node}") for node in NODES}
    own = [started.node(f"{space}/{node}") for node in NODES]
    ports = [str(port_of(node.uri)) for node in own if node is not None]
    package.folder.command("python", "-c", KILLER, *ports, worded="kill -9 for each node")

    def dead() -> list[str]:
        seen = context.look()
        pids = {node: _pid(seen, f"{space}/{node}") for node in NODES}
        lacking = {node for _, node in _missing(seen, space)}
        return [node for node in NODES if pids[node] in (0, before[node]) or node in lacking]

    wait_until(lambda: not dead(), within, 0.2)
    lost = dead()
    context.require(
        RESTARTED,
        holds=not lost,
        expected="the four nodes of my_cashier",
        actual=f"no {', no '.join(lost)}",
        hints=RESPAWN,
    )


def _pid(seen: Snapshot, name: str) -> int:
    """Return the process id of a node, or 0 if the node does not respond."""
    node = seen.node(name)
    if node is None or not node.reachable:
        return 0
    with suppress(OSError, *NO_ANSWER):
        return int(str(items(XmlRpcClient(node.uri, 1.0).ask("getPid", "/check"))[2]))
    return 0
