"""Waits until JupyterLab's server answers at its address, and starts a kernel."""

from __future__ import annotations

import json
import time
from contextlib import closing, suppress
from http.client import OK, HTTPConnection, HTTPException
from pathlib import Path
from typing import NamedTuple
from urllib.parse import SplitResult, urlsplit

from course_pkg.errors import CourseError, PortBusy
from course_pkg.ros.process.supervised import SupervisedProcess

# The server has to start within this time in s. The server usually needs 2 s. If the server's files are not
# in the disk cache, the start takes much longer.
READY = 60.0
LOOK = 0.01  # This is the time in s between two attempts to reach the server.
KEPT_LINES = 12  # number of lines of the server's log in an error message


class PortTaken(PortBusy):
    """Another program took the port between JupyterLab's choice of the port and its first listen call."""


class Address(NamedTuple):
    """The address at which the server listens, and its token.

    The server writes the address and the token into a file.
    """

    url: str
    token: str

    @property
    def base(self) -> SplitResult:
        """The parts of the server's URL."""
        return urlsplit(self.url)

    @property
    def headers(self) -> dict[str, str]:
        """The headers of a request that the server accepts."""
        return {"Authorization": f"token {self.token}"}


def await_server(server: SupervisedProcess, scratch: Path) -> Address:
    """Wait until the server answers, and return its address.

    Raises PortTaken if another program took the port, and CourseError if the server ends for another reason,
    or does not answer within `READY` seconds.
    """
    deadline = time.monotonic() + READY
    # The server writes this file after it has chosen a port, and just before it listens.
    info = scratch / "runtime" / f"jpserver-{server.pid}.json"
    chosen = 0
    while True:
        # The server can write the file and end between two rounds, so read the file again after the end.
        ended = server.wait(LOOK)
        with suppress(OSError, ValueError, HTTPException):
            seen = json.loads(info.read_text())
            address, chosen = Address(seen["url"], seen["token"]), seen["port"]
            if _is_at(address):
                return address
        if ended:
            kind, did = (PortTaken, f"could not use port {chosen}") if chosen else (CourseError, "ended")
            raise kind(
                f"JupyterLab {did} during its start (status {server.returncode}):\n{end_of(log_of(scratch))}"
            )
        if time.monotonic() > deadline:
            raise CourseError(f"JupyterLab did not answer within {READY:g} s:\n{end_of(log_of(scratch))}")


def _is_at(address: Address) -> bool:
    """Return whether the server at this address accepts the token; a server of another user refuses it."""
    with closing(HTTPConnection(address.base.netloc, timeout=READY)) as server:
        server.request("GET", f"{address.base.path}api/status", headers=address.headers)
        return server.getresponse().status == OK


def start_kernel(address: Address, notebook: str) -> None:
    """Start the notebook's kernel while the page loads; the page then finds a running kernel.

    If the start of the kernel fails, the page starts the kernel itself. If this also fails, the page shows
    the reason.
    """
    if not notebook:
        return
    kernel = {"name": "python3"}
    session = {"path": notebook, "name": Path(notebook).name, "type": "notebook", "kernel": kernel}
    headers = {**address.headers, "Content-Type": "application/json"}
    with (
        suppress(OSError, HTTPException),
        closing(HTTPConnection(address.base.netloc, timeout=READY)) as server,
    ):
        server.request("POST", f"{address.base.path}api/sessions", json.dumps(session), headers)
        server.getresponse().read()


def log_of(scratch: Path) -> Path:
    """Return the path of the server's log."""
    return scratch / "server.log"


def end_of(log: Path) -> str:
    """Return the last lines of a log."""
    return "\n".join(log.read_text(errors="replace").splitlines()[-KEPT_LINES:]) + "\n"
