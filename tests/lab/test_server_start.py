"""Tests that `course lab` opens only a server that it has started, even if another program takes the port."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from course_pkg.lab.server_start import PortTaken, await_server, log_of
from course_pkg.ros.process.supervised import SupervisedProcess
from tests.lab.commands import lab
from tests.lab.test_jupyterlab import Service

# This program writes a file with the server's address, as JupyterLab does, and exits with an error.
SERVER_WITHOUT_PORT = """
import json, os, pathlib, sys
folder, port = pathlib.Path(sys.argv[1]), int(sys.argv[2])
record = {"url": f"http://127.0.0.1:{port}/", "token": "own", "port": port}
(folder / f"jpserver-{os.getpid()}.json").write_text(json.dumps(record))
print(f"The port {port} is already in use.")
sys.exit(1)
"""


class Refusing(BaseHTTPRequestHandler):
    """A server of another user; the server refuses every token."""

    def do_GET(self) -> None:
        """Refuse a request."""
        self.send_error(403)


@pytest.fixture
def other_port() -> Iterator[int]:
    """Run the server of another user, and yield its port."""
    with ThreadingHTTPServer(("127.0.0.1", 0), Refusing) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield server.server_port
        server.shutdown()
        thread.join()


def test_the_server_of_another_user_is_not_opened(other_port: int, tmp_path: Path) -> None:
    """If another server answers at the chosen port, await_server() raises PortTaken with the server's log."""
    (tmp_path / "runtime").mkdir()
    command = [sys.executable, "-c", SERVER_WITHOUT_PORT, str(tmp_path / "runtime"), str(other_port)]
    with log_of(tmp_path).open("wb") as output:
        server = SupervisedProcess(command, output=output)
    try:
        with pytest.raises(PortTaken, match=f"could not use port {other_port}.*\n.*already in use"):
            await_server(server, tmp_path)
    finally:
        server.end()


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_labs_that_start_together_have_different_servers() -> None:
    """If four labs start at the same time, each lab prints the address of a different server."""
    with ExitStack() as stack, ThreadPoolExecutor(4) as pool:
        for _ in range(5):
            started = list(pool.map(lambda _: stack.enter_context(lab()), range(4)))
            services = [Service(process, address) for process, address in started]
            assert all(service.get("/api/status") for service in services)
            assert len({service.port for service in services}) == 4
            stack.close()
