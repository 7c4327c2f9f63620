"""Tests of `course lab` with JupyterLab and a master."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import parse_qs, urlsplit
from urllib.request import Request, urlopen

import pytest

from course_pkg.ports import free_port
from course_pkg.ros.process.supervised import listening_ports
from course_pkg.types.fields import Plain
from tests.lab.commands import ROOT, address_of, all_gone, below, can_connect, having, lab, listening, running
from tests.support import eventually


class Service:
    """The REST API of a running `course lab`."""

    def __init__(self, process: subprocess.Popen[str], address: str) -> None:
        self.process, self.address = process, address
        parts = urlsplit(address)
        self.port, self.path = parts.port or 0, parts.path
        self.token = parse_qs(parts.query)["token"][0]
        self._base = f"http://{parts.netloc}"
        self._headers = {"Authorization": f"token {self.token}"}

    def text(self, path: str) -> str:
        """Send a GET request to the server, and return the text of the response."""
        with urlopen(Request(self._base + path, headers=self._headers), timeout=20) as answer:  # noqa: S310
            return str(answer.read().decode())

    def get(self, path: str) -> Plain:
        """Send a GET request to the server, and return the JSON of the response."""
        return json.loads(self.text(path))

    def kernels(self) -> Plain:
        """Return the running kernels."""
        return self.get("/api/kernels")

    def post(self, path: str) -> None:
        """Send a POST request to the server."""
        request = Request(self._base + path, data=b"", headers=self._headers)  # noqa: S310
        urlopen(request, timeout=20).close()  # noqa: S310


@pytest.fixture(scope="module")
def notebook(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Create an empty notebook in the checkout."""
    path = ROOT / "tests" / "lab" / f"empty-{os.getpid()}.ipynb"
    path.write_text(json.dumps({"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}))
    yield str(path)
    path.unlink()


@pytest.fixture(scope="module")
def served(notebook: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """Start one server with two installed extensions for all tests that do not stop the server."""
    folder = tmp_path_factory.mktemp("installed")
    enabled = folder / "jupyter_server_config.d" / "sockets.json"
    front_end = folder / "labextensions" / "example" / "package.json"
    for path in (enabled, front_end):
        path.parent.mkdir(parents=True)
    enabled.write_text(json.dumps({"ServerApp": {"jpserver_extensions": {"tests.lab.sockets": True}}}))
    build = {"load": "static/remoteEntry.js", "extension": "./extension"}
    front_end.write_text(
        json.dumps({"name": "example-extension", "version": "1.0", "jupyterlab": {"_build": build}})
    )
    with lab(notebook, JUPYTER_CONFIG_PATH=str(folder), JUPYTER_PATH=str(folder)) as (process, address):
        yield Service(process, address)


def test_the_address_opens_the_notebook_and_its_kernel_runs(served: Service, notebook: str) -> None:
    """The printed address opens the notebook, and the notebook's kernel runs."""
    name = str(Path(notebook).relative_to(ROOT))
    assert f"/lab/tree/{name}?token=" in served.address
    assert [session["path"] for session in served.get("/api/sessions")] == [name]
    assert served.kernels()


def test_extensions_that_a_user_installs_are_loaded(served: Service) -> None:
    """An installed server extension responds, and the page loads an installed front-end extension."""
    assert served.get("/sockets") == []
    assert "example-extension" in served.text(served.path)


def test_each_start_opens_only_its_notebook(served: Service, notebook: str) -> None:
    """The page opens only the notebook of the latest start."""
    name = f"notebook:{Path(notebook).relative_to(ROOT)}"
    with lab(str(ROOT / "notebooks" / "00_start_the_graph.ipynb")) as (process, address):
        data = Service(process, address).get("/lab/api/workspaces/default")["data"]
        assert (
            data["layout-restorer:data"]["main"]["current"] == "notebook:notebooks/00_start_the_graph.ipynb"
        )
    data = served.get("/lab/api/workspaces/default")["data"]
    assert data["layout-restorer:data"]["main"]["dock"]["widgets"] == [name]
    assert [key for key in data if key.startswith("notebook:")] == [name]


def test_nothing_listens_beyond_this_host(served: Service) -> None:
    """The server, the kernel and the master listen only on 127.0.0.1."""
    eventually(served.kernels)
    family = [served.process.pid, *below(served.process)]
    assert served.port in listening_ports(served.process.pid)
    assert {host for host, _ in listening(family)} == {"127.0.0.1"}


def test_a_checkpoint_is_kept_outside_of_the_checkout(served: Service, notebook: str) -> None:
    """A checkpoint is stored outside the checkout."""
    at = f"/api/contents/{Path(notebook).relative_to(ROOT)}/checkpoints"
    served.post(at)
    assert [found["id"] for found in served.get(at)] == ["checkpoint"]
    assert not (Path(notebook).parent / ".ipynb_checkpoints").exists()


def test_the_terminal_is_the_courses_shell(served: Service) -> None:
    """A terminal in JupyterLab runs bash with the course's settings."""
    served.post("/api/terminals")
    assert eventually(lambda: having(b"bash\0--rcfile\0", below(served.process)))


def test_the_page_asks_for_no_news_and_no_build(served: Service) -> None:
    """JupyterLab does not fetch news and does not check for updates."""
    settings = {entry["id"]: entry for entry in served.get("/lab/api/settings")["settings"]}
    defaults = settings["@jupyterlab/apputils-extension:notification"]["schema"]["properties"]
    assert defaults["fetchNews"]["default"] == "false"
    assert defaults["checkForUpdates"]["default"] is False


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_everything(number: signal.Signals, notebook: str) -> None:
    """After Ctrl-C or SIGTERM, JupyterLab, its kernels and the master exit with status 0."""
    with lab(notebook) as (process, address):
        eventually(Service(process, address).kernels)
        family = below(process)
        process.send_signal(number)
        assert "Ending JupyterLab" in process.communicate(timeout=20)[0]
        assert process.returncode == 0
        assert all_gone(family)


def test_nothing_outlives_a_killed_lab(notebook: str) -> None:
    """After SIGKILL of `course lab`, all its processes exit, and the next start works."""
    port = str(free_port())
    for _ in range(2):
        with lab(notebook, "--port", port) as (process, address):
            served = Service(process, address)
            eventually(served.kernels)
            family = below(process)
            process.kill()
            assert all_gone(family)
            assert not can_connect(served.port)


def test_a_killed_kernel_is_replaced(served: Service) -> None:
    """After SIGKILL of the kernel, the server starts a new kernel."""
    [victim] = eventually(lambda: having(b"ipykernel_launcher", below(served.process)))
    os.kill(victim, signal.SIGKILL)
    assert eventually(
        lambda: [pid for pid in having(b"ipykernel_launcher", below(served.process)) if pid != victim]
    )


def test_a_killed_server_ends_the_command(notebook: str) -> None:
    """If the server is killed, `course lab` exits with an error status, and no process remains."""
    with lab(notebook) as (process, address):
        eventually(Service(process, address).kernels)
        family = below(process)
        [_supervisor, server] = having(b"-m\0course_pkg.lab\0", family)
        os.kill(server, signal.SIGKILL)
        process.communicate(timeout=20)
        assert process.returncode != 0
        assert all_gone(family)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--port", "{busy}"], "JupyterLab cannot listen on 127.0.0.1:{busy}: Address already in use."),
        (["--port", "99999"], "Omit --port"),
        (["--ip", "203.0.113.7"], "JupyterLab cannot listen on 203.0.113.7"),
        (["no-such.ipynb"], "There is no notebook no-such.ipynb"),
        (["/etc/hostname"], "JupyterLab serves only this folder"),
    ],
)
def test_wrong_options_are_refused_at_once(words: list[str], message: str) -> None:
    """If an option is wrong, `course lab` prints the reason and exits with status 1."""
    with socket.socket() as busy:
        busy.bind(("127.0.0.1", 0))
        busy.listen()
        port = str(busy.getsockname()[1])
        started = time.monotonic()
        with running("lab", "--no-browser", *(word.format(busy=port) for word in words)) as process:
            output = process.communicate(timeout=20)[0]
    assert process.returncode == 1
    assert message.format(busy=port) in output
    assert "Traceback" not in output
    assert time.monotonic() - started < 10


def test_a_workspace_in_which_catkin_cannot_build_is_named(tmp_path: Path) -> None:
    """If catkin cannot build in the workspace, `course lab` prints a warning and starts."""
    folder = str(tmp_path / "my ws")
    with running("lab", "--no-browser", COURSE_WORKSPACE=folder) as process:
        assert process.stdout
        warning = next(line for line in process.stdout if folder in line)
        assert "the path contains a space" in warning
        assert "Move the course" in warning
        assert address_of(process)
