"""A namespace in which a check runs the student's program and the simulator."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress

from course_pkg.chapters.ch09_drive_turtles.checks.turtle_program import Pairs, TurtleProgram
from course_pkg.checking import CheckContext, matches
from course_pkg.checking.commands.folder import COLOUR, Running
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.result import Finished
from course_pkg.checking.shared.catkin_package import BuiltPackage
from course_pkg.checking.shared.own_program import require_own_nodes
from course_pkg.checking.shared.roscpp_program import require_no_other_program
from course_pkg.ros.protocol.xmlrpc import NO_ANSWER, XmlRpcClient
from course_pkg.waiting import at_this_load, wait_until
from course_pkg.workspace import explain

# A node must be on the graph within this time in s; it takes 1 s on an idle machine.
STARTING = 30.0
SETTLING = 4.0  # A node must serve its services within this time in s after its registration.
STOPPING = 4.0  # A program must end within this time in s after Ctrl-C; it takes 0.6 s on an idle machine.
POLL = 0.05  # POLL is the time in s between two snapshots of the graph.
SIMULATOR = "simulator"
SERVED = ("spawn", "toggle_forward", "change_rate", "change_speed", "start_stop")
TOPICS = ("turtle1/cmd_vel", "turtle1/pose", "MyTurtle/cmd_vel", "MyTurtle/pose")
LOGGERS = ("/get_loggers", "/set_logger_level")  # Every node has these services.

# A handler that raises an unexpected exception, or returns None, does not refuse a call.
REFUSED = matches(
    "responded with an error: (?!b['\"](error processing|service cannot process request: (service )?handler "
    "returned))"
)
WAITING = re.compile(r"^.*\bwaitForService: Service \[.*$", re.MULTILINE)  # roscpp itself prints these lines.
NO_MESSAGE = (
    "The program printed no message about the failure. Print a message before the program ends: in C++, the "
    "lines of waitForService are from roscpp and do not count."
)

ENDED = (
    matches("unavailable"),
    "This service was available at first, but it is not available any more. Keep the program running, and "
    "do not shut the service down.",
)

REACHED_ITS_END = (
    "The program reached its last line and ended. Use a loop that runs until the node is shut down. "
    "If the program publishes nothing, wait with rospy.spin() (in C++: ros::spin(), or "
    "ros::waitForShutdown() with an AsyncSpinner)."
)


class World:
    """A new namespace for the student's program.

    A relative name in the program, such as "spawn", is resolved in this namespace. The absolute names of the
    services in `services` and of the turtles' topics are remapped to this namespace. `turtle` is the name of
    an additional turtle.
    """

    def __init__(
        self,
        context: CheckContext,
        copy: BuiltPackage,
        program: TurtleProgram,
        *,
        turtle: str = "",
        services: Sequence[str] = SERVED,
    ) -> None:
        self._context, self._copy, self._program = context, copy, program
        self._space = f"/{context.random.word()}"
        topics = (*TOPICS, f"{turtle}/cmd_vel") if turtle else TOPICS
        remapped = " ".join(f"/{name}:={self.name(name)}" for name in (*services, *topics))
        self._arguments = f"__ns:={self._space} {remapped}"
        self._running: Running | None = None

    def name(self, relative: str) -> str:
        """Return the full name for the relative name `relative`, such as "turtle1/pose"."""
        return f"{self._space}/{relative}"

    @contextmanager
    def run(self, arguments: str = "") -> Iterator[Running]:
        """Run the student's program with arguments such as "_level:=5" during a `with` block.

        A compiled program must not start another program, and must not replace itself with another program.
        """
        line = f"{self._program.line} {self._arguments} {arguments}"
        with self._copy.start(line, worded=self._program.line) as self._running:
            yield self._running
            require_no_other_program(self._context, self._running)

    def examine(self) -> None:
        """Examine the files that the student's program executes; a server of a check may call this method."""
        if self._running:
            self._running.examine()

    def why_lost(self) -> str:
        """Return the hint for lost messages in a program that calls ros::spinOnce(), or "" otherwise."""
        source = self._context.source(f"file:{self._program.path}")
        return self._program.polling if "spinOnce" in source else ""

    def simulator(self) -> Running:
        """Start the simulator; it ends at the end of the `with` block."""
        line = f"rosrun turtlesim turtlesim_node __ns:={self._space} __name:={SIMULATOR}"
        return self._copy.start(line, worded="rosrun turtlesim turtlesim_node")

    def service(self, relative: str, kind: str, hints: Pairs = ()) -> Service:
        """Return a proxy that calls a service of the student's program."""
        self.examine()
        pairs = [*hints, ENDED, *self._program.errors]
        return self._context.service(self.name(relative), kind, hints=pairs, timeout=5.0)

    def appears(self, relative: str, within: float = STARTING) -> bool:
        """Wait until the service `relative` is registered, for at most the time `within` (s).

        Return whether the service is registered.
        """
        wanted = self.name(relative)
        return bool(wait_until(lambda: self._context.look().service(wanted), within, POLL))

    def begins(self, running: Running) -> float:
        """Wait until the student's node is on the graph or has ended.

        Return the latest time at which the node was certainly not on the graph yet (s, time.monotonic()). On
        a busy machine, a look at the graph can take more than a second.
        """
        looks = [time.monotonic()]

        def is_there() -> bool:
            looks.append(time.monotonic())
            return bool(self._own_services(loggers=True)) or running.status is not None

        wait_until(is_there, STARTING, POLL)
        return looks[-2]

    def ends(self, running: Running, within: float) -> Finished:
        """Wait up to `within` s until the student's program ends; return how the program ended."""
        wait_until(lambda: running.status is not None, within, POLL)
        return running.stop()

    def stops(self, running: Running) -> None:
        """Shut the student's node down, as rosnode kill does, and assert that the program ends.

        In a node of rospy or roscpp, this has the same effect as Ctrl-C.
        """
        for node in self._context.look().nodes:
            if node.name.startswith(f"{self._space}/") and node.name != self.name(SIMULATOR):
                with suppress(OSError, *NO_ANSWER):
                    XmlRpcClient(node.uri).ask("shutdown", "/check", "the check is over")
        ended = wait_until(lambda: running.status is not None, at_this_load(STOPPING), POLL)
        self._context.require(
            "the program can be stopped with Ctrl-C",
            holds=ended,
            expected="the program ends",
            actual="the program is still running",
            hints=(
                "Ctrl-C does not stop the program, because its loop never ends. As the condition of the "
                "loop, use `not rospy.is_shutdown()`, or `ros::ok()` in C++."
            ),
        )

    def serves(self, running: Running, *names: str) -> None:
        """Wait until the student's program serves all services in `names`.

        If a service does not appear in time, report the reason.
        """
        assertion = f"{self._program.line} starts a node that offers {_listed(names)}"
        began, seen = time.monotonic(), 0.0
        while missing := [name for name in names if self._context.look().service(self.name(name)) is None]:
            seen = seen or (time.monotonic() if self._own_services(loggers=True) else 0.0)
            now = time.monotonic()
            if running.status is not None or (seen and now > seen + SETTLING) or now > began + STARTING:
                self._serves_not(running, assertion, missing)
            time.sleep(POLL)
        self._context.require(assertion, holds=True)
        self.runs_own_program()

    def runs_own_program(self) -> None:
        """Assert that the node is the student's program, and that this program runs no other program."""
        if self._running:
            require_no_other_program(self._context, self._running)
        require_own_nodes(self._context, self._space, [self.name(SIMULATOR)])

    def _serves_not(self, running: Running, assertion: str, missing: list[str]) -> None:
        others = self._own_services(loggers=False)
        done = running.stop()
        self._context.fail(
            assertion,
            expected="a program that keeps running",
            actual=outcome(done) if done.status is not None else f"no service {_listed(missing)}",
            hint=_why_not(missing, [name for name in others if name not in SERVED])
            if done.status is None
            else why_it_ended(done),
        )

    def _own_services(self, *, loggers: bool) -> list[str]:
        """Return the relative names of the services that the student's program serves."""
        found = [each for each in self._context.look().services if each.name.startswith(f"{self._space}/")]
        simulator = self.name(SIMULATOR)
        return [
            each.name.removeprefix(f"{self._space}/")
            for each in found
            if each.node != simulator and (loggers or not each.name.endswith(LOGGERS))
        ]


