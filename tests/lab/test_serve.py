"""`course lab`: JupyterLab with a master, and the end of both."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit
from urllib.request import Request, urlopen

import pytest

from course_pkg.graph.ports import listening_ports
from course_pkg.lab.page import Page
from course_pkg.lab.ports import free_port
from course_pkg.provision import Places
from tests.lab.commands import ROOT, all_gone, below, lab, running
from tests.support import eventually


class Served:
    """A running `course lab`, asked over its own interface."""

    def __init__(self, process: subprocess.Popen[str], address: str) -> None:
        self.process, self.address = process, address
        parts = urlsplit(address)
        self.port, self.path = parts.port or 0, parts.path
        self.token = parse_qs(parts.query)["token"][0]
        self._base = f"http://{parts.netloc}"
        self._headers = {"Authorization": f"token {self.token}"}

    def text(self, path: str) -> str:
        """Ask the server for `path`."""
        with urlopen(Request(self._base + path, headers=self._headers), timeout=20) as answer:  # noqa: S310
            return str(answer.read().decode())

    def get(self, path: str) -> Any:  # noqa: ANN401 -- JSON
        """Ask the server for `path`, which is JSON."""
        return json.loads(self.text(path))

    def kernels(self) -> list[dict[str, Any]]:
        """Return the kernels that were started."""
        return list(self.get("/api/kernels"))

    def post(self, path: str) -> None:
        """Have the server make something at `path`."""
        request = Request(self._base + path, data=b"", headers=self._headers)  # noqa: S310
        urlopen(request, timeout=20).close()  # noqa: S310


@pytest.fixture(scope="module")
def notebook(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """An empty notebook within the checkout, where the server finds it."""
    path = ROOT / "tests" / "lab" / f"empty-{os.getpid()}.ipynb"
    path.write_text(json.dumps({"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}))
    yield str(path)
    path.unlink()


@pytest.fixture(scope="module")
def served(notebook: str) -> Iterator[Served]:
    """One server for the tests that only look."""
    with lab(notebook) as (process, address):
        yield Served(process, address)


def test_the_address_leads_to_the_notebook_whose_kernel_is_up(served: Served, notebook: str) -> None:
    """The printed address opens the notebook, and its kernel runs before any page asks for one."""
    name = str(Path(notebook).relative_to(ROOT))
    assert f"/lab/tree/{name}?token=" in served.address
    sessions = eventually(lambda: served.get("/api/sessions"))
    assert [session["path"] for session in sessions] == [name]
    assert eventually(served.kernels)


def test_each_start_opens_that_notebook_and_nothing_else(served: Served, notebook: str) -> None:
    """The notebook is in the workspace, so JupyterLab waits for no address; no tab of another start is."""
    name = f"notebook:{Path(notebook).relative_to(ROOT)}"
    with lab(str(ROOT / "notebooks" / "00_start_the_graph.ipynb")) as (process, address):
        data = Served(process, address).get("/lab/api/workspaces/default")["data"]
        assert (
            data["layout-restorer:data"]["main"]["current"] == "notebook:notebooks/00_start_the_graph.ipynb"
        )
    data = served.get("/lab/api/workspaces/default")["data"]
    assert data["layout-restorer:data"]["main"]["dock"]["widgets"] == [name]
    assert [key for key in data if key.startswith("notebook:")] == [name]


def test_the_page_of_the_next_start_is_as_the_server_makes_it(served: Served) -> None:
    """What is kept says the same as the server, with this start's token and notebook in it."""
    kept = Places.of().cache / "jupyter" / "page.json"
    token, notebook = served.token, served.path.removeprefix("/lab/tree/")
    made = served.text(f"{served.path}?token={token}")

    def given() -> str:
        page = Page.read(kept)
        return page.response(token, notebook).partition(b"\r\n\r\n")[2].decode() if page else ""

    assert eventually(lambda: given() == made, timeout=20)


def test_nothing_listens_beyond_this_host(served: Served) -> None:
    """Server, kernel and master listen on 127.0.0.1 and nowhere else."""
    eventually(served.kernels)
    family = [served.process.pid, *below(served.process)]
    assert served.port in listening_ports(family)
    assert foreign_sockets(family) == []


