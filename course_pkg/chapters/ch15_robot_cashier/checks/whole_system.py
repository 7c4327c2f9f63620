"""15.11: the student's whole system; the check launches it, acts as a customer, and causes faults."""

from __future__ import annotations

import threading
import time
from contextlib import suppress
from dataclasses import dataclass

from sensor_msgs.msg import Image

from course_pkg.chapters.ch15_robot_cashier.checks.joint_states import JOINTS
from course_pkg.chapters.ch15_robot_cashier.checks.launch_file import (
    FILE,
    READER,
    READING,
    longest_delay,
    starts_programs,
)
from course_pkg.chapters.ch15_robot_cashier.checks.packages import LAUNCH, MY_CASHIER, NODES
from course_pkg.chapters.ch15_robot_cashier.checks.printer import Printer
from course_pkg.chapters.ch15_robot_cashier.checks.refusals import refused
from course_pkg.chapters.ch15_robot_cashier.checks.student_node import still
from course_pkg.chapters.ch15_robot_cashier.checks.vision import Camera, image_of
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.commands.folder import Running, telling_line
from course_pkg.checking.peers.publisher import Publisher
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.checking.shared.catkin_package import BuiltPackage, copied
from course_pkg.ros import Snapshot
from course_pkg.ros.protocol.xmlrpc import NO_ANSWER, XmlRpcClient, items, port_of
from course_pkg.waiting import wait_until

# On a busy machine, the system may take up to this time in s to start; it takes 3 s on an idle machine.
STARTING = 40.0
# All other nodes must exist within this time in s after the first node. If the first node started late, the
# other nodes get more time.
COMPLETE = 6.0
POLL = 0.1  # POLL is the time in s between two snapshots of the graph.
REACTION = 5.0  # A greeting, a reset, or the detector's reaction to a change may take up to this time in s.
# Killed nodes must run again within this time in s. If the start of the system took more than half of this
# time, the killed nodes get twice the start time.
BACK = 8.0
EVERY = 0.1  # EVERY is the time in s between two frames.
WAIT = 1.5  # The argument `wait` has this value in s.
SERVICES = {
    "detect_customer": "customer_detector",
    "till/set": "till",
    "till/total": "till",
    "till/reset": "till",
}
TOPICS = {"customer_seen": "vision", "mirrored_joints": "robot_cashier", "greetings": "robot_cashier"}
REASON = "out of paper"
SYSTEM = "roslaunch starts the whole system"
# After the restart, the check lets up to this many customers come, until the cashier greets one of them.
VISITS = 2
MANY = 6  # MANY is the number of simultaneous calls of till/set.