def outcome(done: Finished) -> str:
    """Return a text that says how a program ended.

    The text contains the last line of the program's output.
    """
    ending = "a program that is still running" if done.status is None else f"exit status {done.status}"
    last = last_line(done)
    return f"{ending}, and {last}" if last else f"{ending}, and no output"


def last_line(done: Finished) -> str:
    """Return the last line that a program printed, or "" if the program printed nothing."""
    return COLOUR.sub("", done.out + done.err).strip().rpartition("\n")[2]


def own_message(done: Finished) -> str:
    """Return what a program printed, without the lines that roscpp prints while the program waits."""
    return WAITING.sub("", COLOUR.sub("", done.out + done.err)).strip()


def has_traceback(done: Finished) -> bool:
    """Return whether a program printed a traceback."""
    return "Traceback" in own_message(done)


def failure(done: Finished) -> str:
    """Return the text for the report about how a program failed: its traceback, or its exit status."""
    return f"a traceback, with the last line {last_line(done)}" if has_traceback(done) else outcome(done)


def fails_with_one(done: Finished) -> bool:
    """Return whether a program ended with exit status 1 and with its own message, but without a traceback."""
    return done.status == 1 and bool(own_message(done)) and not has_traceback(done)


def why_it_ended(done: Finished) -> str:
    """Return the hint for a program that has ended, but must continue to run."""
    if fault := explain(done.out + done.err):
        return f"{fault.problem} {fault.remedy}"
    if "rror" in done.out + done.err:
        return (
            "The program stopped with an error. Run the program in a terminal, and read the lines above "
            "this error message: in Python, they show where in your code the error occurred."
        )
    return REACHED_ITS_END


def _listed(names: tuple[str, ...] | list[str]) -> str:
    return ", ".join(f"/{name}" for name in names)


def _why_not(missing: list[str], others: list[str]) -> str:
    if others:
        return (
            f"The node offers {_listed(others)}. Compare each of these names with the names in the "
            "exercise, letter by letter."
        )
    return (
        f"The node runs, but it does not offer {_listed(missing)}. Create the service before the loop begins."
    )