def foreign_sockets(pids: list[int]) -> list[str]:
    """Return the addresses off 127.0.0.1 that the processes listen on, in /proc's own hexadecimal."""
    inodes = set()
    for pid in pids:
        for link in Path(f"/proc/{pid}/fd").glob("*"):
            try:
                inodes.add(os.readlink(link).removeprefix("socket:[").rstrip("]"))
            except OSError:
                continue
    rows = [
        row.split() for name in ("tcp", "tcp6") for row in Path(f"/proc/net/{name}").read_text().splitlines()
    ]
    listening = [(row[1], row[9]) for row in rows if row[3] == "0A"]
    return [local for local, inode in listening if inode in inodes and not local.startswith("0100007F:")]


def test_a_checkpoint_is_kept_outside_of_the_checkout(served: Served, notebook: str) -> None:
    """Saving a notebook leaves no folder beside it; its checkpoint is there all the same."""
    at = f"/api/contents/{Path(notebook).relative_to(ROOT)}/checkpoints"
    served.post(at)
    assert [found["id"] for found in served.get(at)] == ["checkpoint"]
    assert not (Path(notebook).parent / ".ipynb_checkpoints").exists()


def test_the_terminal_is_the_courses_shell(served: Served) -> None:
    """A terminal of JupyterLab runs bash with the course's settings."""
    served.post("/api/terminals")
    assert eventually(lambda: having(b"bash\0--rcfile\0", below(served.process)))


def test_the_page_asks_for_no_news_and_no_build(served: Served) -> None:
    """JupyterLab is told not to look for news, updates or a build, and gets its schemas from the package."""
    settings = {entry["id"]: entry for entry in served.get("/lab/api/settings")["settings"]}
    defaults = settings["@jupyterlab/apputils-extension:notification"]["schema"]["properties"]
    assert defaults["fetchNews"]["default"] == "false"
    assert defaults["checkForUpdates"]["default"] is False


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_everything(number: signal.Signals, notebook: str) -> None:
    """Ctrl-C and SIGTERM end JupyterLab, its kernels and the master, with status 0 and within seconds."""
    with lab(notebook) as (process, address):
        eventually(Served(process, address).kernels)
        family = below(process)
        process.send_signal(number)
        assert "Ending JupyterLab" in process.communicate(timeout=20)[0]
        assert process.returncode == 0
        assert all_gone(family)


def test_nothing_outlives_a_killed_lab(notebook: str) -> None:
    """After SIGKILL of `course lab` no process and no port is left, and the next start is clean."""
    port = str(free_port())
    for _ in range(2):
        with lab(notebook, "--port", port) as (process, address):
            served = Served(process, address)
            eventually(served.kernels)
            family = below(process)
            process.kill()
            assert all_gone(family)
            assert not can_connect(served.port)


def can_connect(port: int) -> bool:
    """Say whether anybody listens on a port of this host."""
    with socket.socket() as client:
        return client.connect_ex(("127.0.0.1", port)) == 0


def test_a_killed_kernel_is_replaced(served: Served) -> None:
    """After SIGKILL of the kernel the server starts it anew."""
    [victim] = eventually(lambda: having(b"ipykernel_launcher", below(served.process)))
    os.kill(victim, signal.SIGKILL)
    assert eventually(
        lambda: [pid for pid in having(b"ipykernel_launcher", below(served.process)) if pid != victim]
    )


def test_a_killed_server_ends_the_command(notebook: str) -> None:
    """Where the server dies, `course lab` ends too, and its status is not 0."""
    with lab(notebook) as (process, address):
        eventually(Served(process, address).kernels)
        family = below(process)
        [_watcher, server] = having(b"-m\0course_pkg.lab\0", family)
        os.kill(server, signal.SIGKILL)
        process.communicate(timeout=20)
        assert process.returncode != 0
        assert all_gone(family)


def having(words: bytes, pids: list[int]) -> list[int]:
    """Return those of `pids` in whose command line `words` stand."""
    found = []
    for pid in pids:
        try:
            if words in Path(f"/proc/{pid}/cmdline").read_bytes():
                found.append(pid)
        except OSError:
            continue
    return found


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--port", "{busy}"], "JupyterLab cannot listen on 127.0.0.1:{busy}: Address already in use."),
        (["--port", "99999"], "Leave --port out"),
        (["--ip", "203.0.113.7"], "JupyterLab cannot listen on 203.0.113.7"),
        (["no-such.ipynb"], "There is no notebook no-such.ipynb"),
        (["/etc/hostname"], "JupyterLab serves that folder only"),
    ],
)
def test_what_cannot_be_is_one_clear_message_at_once(words: list[str], message: str) -> None:
    """A busy or impossible port or address, or a notebook that is not there: status 1 and the reason."""
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
