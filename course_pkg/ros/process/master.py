"""A private ROS master that ends with this process, and waiting for a master."""

from __future__ import annotations

import os
import shutil
import socket
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import TracebackType

from course_pkg.errors import GraphError, MasterSilent, MasterUnreachable, PortBusy, SetupError
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.waiting import wait_until

READY = 15.0  # s; it takes 0.15 s, and many times that on a machine that is busy
ATTEMPTS = 5
ENDED = -1  # in the place of a process id
OTHER_ADDRESSES = ("ROS_IP", "ROS_IPV6")  # with these variables ROS binds to other addresses


class PrivateMaster:
    """A master on 127.0.0.1 that ends with this process, even if this process is killed.

    `port` is a free one unless it is given; a given one that is taken is a PortBusy.
    """

    def __init__(self, port: int | None = None) -> None:
        self._port_wanted = port
        self._process: SupervisedProcess | None = None
        self.port = port or 0
        self.logs = Path()

    @property
    def uri(self) -> str:
        """The address, for ROS_MASTER_URI."""
        return f"http://localhost:{self.port}"

    @property
    def pid(self) -> int:
        """The process id of the master."""
        if self._process is None:
            raise GraphError("This private master is not running: start() it, or use it in a with statement.")
        return self._process.pid

    @property
    def running(self) -> bool:
        """Whether its process lives."""
        return self._process is not None and self._process.returncode is None

    def __enter__(self) -> PrivateMaster:
        return self.start()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def start(self) -> PrivateMaster:
        """Start it and wait until it answers; if another program takes the port meanwhile, try again."""
        for _ in range(1 if self._port_wanted else ATTEMPTS):
            self.port = _free_port(self._port_wanted)
            if self._try():
                return self
        if self._port_wanted:
            raise _busy(self._port_wanted)
        raise GraphError(f"{ATTEMPTS} times another program took the port before the master. Try again.")

    def stop(self) -> None:
        """End it and remove what it wrote; a second stop changes nothing."""
        process, self._process = self._process, None
        if process is not None:
            process.end(grace=1.0)

    def _try(self) -> bool:
        self.logs, own = _log_folder()
        program = shutil.which("rosmaster")
        if program is None:
            raise SetupError("rosmaster is not on PATH. Run `./course doctor`: it says what is missing.")
        command = [program, "--core", "-p", str(self.port), f"__log:={self.logs / f'master-{self.port}.log'}"]
        environment = {**local_environment(), "ROS_LOG_DIR": str(self.logs)}
        self._process = SupervisedProcess(command, env=environment, remove=self.logs if own else None)
        ready = False
        try:
            ready = self._wait(self._process)
        finally:
            if not ready:
                self.stop()
        return ready

    def _wait(self, process: SupervisedProcess) -> bool:
        """Return whether the program that answers on the port is ours."""
        client = MasterClient(self.uri, timeout=1.0)
        pid = wait_until(lambda: _pid(client) or (process.returncode is not None and ENDED), READY, 0.005)
        if not pid:
            raise GraphError(f"rosmaster was started and did not answer at {self.uri} within {READY:g} s.")
        return pid == process.pid


def wait_for_master(warn: Callable[[str], object], interval: float = 0.5) -> None:
    """Return as soon as the master of ROS_MASTER_URI answers; unlike init_node(), it can be ended by Ctrl-C.

    It looks every `interval` s, and calls `warn` once if there is no master. Raises MalformedMasterUri and
    NotAMaster at once, since waiting does not help there.
    """
    client, warned = MasterClient(master_uri()), False
    while True:
        try:
            client.pid()
        except (MasterUnreachable, MasterSilent):
            if not warned:
                warn(f"No ROS master answers at {client.uri}. Waiting for one; Ctrl-C ends this.")
            warned = True
            time.sleep(interval)
        else:
            return


def _pid(client: MasterClient) -> int:
    """Return the master's process id, or 0 where no master answers."""
    with suppress(GraphError):
        return client.pid()
    return 0


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


def local_environment() -> dict[str, str]:
    """Return this process's environment, changed so that all programs of ROS bind to 127.0.0.1."""
    kept = {name: value for name, value in os.environ.items() if name not in OTHER_ADDRESSES}
    return {**kept, "ROS_HOSTNAME": "localhost"}
