"""Where a fault is caused: its programs, its master if it needs one of its own, and how all of it is undone.

Everything is below one namespace of the running graph, /lab, and nothing else is touched there.
"""

from __future__ import annotations

import os
import shlex
import shutil
import signal
import sys
import tempfile
import time
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path

from course_pkg.errors import GraphError, NodeFailed
from course_pkg.faults.fault import Fault
from course_pkg.faults.program import LOOK, Program, Seen
from course_pkg.faults.registrations import nodes_below, withdraw_below
from course_pkg.graph.leash import Leash
from course_pkg.graph.master import ELSEWHERE, PrivateMaster, master_uri
from course_pkg.graph.ports import port_of
from course_pkg.graph.probe import ask_all, service_probe
from course_pkg.graph.rpc import MasterClient

BROOM = Path(__file__).with_name("broom.py")
FOLDERS = ("ROS_LOG_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")  # where programs leave files behind
READY = 10.0  # s for a program of a case to be on the graph; it takes 0.4 s
NAMESPACES = ("/lab", *(f"/lab{number}" for number in range(2, 10)))


class Stage:
    """A fault on the running graph, or on a master of its own.

    It ends with undo(), with this object, or with this process, also by SIGKILL. Raises MasterUnreachable and
    MasterSilent where there is no graph to be on.
    """

    def __init__(self, fault: Fault) -> None:
        self.fault = fault
        self.uri = master_uri()  # of the master on which the fault is
        self.namespace = _free_namespace(self.uri)
        self.visitor_env: dict[str, str] = {}
        self.keeper: Program | None = None  # the program at fault, whose output may be looked at
        self._visitor: Program | None = None
        self._props = _Props(self.uri, self.namespace)
        self._end = weakref.finalize(self, self._props.clear)

    @property
    def door(self) -> str:
        """The full name of the service that the case is about."""
        return f"{self.namespace}/door"

    def cause(self) -> None:
        """Cause the fault; what was begun is undone when that fails."""
        try:
            self.fault.play(self)
            if not self.fault.is_command:
                self.expect_visitor()  # not before: on a busy machine it would hold up the fault itself
        except BaseException:
            self.undo()
            raise

    def symptom(self) -> Seen:
        """Run what the case makes a student run, and return what is seen of it."""
        self.expect_visitor()
        visitor, self._visitor = self._visitor, None
        assert visitor is not None
        visitor.begin()
        seen = visitor.watch(self.fault.patience)
        visitor.end()
        with suppress(GraphError):  # of a fault whose master is gone, or does not answer
            withdraw_below(MasterClient(self.uri, timeout=0.5), f"{self.namespace}/visitor")
        return seen

    def undo(self) -> None:
        """Take all of it away, and return when the graph is as before; a second undo changes nothing."""
        self._end()

    def expect_visitor(self) -> None:
        """Have the visitor start already, so that what it shows comes at once when it is asked for."""
        if self._visitor is None:
            text = self.fault.visitor
            self._visitor = (
                self.command(text[2:], self.visitor_env)
                if self.fault.is_command
                else self.program("visitor.py", text, self.visitor_env)
            )

    def serve(self, code: str) -> Program:
        """Run the program that serves the door, and return when it does."""
        keeper = self.keep(code)
        self.await_that(lambda: self._answers(keeper), keeper)
        return keeper

    def keep(self, code: str, env: dict[str, str] | None = None) -> Program:
        """Begin the program that a student may look at, and return at once."""
        self.keeper = self.program("keeper.py", code, env)
        self.keeper.begin()
        return self.keeper

    def serve_too(self, program: Program) -> None:
        """Begin another program that serves the door, and return when it does."""
        program.begin()
        self.await_that(lambda: self._answers(program), program)

    def program(self, name: str, code: str, env: dict[str, str] | None = None) -> Program:
        """Start a Python text, which waits for begin()."""
        program = Program.python(name, self.local(code), self.environment(env or {}))
        self._props.programs.append(program)
        return program

    def command(self, line: str, env: dict[str, str] | None = None) -> Program:
        """Start a command line."""
        line = self.local(line)
        program = Program(f"$ {line}", shlex.split(line), self.environment(env or {}))
        self._props.programs.append(program)
        return program

    def own_master(self, port: int | None = None) -> PrivateMaster:
        """Start a master for this fault alone; what is started from here on is on its graph."""
        master = PrivateMaster(port).start()
        self._props.masters.append(master)
        self.uri = master.uri
        return master

    def hang(self, master: PrivateMaster) -> None:
        """Stop a master of this fault's own by SIGSTOP; it goes on before it is ended."""
        pid = master.pid
        self.later(partial(os.kill, pid, signal.SIGCONT))
        os.kill(pid, signal.SIGSTOP)

    def later(self, end: Callable[[], object]) -> None:
        """Have `end` called when the fault is undone; it must not hold this stage."""
        self._props.ends.append(end)

    def await_that(self, condition: Callable[[], object], program: Program) -> None:
        """Return as soon as `condition` holds. Raises NodeFailed when `program` ends first, or after 10 s."""
        deadline = time.monotonic() + READY
        while True:
            over = program.over or time.monotonic() > deadline  # before the last look at what is waited for
            if condition():
                return
            if over:
                raise NodeFailed(f"A case of the lab could not be set up. It printed: {program.output()}")
            time.sleep(LOOK)

    def environment(self, more: dict[str, str]) -> dict[str, str]:
        """Return the environment of its programs: the master of the case, its namespace, its own logs."""
        kept = {name: value for name, value in os.environ.items() if name not in ELSEWHERE}
        own = {
            "ROS_MASTER_URI": self.uri,
            "ROS_HOSTNAME": "localhost",
            "ROS_NAMESPACE": self.namespace,
            **{name: str(self._props.folder) for name in FOLDERS},
        }
        return {**kept, **own, **more}

    def local(self, text: str) -> str:
        """Return a text of the catalogue with the names that it has on this stage."""
        return text.replace("/lab/", f"{self.namespace}/").replace("MASTER_PORT", str(port_of(self.uri)))

    def _answers(self, program: Program) -> bool:
        uri = MasterClient(self.uri).lookup_service(self.door)
        ports = program.ports()
        if uri is None or (ports is not None and port_of(uri) not in ports):
            return False
        probe = service_probe(self.door, uri)
        ask_all([probe], timeout=1.0)
        return probe.answered


