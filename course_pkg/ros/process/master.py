"""A private ROS master that ends with this process, and a function that waits for a master."""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import TracebackType

from course_pkg.errors import GraphError, MasterSilent, MasterUnreachable, PortBusy, SetupError
from course_pkg.ports import free_port
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.waiting import at_this_load, wait_until

# Wait up to this time in s for a new master. A master usually answers after 0.15 s; on a busy machine, this
# takes much longer.
READY = 15.0
ATTEMPTS = 5
ENDED = -1  # If the master's process has ended, this value replaces its process id.
OTHER_ADDRESSES = ("ROS_IP", "ROS_IPV6")  # With these variables, ROS would not bind to 127.0.0.1.


class PrivateMaster:
    """A master on 127.0.0.1 that ends with this process, even if this process is killed.

    Without `port`, the master uses a free port.
    """

    def __init__(self, port: int | None = None) -> None:
        self._port_wanted = port
        self._process: SupervisedProcess | None = None
        self.port = port or 0
        self.logs = Path()

    @property
    def uri(self) -> str:
        """The master's address, the value for ROS_MASTER_URI."""
        return f"http://localhost:{self.port}"

    @property
    def pid(self) -> int:
        """The process id of the master."""
        if self._process is None:
            text = "This private master is not running. Call start(), or use the master in a with statement."
            raise GraphError(text)
        return self._process.pid

    @property
    def running(self) -> bool:
        """Whether the master's process is running."""
        return self._process is not None and self._process.returncode is None

    def __enter__(self) -> PrivateMaster:
        return self.start()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def start(self) -> PrivateMaster:
        """Start the master, wait until it answers, and return this object.

        Raises PortBusy if the given port is in use, SetupError if rosmaster is missing, and GraphError if the
        master does not answer. If another program binds to the selected free port first, start() tries other
        ports.
        """
        for _ in range(1 if self._port_wanted else ATTEMPTS):
            self.port = _port(self._port_wanted)
            if self._try():
                return self
        if self._port_wanted:
            raise _busy(self._port_wanted)
        raise GraphError(
            f"The master found no free port: other programs use all {ATTEMPTS} ports that were tried. "
            "Try again."
        )

    def stop(self) -> None:
        """End the master and delete its log files; a second call has no effect."""
        process, self._process = self._process, None
        if process is not None:
            process.end(grace=1.0)

    def _try(self) -> bool:
        self.logs, own = _log_folder()
        program = shutil.which("rosmaster")
        if program is None:
            raise SetupError("rosmaster is not on PATH. Run `./course doctor` to list what is missing.")
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
        """Wait for a master on the port, or for the end of the process.

        The result is true if `process` is the master on the port.
        """
        client = MasterClient(self.uri, timeout=1.0)
        limit = at_this_load(READY)
        pid = wait_until(lambda: _pid(client) or (process.returncode is not None and ENDED), limit, 0.005)
        if not pid:
            raise GraphError(f"rosmaster was started, but did not answer at {self.uri} within {limit:.0f} s.")
        return pid == process.pid


def wait_for_master(warn: Callable[[str], object], interval: float = 0.5) -> None:
    """Return as soon as the master at ROS_MASTER_URI answers.

    Ctrl-C can interrupt this function, but not the wait in init_node(). `interval` is the time in s between
    two polls of the master. If no master answers, the function `warn` is called once. Raises
    MalformedMasterUri if the URI is invalid, and NotAMaster if another program answers.
    """
    client, warned = MasterClient(master_uri()), False
    while True:
        try:
            client.pid()
        except (MasterUnreachable, MasterSilent):
            if not warned:
                warn(
                    f"No ROS master answers at {client.uri}. The program waits for a master; "
                    "Ctrl-C ends the wait."
                )
            warned = True
            time.sleep(interval)
        else:
            return


def _pid(client: MasterClient) -> int:
    """Return the master's process id, or 0 if no master answers."""
    with suppress(GraphError):
        return client.pid()
    return 0


def _port(asked: int | None) -> int:
    """Return the requested port `asked`, or any free port of 127.0.0.1 if `asked` is None.

    Raises PortBusy if the requested port is in use.
    """
    try:
        return free_port(candidates=[asked or 0])
    except OSError as error:
        raise _busy(asked) from error


def _busy(port: int | None) -> PortBusy:
    return PortBusy(
        f"Another program uses port {port} of 127.0.0.1. Choose a different port, or omit the "
        "port to get a free port. If the program is a ROS master, use it with "
        f"ROS_MASTER_URI=http://localhost:{port}."
    )


def _log_folder() -> tuple[Path, bool]:
    """Return the folder of the master's log, and whether stop() has to delete this folder."""
    if given := os.environ.get("ROS_LOG_DIR"):
        return Path(given), False
    return Path(tempfile.mkdtemp(prefix="course-master-")), True


def local_environment() -> dict[str, str]:
    """Return this process's environment, with changes that make all ROS programs bind to 127.0.0.1."""
    kept = {name: value for name, value in os.environ.items() if name not in OTHER_ADDRESSES}
    return {**kept, "ROS_HOSTNAME": "localhost"}
