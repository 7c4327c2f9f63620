"""Finding a ROS master, or starting a private one that ends with this process."""

from __future__ import annotations

import os
import shutil
import socket
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from types import TracebackType

from course_pkg.errors import GraphError, MasterSilent, MasterUnreachable, PortBusy, SetupError
from course_pkg.graph.leash import Leash
from course_pkg.graph.rpc import MasterClient

READY = 15.0  # s; it takes 0.15 s, and many times that on a machine that is busy
TRIES = 5
ELSEWHERE = ("ROS_IP", "ROS_IPV6")  # variables that would have ROS bind to other addresses


class PrivateMaster:
    """A master on 127.0.0.1 that ends with this process, also when this process is killed.

    `port` is a free one unless it is given; a given one that is taken is a PortBusy.
    """

    def __init__(self, port: int | None = None) -> None:
        self._asked = port
        self._leash: Leash | None = None
        self.port = port or 0

    @property
    def uri(self) -> str:
        """The address, for ROS_MASTER_URI."""
        return f"http://localhost:{self.port}"

    @property
    def pid(self) -> int:
        """The process id of the master."""
        if self._leash is None:
            raise GraphError("This private master is not running: start() it, or use it in a with statement.")
        return self._leash.pid

    @property
    def running(self) -> bool:
        """Whether its process lives."""
        return self._leash is not None and self._leash.returncode is None

    def __enter__(self) -> PrivateMaster:
        return self.start()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def start(self) -> PrivateMaster:
        """Start it and wait until it answers; if another program takes the port meanwhile, try again."""
        for _ in range(1 if self._asked else TRIES):
            self.port = _free_port(self._asked)
            if self._try():
                return self
        if self._asked:
            raise _busy(self._asked)
        raise GraphError(f"{TRIES} times another program took the port before the master could. Try again.")

    def stop(self) -> None:
        """End it and remove what it wrote; a second stop changes nothing."""
        leash, self._leash = self._leash, None
        if leash is not None:
            leash.end(grace=1.0)

    def _try(self) -> bool:
        logs, own = _log_folder()
        program = shutil.which("rosmaster")
        if program is None:
            raise SetupError("rosmaster is not on PATH. Run `./course doctor`: it says what is missing.")
        command = [program, "--core", "-p", str(self.port), f"__log:={logs / f'master-{self.port}.log'}"]
        environment = {**_local_environment(), "ROS_LOG_DIR": str(logs)}
        self._leash = Leash(command, env=environment, remove=logs if own else None)
        ready = False
        try:
            ready = self._wait(self._leash)
        finally:
            if not ready:
                self.stop()
        return ready

    def _wait(self, leash: Leash) -> bool:
        """Return whether the program that answers on the port is ours."""
        deadline = time.monotonic() + READY
        client = MasterClient(self.uri, timeout=1.0)
        while time.monotonic() < deadline and leash.returncode is None:
            try:
                return client.pid() == leash.pid
            except GraphError:
                time.sleep(0.005)
        if leash.returncode is not None:
            return False
        raise GraphError(f"rosmaster was started and did not answer at {self.uri} within {READY:g} s.")


def master_uri() -> str:
    """Return where rospy looks for the master."""
    return os.environ.get("ROS_MASTER_URI") or "http://localhost:11311"


def await_master(tell: Callable[[str], object], every: float = 0.5) -> None:
    """Return as soon as the master of ROS_MASTER_URI answers, as init_node() does, but to be ended by Ctrl-C.

    `tell` is told once that there is none. Raises MalformedMasterUri and NotAMaster, which no waiting mends.
    """
    client, told = MasterClient(master_uri()), False
    while True:
        try:
            client.pid()
        except (MasterUnreachable, MasterSilent):
            if not told:
                tell(f"No ROS master answers at {client.uri}. Waiting for one; Ctrl-C ends this.")
            told = True
            time.sleep(every)
        else:
            return


def find_or_start_master() -> PrivateMaster | MasterClient:
    """Return the master that ROS_MASTER_URI names, once it has answered, or a new private one.

    The private one's address is put into ROS_MASTER_URI, for rospy and for the processes started from here.
    """
    if given := os.environ.get("ROS_MASTER_URI"):
        client = MasterClient(given)
        client.pid()
        return client
    master = PrivateMaster().start()
    for name in ELSEWHERE:
        os.environ.pop(name, None)
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_HOSTNAME="localhost")
    return master


def _free_port(asked: int | None) -> int:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", asked or 0))
        except OSError as error:
            raise _busy(asked) from error
        return int(probe.getsockname()[1])


def _busy(port: int | None) -> PortBusy:
    return PortBusy(
        f"Port {port} of 127.0.0.1 is taken by another program. Choose another, or leave it out to get a "
        f"free one; if that program is a ROS master, use it with ROS_MASTER_URI=http://localhost:{port}."
    )


def _log_folder() -> tuple[Path, bool]:
    """Return where the master's log goes, and whether that folder is to be removed with the master."""
    if given := os.environ.get("ROS_LOG_DIR"):
        return Path(given), False
    return Path(tempfile.mkdtemp(prefix="course-master-")), True


def _local_environment() -> dict[str, str]:
    """Return an environment in which all that is ROS binds to 127.0.0.1."""
    kept = {name: value for name, value in os.environ.items() if name not in ELSEWHERE}
    return {**kept, "ROS_HOSTNAME": "localhost"}
