"""The object through which a check uses the student's servers, topics, functions and values."""

from __future__ import annotations

import difflib
import signal
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from types import TracebackType
from typing import NoReturn, overload

from course_pkg.checking.assertions import AssertionFailed, Hints, Results, hint_for, same
from course_pkg.checking.channel import Channel, require_current
from course_pkg.checking.commands.folder import SLACK, Folder
from course_pkg.checking.formatting import shown
from course_pkg.checking.peers.faulty_server import FaultyServer, Work
from course_pkg.checking.peers.node import FakeNode, Node, held_back
from course_pkg.checking.peers.processor_time import time_of_process
from course_pkg.checking.peers.publisher import Publisher
from course_pkg.checking.peers.scripted_server import Absent, Script, ScriptedServer
from course_pkg.checking.peers.service_calls import TIMEOUT, Service
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.checking.placed.host import PlacedObjects
from course_pkg.checking.plain_values import Item, ServiceClass, Value, of_kind, plain
from course_pkg.checking.random_inputs import RandomInputs
from course_pkg.checking.result import Finished, Result
from course_pkg.errors import ChannelError, CheckError, GraphError
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.ros.protocol.probe import header_fields
from course_pkg.ros.protocol.snapshot import Snapshot, look
from course_pkg.types import message_type, service_type
from course_pkg.waiting import at_this_load

# These exceptions may end a check; any other exception is a bug in the check.
RETURNS = 5.0  # On an idle machine, a function of the student has to return within this time in s.
KNOWN = (AssertionFailed, ChannelError, CheckError)


