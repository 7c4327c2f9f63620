"""Where a fault is caused: its programs, its own master if it needs one, and the end of all of it.

Everything is below one namespace of the running graph, such as /lab; the rest of the graph is not changed.
"""

from __future__ import annotations

import os
import shlex
import shutil
import signal
import sys
import tempfile
import weakref
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Protocol

from course_pkg.errors import GraphError, NodeFailed
from course_pkg.faults.program import INTERVAL, Program, Seen
from course_pkg.ros.process.master import PrivateMaster, local_environment
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.protocol.probe import ask_all, service_probe
from course_pkg.ros.protocol.registrations import withdraw_below
from course_pkg.ros.protocol.xmlrpc import port_of
from course_pkg.waiting import wait_until

REAPER = Path(__file__).with_name("reaper.py")
FOLDERS = ("ROS_LOG_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")  # where programs leave files behind
READY = 10.0  # s for a program of a case to be on the graph; it takes 0.4 s
NAMESPACES = ("/lab", *(f"/lab{number}" for number in range(2, 10)))


class Playable(Protocol):
    """What a stage needs to know of a fault; see Fault."""

    @property
    def play(self) -> Callable[[Stage], None]:
        """What causes it."""

    @property
    def visitor(self) -> str:
        """What shows it."""

    @property
    def is_command(self) -> bool:
        """Whether the visitor is a command line."""

    @property
    def timeout(self) -> float:
        """For how many s its symptom is watched."""


