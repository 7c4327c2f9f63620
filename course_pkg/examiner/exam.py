"""What an author's check works with: the student's servers, functions and values, and the rules for them."""

from __future__ import annotations

import difflib
import signal
import time
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from types import TracebackType
from typing import TYPE_CHECKING, NoReturn

from course_pkg.errors import ExamError, GraphError
from course_pkg.examiner.calls import PATIENCE, Service
from course_pkg.examiner.draw import Draw
from course_pkg.examiner.faults import FaultyServer, Work
from course_pkg.examiner.folder import SLACK, Folder
from course_pkg.examiner.hearing import Hearing
from course_pkg.examiner.ledger import Hints, Ledger, RuleBroken, hint_for, same
from course_pkg.examiner.link import Link
from course_pkg.examiner.node import Node, held_back
from course_pkg.examiner.outcome import Finished, Outcome
from course_pkg.examiner.plain import Plain, ServiceClass, Value, plain
from course_pkg.examiner.publishing import Publishing
from course_pkg.examiner.puppet import Puppet
from course_pkg.examiner.report import Rule
from course_pkg.examiner.scripted import Absent, Script, ScriptedServer
from course_pkg.examiner.show import shown
from course_pkg.graph.probe import header_fields
from course_pkg.graph.snapshot import Snapshot, look
from course_pkg.interfaces import message_type, service_type

if TYPE_CHECKING:
    from course_pkg.examiner.parts import Part