NOT_LAUNCHED = (
    "The command roslaunch ended. Type `roslaunch my_cashier cashier.launch hardware:=false` in the "
    "terminal, and read its output."
)
NO_CUSTOMER = (
    "The frames show a customer, but detect_customer does not find a customer. Check exercises 15.1 and "
    "15.2 again."
)
NO_MESSAGE = (
    "The camera publishes frames, but no message arrives on customer_seen. Check exercise 15.1 again."
)
NOT_GREETED = "The detector finds the customer, but no greeting arrived. Check exercise 15.6 again."
GREETED_AGAIN = "The node greeted one customer more than once. Check exercise 15.6 again."
ADDING = (
    "After two calls of till/set at the same time, the total was not the sum of the printed lines. "
    "Check exercise 15.8 again."
)
REFUSED_ITEM = (
    "Two customers called till/set at the same time, and one call failed. Check exercise 15.8 again."
)
PRINTER = "The printer refused a line, but till/set did not refuse the item. Check exercise 15.8 again."
UNKNOWN = "The till accepted an item without a name. Check exercise 15.7 again."
COUNTED = "A refused item changed the total of the till. Check exercise 15.8 again."
NOT_RESET = "The customer has left, but the till still has items. Check exercises 15.6 and 15.9 again."
NO_MIRROR = (
    "Joint states arrived all the time, but the node published only a few mirror images. Check "
    "exercises 15.5 and 15.6 again."
)
SILENT = "No frame came for more than 1 s, but detect_customer accepted a call. Check exercise 15.3 again."
NOT_RECOVERED = (
    "New frames came after a pause, but detect_customer still refuses each call. Check exercise 15.3 again."
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
AFTERWARDS = (
    "After all nodes were killed and started again, the next customer was not greeted. Start the "
    "system, kill a node, and read the new output."
)


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
    command = f"python3 -c '{READER}' {FILE} hardware:=false"
    programs = package.start(command, worded="roslaunch")
    space = f"/{context.random.word()}"
    printer = Printer()
    context.serve(f"{space}/print_line", "course_pkg/PrintLine", printer.answer)
    greetings = context.subscribe(f"{space}/greetings", "std_msgs/String")
    mirrored = context.subscribe(f"{space}/mirrored_joints", JOINTS)
    seen = context.subscribe(f"{space}/customer_seen", "std_msgs/Bool")
    counter = Counter(context, f"{space}/frames")
    states = [{"name": ["a"], "position": [0.1]}]
    arm = context.publish(f"{space}/joint_states", JOINTS, states, every=0.05)
    line = f"roslaunch my_cashier cashier.launch hardware:=false wait:={WAIT}"
    with package.start(f"env ROS_NAMESPACE={space} {line}", worded=line) as running:
        took = _comes_up(context, running, space)
        wait_until(lambda: programs.status is not None, READING)
        described = programs.stop().out
        starts_programs(context, described, SYSTEM)
        greetings.published()
        mirrored.published()
        shop = Shop(context, space, printer, greetings, seen, counter)
        shop.looks_at_frames()
        shop.serves_two_customers(mirrored, arm)
        shop.notices_a_silent_camera()
        _waits_briefly(context, longest_delay(described))
        _restarts_killed_nodes(context, package, space, max(BACK, 2 * took))
        shop.greets_after_the_restart()


class Counter:
    """Replaces the camera above the counter.

    The object publishes a frame every 0.1 s; a frame shows one customer or no customer.
    """

    def __init__(self, context: CheckContext, topic: str) -> None:
        self._frames = {there: image_of(context, 40, 30, 500 * there) for there in (False, True)}
        self._camera = Camera(topic)
        self._shown: Image | None = self._frames[False]
        threading.Thread(target=self._publish, daemon=True).start()

    def show(self, customer: bool | None) -> None:
        """From now on, publish frames with or without a customer; None means that no frames are published."""
        self._shown = None if customer is None else self._frames[customer]

    def _publish(self) -> None:
        while True:
            if self._shown is not None:
                self._camera.send(self._shown)
            time.sleep(EVERY)


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
                hint=NOT_LAUNCHED
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


@dataclass
class Shop:
    """Uses the whole system as a customer does, and examines the reactions of the system."""

    context: CheckContext
    space: str
    printer: Printer
    greetings: Subscription
    seen: Subscription
    counter: Counter

    def service(self, name: str, kind: str, hint: str, timeout: float = 5.0) -> Service:
        """Return a proxy for a service of the system; the report shows `hint` if a call fails."""
        return self.context.service(f"{self.space}/{name}", kind, timeout=timeout, hints=[(ANYTHING, hint)])

    def looks_at_frames(self) -> None:
        """Assert that the node vision publishes a message for the next frame."""
        before = self.seen.count
        self.context.require(
            "the node vision publishes a message for each frame",
            holds=self.seen.until(lambda arrivals: len(arrivals) > before, REACTION),
            expected="a message for each frame",
            actual="no message",
            hints=NO_MESSAGE,
        )

    def knows(self, customer: bool, hint: str) -> bool:
        """Return whether detect_customer returns the value `customer` within REACTION s."""
        detect = self.service("detect_customer", "course_pkg/AwaitCustomer", hint)

        def told() -> bool:
            return bool(detect(patience=WAIT).found) == customer

        return bool(wait_until(told, REACTION, POLL))

    def serves_two_customers(self, mirrored: Subscription, arm: Publisher) -> None:
        """Let a customer come and leave.

        Between these two events, make `MANY` calls of till/set at the same time, and let the printer fail.
        """
        context = self.context
        total = self.service("till/total", "course_pkg/TillTotal", COUNTED)
        put = self.service("till/set", "course_pkg/TillSet", REFUSED_ITEM)
        images, sent = mirrored.count, len(arm.sent)
        self.counter.show(True)
        context.require(
            "the system detects a customer", holds=self.knows(True, NO_CUSTOMER), expected="found=True",
            actual="found=False", hints=NO_CUSTOMER,
        )  # fmt: skip
        self.is_greeted(1, NOT_GREETED)
        self.greetings.during(1.0)
        context.require(
            "the system greets each customer once",
            holds=self.greetings.count == 1,
            expected="1 greeting",
            actual=f"{self.greetings.count} greetings",
            hints=GREETED_AGAIN,
        )
        bought = [(context.random.word(), cents) for cents in context.random.integers(MANY, 50, 900)]
        put.at_once([{"item": item, "cents": cents} for item, cents in bought])
        wanted = sum(int(line.rpartition(" ")[2]) for line in self.printer.lines)
        context.expect(
            "two customers at the same time: the till has the sum of the printed lines",
            expected=[wanted, MANY],
            actual=[(now := total()).cents, now.items],
            hints=ADDING,
        )
        self.printer.fault = REASON
        refused(
            context,
            put,
            "if the printer fails, the till refuses the item",
            REASON,
            item="milk",
            cents=1,
            hints=PRINTER,
        )
        self.printer.fault = ""
        refused(context, put, "the till refuses an item without a name", "", item="", cents=1, hints=UNKNOWN)
        context.expect(
            "a refused item does not change the sum", expected=wanted, actual=total().cents, hints=COUNTED
        )
        self.counter.show(False)
        context.require(
            "after the visit, the till is empty",
            holds=bool(wait_until(lambda: total().items == 0, REACTION, POLL)),
            expected="0 items",
            actual=f"{MANY} items",
            hints=NOT_RESET,
        )
        images, sent = mirrored.count - images, len(arm.sent) - sent
        context.require(
            "the system mirrors the arm all the time",
            holds=images > sent / 4,
            expected=f"{sent} images",
            actual=f"{images} images",
            hints=NO_MIRROR,
        )

    def is_greeted(self, count: int, hint: str) -> None:
        """Assert that `count` greetings were published."""
        self.context.require(
            "the system greets a customer",
            holds=len(self.greetings.wait(count, REACTION)) == count,
            expected="a greeting",
            actual="none",
            hints=hint,
        )

    def notices_a_silent_camera(self) -> None:
        """Stop the frames, and assert that detect_customer refuses a call; later, publish frames again."""
        self.counter.show(None)
        time.sleep(1.4)
        detect = self.service("detect_customer", "course_pkg/AwaitCustomer", NOT_RECOVERED)
        refused(
            self.context,
            detect,
            "if the camera is silent, detect_customer refuses each call",
            "camera",
            patience=0.0,
            hints=SILENT,
        )
        self.counter.show(False)
        self.looks_at_frames()
        time.sleep(0.3)
        self.context.require(
            "when frames come again, detect_customer responds", holds=self.knows(False, NOT_RECOVERED),
            expected="found=False", actual="found=True", hints=NOT_RECOVERED,
        )  # fmt: skip

    def greets_after_the_restart(self) -> None:
        """Let customers come; the first greeting may be lost while the node and the check connect."""
        for _ in range(VISITS):
            self.counter.show(True)
            if len(self.greetings.wait(2, REACTION)) == 2:
                break
            self.counter.show(False)
            time.sleep(2 * WAIT)
        self.is_greeted(2, AFTERWARDS)


def _waits_briefly(context: CheckContext, delay: float) -> None:
    """Report a failure if `delay`, the time in s before roslaunch restarts a node, is too long.

    On a busy machine, the deadline for the restart is longer than BACK, so the check also reads the file.
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