class Stage:
    """A fault on the running graph, or on a master of its own.

    It ends with undo(), with this object, or with this process, even by SIGKILL. Raises MasterUnreachable and
    MasterSilent where there is no master.
    """

    def __init__(self, fault: Playable) -> None:
        self.fault = fault
        self.uri = master_uri()  # of the master on which the fault is
        self.namespace = _free_namespace(self.uri)
        self.visitor_env: dict[str, str] = {}
        self.keeper: Program | None = None  # the program at fault, whose output may be looked at
        self._visitor: Program | None = None
        self._resources = _Resources(self.uri, self.namespace)
        self._end = weakref.finalize(self, self._resources.clear)

    @property
    def door(self) -> str:
        """The full name of the service that the case is about."""
        return f"{self.namespace}/door"

    def cause(self) -> None:
        """Cause the fault; when that fails, undo what was done. Raises NodeFailed."""
        try:
            self.fault.play(self)
            if not self.fault.is_command:
                self.expect_visitor()  # not earlier: on a busy machine it would delay the fault itself
        except BaseException:
            self.undo()
            raise

    def symptom(self) -> Seen:
        """Run the visitor, and return what it shows."""
        self.expect_visitor()
        visitor, self._visitor = self._visitor, None
        assert visitor is not None
        visitor.begin()
        seen = visitor.watch(self.fault.timeout)
        visitor.end()
        with suppress(GraphError):  # of a fault whose master is gone, or does not answer
            withdraw_below(MasterClient(self.uri, timeout=0.5), f"{self.namespace}/visitor")
        return seen

    def undo(self) -> None:
        """End all of it, and return when the graph is as before; a second undo changes nothing."""
        self._end()

    def expect_visitor(self) -> None:
        """Start the visitor early, so that symptom() does not have to wait for its interpreter."""
        if self._visitor is None:
            text = self.fault.visitor
            self._visitor = (
                self.command(text[2:], self.visitor_env)
                if self.fault.is_command
                else self.program("visitor.py", text, self.visitor_env)
            )

    def serve(self, code: str) -> Program:
        """Run the program that serves /door, and return when it does."""
        keeper = self.keep(code)
        self.await_that(lambda: self._answers(keeper), keeper)
        return keeper

    def keep(self, code: str, env: dict[str, str] | None = None) -> Program:
        """Begin the program that a student may look at, and return at once."""
        self.keeper = self.program("keeper.py", code, env)
        self.keeper.begin()
        return self.keeper

    def serve_too(self, program: Program) -> None:
        """Start another program that serves /door, and return when it does."""
        program.begin()
        self.await_that(lambda: self._answers(program), program)

    def program(self, name: str, code: str, env: dict[str, str] | None = None) -> Program:
        """Start a Python text, which waits for begin()."""
        program = Program.python(name, self.local(code), self.environment(env or {}))
        self._resources.programs.append(program)
        return program

    def command(self, line: str, env: dict[str, str] | None = None) -> Program:
        """Start a command line."""
        line = self.local(line)
        program = Program(f"$ {line}", shlex.split(line), self.environment(env or {}))
        self._resources.programs.append(program)
        return program

    def own_master(self, port: int | None = None) -> PrivateMaster:
        """Start a master for this fault alone; what is started from here on is on its graph."""
        master = PrivateMaster(port).start()
        self._resources.masters.append(master)
        self.uri = master.uri
        return master

    def hang(self, master: PrivateMaster) -> None:
        """Stop a master of this fault's own by SIGSTOP; it goes on before it is ended."""
        pid = master.pid
        self.later(partial(os.kill, pid, signal.SIGCONT))
        os.kill(pid, signal.SIGSTOP)

    def later(self, end: Callable[[], object]) -> None:
        """Call `end` when the fault is undone; it must not hold a reference to this stage."""
        self._resources.ends.append(end)

    def await_that(self, condition: Callable[[], object], program: Program) -> None:
        """Return when `condition` is true. Raises NodeFailed when `program` ends first, or after 10 s."""

        def settled() -> str:
            over = program.over  # before the condition, which the last thing that it does may fulfil
            return "met" if condition() else "over" if over else ""

        if wait_until(settled, READY, INTERVAL) != "met":
            raise NodeFailed(f"A case of the lab could not be set up. It printed: {program.output()}")

    def environment(self, more: dict[str, str]) -> dict[str, str]:
        """Return the environment of its programs: the master of the case, its namespace, its own logs."""
        own = {
            "ROS_MASTER_URI": self.uri,
            "ROS_NAMESPACE": self.namespace,
            **{name: str(self._resources.folder) for name in FOLDERS},
        }
        return {**local_environment(), **own, **more}

    def local(self, text: str) -> str:
        """Return a text of the catalogue with the names that it has on this stage."""
        return text.replace("/lab/", f"{self.namespace}/").replace("MASTER_PORT", str(port_of(self.uri)))

    def _answers(self, program: Program) -> bool:
        uri = MasterClient(self.uri).lookup_service(self.door)
        ports = program.ports()
        if uri is None or port_of(uri) not in ports:
            return False
        probe = service_probe(self.door, uri)
        ask_all([probe], timeout=1.0)
        return probe.answered


class _Resources:
    """What a stage has to end and remove; it holds no reference to the stage, which may be gone by then."""

    def __init__(self, uri: str, namespace: str) -> None:
        self.programs: list[Program] = []
        self.masters: list[PrivateMaster] = []
        self.ends: list[Callable[[], object]] = []
        self._uri = uri
        self._namespace = namespace
        self.folder = Path(tempfile.mkdtemp(prefix="course-lab-"))
        # If this process is killed, the reaper withdraws what programs left registered that were killed.
        self._reaper = SupervisedProcess(
            [sys.executable, "-I", "-S", str(REAPER), uri, namespace, str(self.folder)], env=os.environ
        )

    def clear(self) -> None:
        """End everything; if one step fails, the others are still done."""
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
        self._reaper.end(grace=0)
        shutil.rmtree(self.folder, ignore_errors=True)


def _free_namespace(uri: str) -> str:
    """Return a namespace that no node uses: another notebook on this graph may have a lab, too."""
    taken = [node for node in MasterClient(uri).system_state().nodes if node.startswith("/lab")]
    free = (name for name in NAMESPACES if not any(node.startswith(f"{name}/") for node in taken))
    return next(free, f"/lab_{os.getpid()}")
