"""A stage causes a fault on the graph, and later removes the fault.

A stage runs the programs of the fault, and a separate master if the fault needs one. All nodes and services
of a stage are in one namespace of the running graph, such as /lab. A stage does not change other nodes and
services.
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
# The stage sets these environment variables to folders for log files and other files.
FOLDERS = ("ROS_LOG_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")
READY = 10.0  # A program has to be on the graph within this time in s; usually, this takes 0.4 s.
NAMESPACES = ("/lab", *(f"/lab{number}" for number in range(2, 10)))


class Playable(Protocol):
    """The attributes of a Fault that a stage uses.

    The module `fault` imports this module, so this module cannot import the class Fault.
    """

    @property
    def play(self) -> Callable[[Stage], None]:
        """The function that causes the fault."""

    @property
    def visitor(self) -> str:
        """The Python program or the command line that shows the symptom."""

    @property
    def is_command(self) -> bool:
        """Whether `visitor` is a command line."""

    @property
    def timeout(self) -> float:
        """The time limit in s for the program or command that shows the symptom."""


class Stage:
    """A fault on the running graph, or on a separate master.

    The fault ends when undo() is called, when this object is deleted, or when this process ends. Raises
    MasterUnreachable or MasterSilent if no master answers.
    """

    def __init__(self, fault: Playable) -> None:
        self.fault = fault
        self.uri = master_uri()  # The programs of this fault use the master at this address.
        self.namespace = _free_namespace(self.uri)
        self.visitor_env: dict[str, str] = {}
        self.keeper: Program | None = None  # The keeper is the faulty program; a student may read its output.
        self._visitor: Program | None = None
        self._resources = _Resources(self.uri, self.namespace)
        self._end = weakref.finalize(self, self._resources.clear)

    @property
    def door(self) -> str:
        """The full name of the service /door in the stage's namespace."""
        return f"{self.namespace}/door"

    def cause(self) -> None:
        """Cause the fault; on failure, undo everything and raise NodeFailed."""
        try:
            self.fault.play(self)
            if not self.fault.is_command:
                # The program `visitor` starts last: on a busy machine, its start would delay the fault.
                self.expect_visitor()
        except BaseException:
            self.undo()
            raise

    def symptom(self) -> Seen:
        """Run the program or command that shows the symptom, and return its result.

        Raises NodeFailed if the program does not start.
        """
        self.expect_visitor()
        visitor, self._visitor = self._visitor, None
        assert visitor is not None
        visitor.begin()
        seen = visitor.watch(self.fault.timeout)
        visitor.end()
        with suppress(GraphError):  # In some faults, the master has ended or does not answer.
            withdraw_below(MasterClient(self.uri, timeout=0.5), f"{self.namespace}/visitor")
        return seen

    def undo(self) -> None:
        """End the fault, and wait until the graph has its earlier state; a second call has no effect."""
        self._end()

    def expect_visitor(self) -> None:
        """Start the interpreter of the program `visitor` early; symptom() then does not have to wait."""
        if self._visitor is None:
            text = self.fault.visitor
            self._visitor = (
                self.command(text[2:], self.visitor_env)
                if self.fault.is_command
                else self.program("visitor.py", text, self.visitor_env)
            )

    def serve(self, code: str) -> Program:
        """Run the program `code` as the server of /door, and wait until it responds.

        Raises NodeFailed if the server does not respond.
        """
        keeper = self.keep(code)
        self.await_that(lambda: self._answers(keeper), keeper)
        return keeper

    def keep(self, code: str, env: dict[str, str] | None = None) -> Program:
        """Start the program that contains the fault, and return at once.

        A student may read the output of this program.
        """
        self.keeper = self.program("keeper.py", code, env)
        self.keeper.begin()
        return self.keeper

    def serve_too(self, program: Program) -> None:
        """Start another server of /door, and wait until it responds; on failure, raise NodeFailed."""
        program.begin()
        self.await_that(lambda: self._answers(program), program)

    def program(self, name: str, code: str, env: dict[str, str] | None = None) -> Program:
        """Start a Python program; its code runs after begin()."""
        program = Program.python(name, self.local(code), self.environment(env or {}))
        self._resources.programs.append(program)
        return program

    def command(self, line: str, env: dict[str, str] | None = None) -> Program:
        """Start a command line at once."""
        line = self.local(line)
        program = Program(f"$ {line}", shlex.split(line), self.environment(env or {}))
        self._resources.programs.append(program)
        return program

    def own_master(self, port: int | None = None) -> PrivateMaster:
        """Start a master for this fault; all programs that start later use this master."""
        master = PrivateMaster(port).start()
        self._resources.masters.append(master)
        self.uri = master.uri
        return master

    def hang(self, master: PrivateMaster) -> None:
        """Suspend this fault's own master with SIGSTOP. undo() continues the master, and then ends it."""
        pid = master.pid
        self.later(partial(os.kill, pid, signal.SIGCONT))
        os.kill(pid, signal.SIGSTOP)

    def later(self, end: Callable[[], object]) -> None:
        """Store a function that is called when the fault is undone.

        `end` must not have a reference to this stage.
        """
        self._resources.ends.append(end)

    def await_that(self, condition: Callable[[], object], program: Program) -> None:
        """Wait up to 10 s until `condition` is true.

        Raises NodeFailed after 10 s, or if `program` ends before the condition is true.
        """

        def settled() -> str:
            # Read `over` first: the program may make the condition true and then end.
            over = program.over
            return "met" if condition() else "over" if over else ""

        if wait_until(settled, READY, INTERVAL) != "met":
            raise NodeFailed(f"A case could not be set up. The output of its program: {program.output()}")

    def environment(self, more: dict[str, str]) -> dict[str, str]:
        """Return the environment variables for the fault's programs.

        The variables set the master, the namespace and the log folder.
        """
        own = {
            "ROS_MASTER_URI": self.uri,
            "ROS_NAMESPACE": self.namespace,
            **{name: str(self._resources.folder) for name in FOLDERS},
        }
        return {**local_environment(), **own, **more}

    def local(self, text: str) -> str:
        """Return a copy of `text` that contains the stage's namespace and the port of the stage's master.

        The namespace replaces /lab, and the port replaces MASTER_PORT.
        """
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
    """The processes and files of a stage.

    When the stage is deleted, the processes end and the files are deleted.

    No attribute refers to the stage. Such a reference would prevent Python from deleting the stage.
    """

    def __init__(self, uri: str, namespace: str) -> None:
        self.programs: list[Program] = []
        self.masters: list[PrivateMaster] = []
        self.ends: list[Callable[[], object]] = []
        self._uri = uri
        self._namespace = namespace
        self.folder = Path(tempfile.mkdtemp(prefix="course-lab-"))
        # If this process is killed, the program reaper.py removes the registrations of killed programs.
        self._reaper = SupervisedProcess(
            [sys.executable, "-I", "-S", str(REAPER), uri, namespace, str(self.folder)], env=os.environ
        )

    def clear(self) -> None:
        """End all processes and delete all files; if one step fails, run the next steps."""
        while self.ends:
            with suppress(OSError):
                self.ends.pop()()
        for program in self.programs:
            program.signal(signal.SIGCONT)
        while self.programs:
            self.programs.pop().end()
        while self.masters:
            self.masters.pop().stop()
        with suppress(GraphError):  # If the master has ended, there are no registrations to remove.
            withdraw_below(MasterClient(self._uri), self._namespace + "/")
        self._reaper.end(grace=0)
        shutil.rmtree(self.folder, ignore_errors=True)


def _free_namespace(uri: str) -> str:
    """Return a namespace that no node uses; another notebook may have a stage on this graph."""
    taken = [node for node in MasterClient(uri).system_state().nodes if node.startswith("/lab")]
    free = (name for name in NAMESPACES if not any(node.startswith(f"{name}/") for node in taken))
    return next(free, f"/lab_{os.getpid()}")