@contextmanager
def caused(name: str) -> Iterator[Stage]:
    """Have the fault of this name there for the block of a `with`; it is undone when the block ends."""
    from course_pkg.faults.catalogue import named

    stage = Stage(named(name))
    stage.cause()
    try:
        yield stage
    finally:
        stage.undo()


class _Props:
    """What a stage has to clear away; it knows nothing of the stage, which may be gone by then."""

    def __init__(self, uri: str, namespace: str) -> None:
        self.programs: list[Program] = []
        self.masters: list[PrivateMaster] = []
        self.ends: list[Callable[[], object]] = []
        self._uri = uri
        self._namespace = namespace
        self.folder = Path(tempfile.mkdtemp(prefix="course-lab-"))
        # Should this process be killed, it withdraws what processes that were killed on purpose left behind.
        self._broom = Leash(
            [sys.executable, "-I", "-S", str(BROOM), uri, namespace, str(self.folder)], env=os.environ
        )

    def clear(self) -> None:
        """End everything; whatever fails, the rest is still done."""
        while self.ends:
            with suppress(OSError):
                self.ends.pop()()
        for program in self.programs:
            program.signal(signal.SIGCONT)
        while self.programs:
            self.programs.pop().end()
        while self.masters:
            self.masters.pop().stop()
        with suppress(GraphError):  # a master that is gone has nothing to withdraw
            withdraw_below(MasterClient(self._uri), self._namespace + "/")
        self._broom.end(grace=0)
        shutil.rmtree(self.folder, ignore_errors=True)


def _free_namespace(uri: str) -> str:
    """Return a namespace that nobody uses: another notebook on this graph may have a lab, too."""
    taken = nodes_below(MasterClient(uri), "/lab")
    free = (name for name in NAMESPACES if not any(node.startswith(f"{name}/") for node in taken))
    return next(free, f"/lab_{os.getpid()}")