class Exam:
    """One examination. The first rule that does not hold ends it; what it opened is closed after it."""

    def __init__(self, part: Part, link: Link, node: Node, seed: int) -> None:
        self.draw = Draw(f"{seed}:{part.check}")
        self.doing = ""  # what a deadline would find it at
        self._link = link
        self._node = node
        self._ledger = Ledger()
        self._open = ExitStack()

    @property
    def rules(self) -> tuple[Rule, ...]:
        """The rules looked at so far."""
        return self._ledger.rules

    # -- rules

    def expect(
        self,
        rule: str,
        *,
        expected: Value,
        seen: Value,
        near: float = 0.0,
        hints: Hints = (),
    ) -> None:
        """Hold to `rule` that `seen` equals `expected`; numbers may differ by `near`, absolute or relative.

        `hints` say what to do about wrong values that can be recognised: a text for any, or a dict (or
        pairs) from a wrong value, a pattern made by `says`, or a predicate on what was seen, to a text.
        """
        wanted, found = plain(expected), plain(seen)
        if not same(wanted, found, near):
            hint = hint_for(hints, found, near)
            self._ledger.fails(rule, expected=shown(wanted), seen=shown(found), hint=hint)
        self._ledger.passes(rule)

    def hold(
        self, rule: str, holds: bool, *, expected: str = "", seen: Value = "", hints: Hints = ()
    ) -> None:
        """Hold to `rule` whatever `holds` says; `expected` is worded by the author."""
        if not holds:
            found = plain(seen)
            words = found if isinstance(found, str) else shown(found)
            self._ledger.fails(rule, expected=expected, seen=words, hint=hint_for(hints, found))
        self._ledger.passes(rule)

    def fail(self, rule: str, *, expected: str = "", seen: str = "", hint: str = "") -> NoReturn:
        """Note that `rule` does not hold, and end the check."""
        self._ledger.fails(rule, expected=expected, seen=seen, hint=hint)

    # -- the student's servers, seen from the graph

    def service(
        self, name: str, kind: str | ServiceClass, *, hints: Hints = (), timeout: float = PATIENCE
    ) -> Service:
        """Return the service `name` of type `kind`, ready to be called; each call takes at most `timeout` s.

        `kind` is a type's name, or a class. Its rule: somebody serves it, is alive, and serves that type.
        `hints` recognise the words of a failed call; ROS's own words are explained without them.
        """
        self.doing = f"waiting for {name}"
        label = "the service" if self.draw.made(name) else name
        cls = self.service_class(kind) if isinstance(kind, str) else kind
        rule = f"{label} is served as {cls._type}"
        seen = self._type_of(name, rule)
        if seen != cls._type:
            hint = f"Serve it with the type that the exercise names: {cls._type}."
            self._ledger.fails(rule, expected=cls._type, seen=seen, hint=hint)
        self._ledger.passes(rule)
        return Service(self._ledger, name, cls, label, hints, timeout)

    def _type_of(self, name: str, rule: str) -> str:
        probe = self._node.probe(name)
        if probe is None:
            alike = difflib.get_close_matches(name, self._node.services(), n=1)
            hint = "Run the cell that serves it, also after each restart of the kernel."
            hint = f"There is {alike[0]}: compare the names letter by letter." if alike else hint
            self._ledger.fails(rule, expected="a server", seen="nobody who serves it", hint=hint)
        if not probe.answered:
            hint = "The master lists a server that is gone or stopped. Run the cell that serves it again."
            self._ledger.fails(rule, expected="a server", seen=f"one that is {probe.reach.value}", hint=hint)
        return header_fields(probe.answer).get("type", "no type")

    def service_class(self, kind: str) -> ServiceClass:
        """Return the class of the service type `kind`, such as "course_pkg/geometry"."""
        return service_type(kind).cls

    def look(self) -> Snapshot:
        """Return who is on the graph, and who publishes, subscribes and serves what."""
        return look()

    # -- servers and topics for the student's client

    def serve(self, name: str, kind: str | ServiceClass, script: Script) -> ScriptedServer:
        """Serve `name`, as `script` says (see scripted.py), until the check is over or `leave()` is called.

        `kind` is a type's name, or a class. Who served the name before serves it again afterwards.
        """
        cls = self.service_class(kind) if isinstance(kind, str) else kind
        return self._open.enter_context(ScriptedServer(self._node, name, cls, script))

    def faulty(self, name: str, kind: str, work: Work) -> FaultyServer:
        """Serve `name` with `work`, and with the faults that are put into its `plan`; see faults.py."""
        server = FaultyServer(self._node, name, self.service_class(kind), work)
        self._open.enter_context(server)
        return server

    def absent(self, name: str, *, stale: bool = False) -> Absent:
        """Take `name` off the graph until the check is over; `stale` leaves an entry that leads nowhere."""
        return self._open.enter_context(Absent(self._node, name, stale=stale))

    def publish(
        self,
        topic: str,
        kind: str,
        messages: Iterable[Mapping[str, Plain]],
        *,
        every: float = 0.05,
        once: bool = False,
    ) -> Publishing:
        """Publish `messages` (fields by name) of the type `kind` in turn, every `every` s, over and over.

        With `once`, as soon as somebody listens, and each message one time.
        """
        return self._open.enter_context(
            Publishing(
                self._ledger,
                topic,
                message_type(kind).cls,
                messages,
                every=every,
                once=once,
                label=self._label(topic),
            )
        )

    def puppet(self, name: str, topic: str, kind: str, *, alive: bool = True) -> Puppet:
        """Have the master list the node `name` as a publisher of `topic`, alive or killed; see puppet.py."""
        return self._open.enter_context(Puppet(self._node, name, topic, kind, alive=alive))

    # -- the student's topics, heard from the graph

    def hear(self, topic: str, kind: str) -> Hearing:
        """Listen to `topic`, from now until the check is over; see hearing.py for what is to be asked of it.

        A listener that comes late has missed something: hear first, and then run what publishes.
        """
        cls, label = message_type(kind).cls, self._label(topic)
        return self._open.enter_context(Hearing(self._ledger, self._node, topic, cls, label))

    def _label(self, topic: str) -> str:
        """Return how rules call a topic: one that was drawn has another name each time."""
        return "the topic" if self.draw.made(topic) else topic

    # -- what the student wrote, in the kernel

    def run(
        self,
        function: str,
        *args: Value,
        within: float = 5.0,
        hints: Hints = (),
        worded: str = "",
        **kwargs: Value,
    ) -> Outcome:
        """Call the student's `function` in the kernel; it is broken off after `within` s.

        A report says what was called; `worded` says it better where `function` is a helper of the check's.
        """
        label = worded or f"{function}()"
        self.doing = f"waiting for {label}"
        words = worded or _as_call(function, args, kwargs)
        self._ledger.asked = lambda: words
        what = {
            "name": function,
            "args": [_wired(value) for value in args],
            "kwargs": {key: _wired(value) for key, value in kwargs.items()},
            "within": within,
        }
        started = time.monotonic()
        answer = self._link.ask("call", timeout=within + SLACK, **what)
        took = time.monotonic() - started  # by this clock: the kernel could say anything
        return Outcome(self._ledger, label, {**answer, "took": took}, hints)

    def prepare(self, code: str, within: float = 5.0) -> None:
        """Run `code` of the check's own in the kernel, apart from the student's names.

        What it makes can be handed to the student's function: `exam.run("close", Its("service"))`.
        """
        error = self._link.ask("prepare", timeout=within + SLACK, code=code, within=within).get("error")
        if error:
            raise ExamError(
                f"The check could not prepare the kernel ({error.get('text')}): restart the kernel."
            )

    def command(self, *argv: str, files: Sequence[str] = (), within: float = 10.0) -> Finished:
        """Run a command beside the kernel, in a new folder that holds copies of the student's `files`.

        "python" stands for the kernel's own interpreter. It is ended after `within` s.
        """
        return self.folder(files=files).command(*argv, within=within)

    def folder(self, *, files: Sequence[str] = (), texts: Mapping[str, str] | None = None) -> Folder:
        """Return a new folder beside the kernel with copies of the student's files and folders.

        `texts` are files of the check's own, by path; they go over the copies.
        """
        return Folder(self._link, files, texts or {}, self._under_way)

    def _under_way(self, words: str) -> None:
        self.doing = f"waiting for {words}"
        self._ledger.asked = lambda: words

    def read(self, name: str) -> Plain:
        """Return the value of the student's variable `name`, as plain data."""
        return self._link.ask("read", timeout=SLACK, name=name).get("value")

    def source(self, name: str) -> str:
        """Return the source of the student's function or class `name`, or of "file:PATH"."""
        return str(self._link.ask("source", timeout=SLACK, name=name).get("text", ""))

    # -- closing

    def __enter__(self) -> Exam:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with held_back(signal.SIGTERM):
            self._open.close()
            with suppress(GraphError):  # a master that is gone has nothing to forget
                self._node.forget_topics(self.draw.made)
        if isinstance(error, Exception) and not isinstance(error, (RuleBroken, ExamError)):
            words = f"{type(error).__name__}: {error}"
            raise ExamError(f"This check itself is broken ({words}); it is not your doing.") from error


@dataclass(frozen=True)
class Its:
    """An argument for `Exam.run`: what stands in the kernel under `name`."""

    name: str

    def __repr__(self) -> str:
        return self.name


def _wired(value: Value) -> Plain:
    return {"its": value.name} if isinstance(value, Its) else plain(value)


def _as_call(function: str, args: tuple[Value, ...], kwargs: dict[str, Value]) -> str:
    values = [repr(value) for value in args] + [f"{key}={value!r}" for key, value in kwargs.items()]
    return f"{function}({', '.join(values)})"