class CheckContext:
    """One run of a check.

    The first failed assertion ends the run, or only the `goal` block that contains the assertion. At the end
    of the run, all servers, topics and folders of the run are closed.
    """

    def __init__(
        self,
        check: str,
        channel: Channel,
        node: Node,
        seed: int,
        kernel: Callable[[], int] | None = None,
    ) -> None:
        self.random = RandomInputs(f"{seed}:{check}")
        self.doing = ""  # The report shows this text if the check is too slow.
        self._channel = channel
        self._node = node
        self._kernel = kernel
        self._results = Results()
        self._open = ExitStack()
        self._placed: PlacedObjects | None = None

    @property
    def results(self) -> Results:
        """The assertions that were checked, and the goals that were marked."""
        return self._results

    # -- the goals of a part, for partial credit

    def fulfilled(self, goal: str) -> None:
        """Mark a goal of the part as fulfilled: the goal earns its points even if a later assertion fails.

        Call this method after the assertions of the goal: if an assertion fails, the run ends before this
        call. Call this method for the main goal of a part first. A program that does nothing then earns no
        points for a later goal. If a `goal` block has also examined this goal, the assertions of the block
        must hold, too.
        """
        self._results.marked.add(goal)

    @contextmanager
    def goal(self, goal: str) -> Iterator[None]:
        """Examine a goal that does not depend on other goals; a failed assertion ends only this goal.

        The goal may be examined several times, such as in a loop. A goal earns its points if all its
        assertions hold, and if the check runs completely.
        """
        try:
            yield
        except AssertionFailed:
            self._results.goal_ended(goal, fulfilled=False)
        else:
            self._results.goal_ended(goal, fulfilled=True)

    # -- assertions

    def expect(
        self, assertion: str, *, expected: Value, actual: Value, near: float = 0.0, hints: Hints = ()
    ) -> None:
        """Assert that `actual` equals `expected`; the absolute or relative error may be up to `near`.

        `assertion` is the title of the assertion in the report. `hints` say what to do about a wrong value:
        one hint for any value, or a list of pairs (condition, hint). The first condition that matches
        `actual` selects the hint. A condition is a wrong value, a pattern made by `matches`, or a function of
        the actual value. Raises AssertionFailed; a check must not catch this exception.
        """
        wanted, found = plain(expected), plain(actual)
        if not same(wanted, found, near):
            hint = hint_for(hints, found, near)
            self._results.fails(assertion, expected=shown(wanted), actual=shown(found), hint=hint)
        self._results.passes(assertion)

    def require(
        self, assertion: str, *, holds: bool, expected: str = "", actual: Value = "", hints: Hints = ()
    ) -> None:
        """Assert that `holds` is true; a report shows the text `expected` and the value `actual`.

        `hints` have the same format as in `expect`. Raises AssertionFailed; a check must not catch this
        exception.
        """
        if not holds:
            found = plain(actual)
            text = found if isinstance(found, str) else shown(found)
            self._results.fails(assertion, expected=expected, actual=text, hint=hint_for(hints, found))
        self._results.passes(assertion)

    def fail(self, assertion: str, *, expected: str = "", actual: str = "", hint: str = "") -> NoReturn:
        """Record that `assertion` does not hold, and end the check by raising AssertionFailed."""
        self._results.fails(assertion, expected=expected, actual=actual, hint=hint)

    # -- the student's servers

    def service(
        self, name: str, kind: str | ServiceClass, *, hints: Hints = (), timeout: float = TIMEOUT
    ) -> Service:
        """Return the service `name` of the type `kind`, ready to be called.

        Each call takes at most `timeout` s.

        `kind` is a type's name, or a class. Asserts that a server of this type is registered and responds.
        `hints` are for the error message of a failed call; for ROS's own error messages, no hints are needed.
        """
        self.doing = f"waiting for {name}"
        label = "the service" if self.random.made(name) else name
        cls = self.service_class(kind) if isinstance(kind, str) else kind
        assertion = f"{label} is served with the type {cls._type}"
        actual = self._type_of(name, assertion)
        if actual != cls._type:
            hint = (
                "The service has the wrong type. Create the service with the type in the exercise: "
                f"{cls._type}."
            )
            self._results.fails(assertion, expected=cls._type, actual=actual, hint=hint)
        self._results.passes(assertion)
        require_current(self._channel.ask("served", timeout=SLACK, name=name))
        return Service(self._results, name, cls, label, hints, timeout, self._handlers_traceback)

    def _handlers_traceback(self) -> str:
        return str(self._channel.ask("traceback", timeout=SLACK).get("text") or "")

    def _type_of(self, name: str, assertion: str) -> str:
        probe = self._node.probe(name)
        if probe is None:
            alike = difflib.get_close_matches(name, self._node.services(), n=1)
            hint = (
                "The service does not exist. Run the cell that creates the rospy.Service, and run "
                "it again after each restart of the kernel."
            )
            hint = (
                (
                    f"The graph contains a service with a similar name, {alike[0]}. Compare this name "
                    "letter by letter with the name in the exercise."
                )
                if alike
                else hint
            )
            actual = "no server"
            self._results.fails(assertion, expected="a server", actual=actual, hint=hint)
        if not probe.answered:
            hint = (
                "The service is registered, but its server does not respond. Run the cell "
                "that creates the service again."
            )
            actual = f"a server that is {probe.reach.value}"
            self._results.fails(assertion, expected="a server", actual=actual, hint=hint)
        return header_fields(probe.answer).get("type", "no type")

    def service_class(self, kind: str) -> ServiceClass:
        """Return the class of the service type `kind`, such as "course_pkg/geometry"."""
        return service_type(kind).cls

    def look(self) -> Snapshot:
        """Return a snapshot of the graph: its nodes, topics and services."""
        return look()

    # -- servers and topics for the student's client

    def serve(self, name: str, kind: str | ServiceClass, script: Script) -> ScriptedServer:
        """Offer the service `name` with the function `script` until the check ends.

        See peers/scripted_server.py.

        `kind` is a type's name, or a class. After the check, the former server is registered again.
        """
        cls = self.service_class(kind) if isinstance(kind, str) else kind
        return self._open.enter_context(ScriptedServer(self._node, name, cls, script))

    def faulty(self, name: str, kind: str, work: Work) -> FaultyServer:
        """Offer the service `name` with the handler `work` and with planned faults.

        See peers/faulty_server.py.
        """
        server = FaultyServer(self._node, name, self.service_class(kind), work)
        self._open.enter_context(server)
        return server

    def absent(self, name: str, *, stale: bool = False, host: str = "localhost") -> Absent:
        """Unregister the server of the service `name` until the check ends.

        If `stale` is true, register the address of a closed port of `host` for the service.
        """
        return self._open.enter_context(Absent(self._node, name, stale=stale, host=host))

    def publish(
        self,
        topic: str,
        kind: str,
        messages: Iterable[Mapping[str, Value]],
        *,
        every: float = 0.05,
        once: bool = False,
    ) -> Publisher:
        """Publish `messages` repeatedly; the time between two messages is `every` s.

        Each message is a dict of its fields, and `kind` is the name of its type.

        If `once` is true, publish each message only once, and begin as soon as there is a subscriber.
        """
        return self._open.enter_context(
            Publisher(
                self._results,
                topic,
                message_type(kind).cls,
                messages,
                every=every,
                once=once,
                label=self._label(topic),
            )
        )

    def fake_node(
        self, name: str, topic: str, kind: str, *, alive: bool = True, reused: bool = False
    ) -> FakeNode:
        """Register a node without a process as a publisher of the topic `topic`.

        If `alive` is true, the node responds to a ping; otherwise, it looks like a killed node. If `alive` is
        false, the node seems to be killed.
        """
        return self._open.enter_context(FakeNode(self._node, name, topic, kind, alive=alive, reused=reused))

    # -- the student's topics

    def subscribe(self, topic: str, kind: str) -> Subscription:
        """Subscribe to the topic `topic` until the check is over; see peers/subscription.py.

        Subscribe before the student's function publishes, because a late subscriber misses messages.
        """
        cls, label = message_type(kind).cls, self._label(topic)
        return self._open.enter_context(Subscription(self._results, self._node, topic, cls, label))

    def _label(self, topic: str) -> str:
        """Return the name of the topic for titles of assertions; it is the same in every run."""
        return "the topic" if self.random.made(topic) else topic

    # -- the student's functions, values and files

    def run(
        self,
        function: str,
        *args: Value,
        within: float | None = None,
        hints: Hints = (),
        worded: str = "",
        **kwargs: Value,
    ) -> Result:
        """Call the student's function in the kernel, and interrupt it after its time limit `within` (s).

        If `within` is not given, the time limit is 5 s on an idle machine, and more on a busy machine. A
        report shows the call as Python code, or the text `worded` instead.
        """
        label = worded or f"{function}()"
        self.doing = f"waiting for {label}"
        call = worded or _as_call(function, args, kwargs)
        self._results.asked = lambda: call
        values = [_sent(value) for value in args]
        named = {key: _sent(value) for key, value in kwargs.items()}
        within = at_this_load(RETURNS) if within is None else within
        started = time.monotonic()
        reply = self._channel.ask(
            "call", timeout=within + SLACK, name=function, args=values, kwargs=named, within=within
        )
        # The check runner measures the duration itself, because it does not trust the kernel.
        took = time.monotonic() - started
        return Result(self._results, label, reply, took, hints)

    def prepare(self, code: str, within: float = 5.0) -> None:
        """Run the check's own `code` in the kernel, separately from the student's names.

        The student's function can get an object that this code defines: `context.run("close",
        Its("service"))` passes the object `service`. The student's code can modify these objects. Store the
        check's data in an object that place() makes available. Raises CheckError if the code fails.
        """
        error = self._channel.ask("prepare", timeout=within + SLACK, code=code, within=within).get("error")
        if error:
            text = error.get("text") if isinstance(error, dict) else error
            raise CheckError(f"The check could not prepare the kernel ({text}). Restart the kernel.")

    def place(self, name: str, item: object) -> None:
        """Define the name `name` in the kernel as a proxy for an object of this process; see checking/placed.

        The proxy has the methods and attributes that the class of `item` declares with `@remote`. The proxy
        can be an argument of the student's function, such as in `context.run("move", Its("shelf"))`. The code
        of `prepare` can also use the proxy. If the student's code must not change some data, store them in
        the object `item`, not in variables of the code of `prepare`.
        """
        if self._placed is None:
            self._placed = self._open.enter_context(PlacedObjects())
        self._channel.ask("place", timeout=SLACK, name=name, **self._placed.place(item))

    def processor_time(self) -> float:
        """Return the CPU time in s that the kernel has used so far.

        This process measures the time, because the student's code can change a time that the kernel reports.
        If the process of the kernel is not known, the result is 0.
        """
        return time_of_process(self._kernel()) if self._kernel else 0.0

    def command(self, *argv: str, files: Sequence[str] = (), within: float = 10.0) -> Finished:
        """Run a command on the kernel's computer, in a new folder with copies of the student's `files`.

        The command "python" starts the kernel's own interpreter. After the time limit `within` (s), the
        command is stopped.
        """
        return self.folder(files=files).command(*argv, within=within)

    def folder(self, *, files: Sequence[str] = (), texts: Mapping[str, str] | None = None) -> Folder:
        """Return a new folder, on the kernel's computer, with copies of the student's files and folders.

        `texts` maps the path of each of the check's own files to its content. If a copy has the same path,
        the check's own file replaces it.
        """
        return Folder(self._channel, files, texts or {}, self.under_way)

    def under_way(self, call: str) -> None:
        """Show `call` in a report as the last call of the check.

        Use this method before a call that does not use any other method of the context.
        """
        self.doing = f"waiting for {call}"
        self._results.asked = lambda: call

    def has(self, name: str) -> bool:
        """Return whether the student has defined `name`."""
        return self._channel.ask("look", timeout=SLACK, name=name).get("kind") != "missing"

    @overload
    def read(self, name: str) -> Json: ...
    @overload
    def read(self, name: str, kind: type[Item]) -> Item: ...
    def read(self, name: str, kind: type[Item] | None = None) -> Json | Item:
        """Return the value of the student's variable `name`, as plain data.

        If the check's own code has set the variable, pass the expected class as `kind`. In this case,
        CheckError is raised for a value of another class.
        """
        value = self._channel.ask("read", timeout=SLACK, name=name).get("value")
        return value if kind is None else of_kind(kind, value, name)

    def source(self, name: str) -> str:
        """Return the source of the student's function or class `name`, or of "file:PATH"."""
        return str(self._channel.ask("source", timeout=SLACK, name=name).get("text", ""))

    # -- closing

    def __enter__(self) -> CheckContext:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with held_back(signal.SIGTERM):
            self._open.close()
            with suppress(GraphError):  # If the master has ended, no registrations exist.
                self._node.forget_topics(self.random.made)
        if isinstance(error, Exception) and not isinstance(error, KNOWN):
            text = f"{type(error).__name__}: {error}"
            raise CheckError(
                f"The check itself has a bug ({text}). Your answer is not the cause: please tell "
                "your instructor."
            ) from error


@dataclass(frozen=True)
class Its:
    """An argument for `CheckContext.run`. The kernel replaces it with the value of `name`."""

    name: str

    def __repr__(self) -> str:
        return self.name


def _sent(value: Value) -> Json:
    return {"its": value.name} if isinstance(value, Its) else plain(value)


def _as_call(function: str, args: tuple[Value, ...], kwargs: dict[str, Value]) -> str:
    values = [repr(value) for value in args] + [f"{key}={value!r}" for key, value in kwargs.items()]
    return f"{function}({', '.join(values)})"
