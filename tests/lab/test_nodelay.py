"""TCP_NODELAY on the kernel websocket, on a real server."""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys
from collections.abc import Coroutine, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPError, HTTPRequest
from tornado.websocket import websocket_connect

from course_pkg.lab import nodelay
from course_pkg.lab.ports import free_port
from tests.lab.commands import ROOT


def completed(work: Coroutine[None, None, object]) -> object:
    """Run `work` to its end, on a thread: a browser of another test may hold this one's loop."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, work).result()


@contextmanager
def server(folder: Path, *extensions: str) -> Iterator[str]:
    """Run a stock Jupyter Server with `extensions`; yield its host and port."""
    names = dict.fromkeys(("tests.lab.sockets", *extensions), True)
    port = free_port()
    options = [
        f"--ServerApp.jpserver_extensions={names}",
        f"--ServerApp.port={port}",
        "--ServerApp.port_retries=0",
    ]
    options += [
        "--no-browser",
        "--allow-root",
        "--IdentityProvider.token=t",
        f"--ServerApp.root_dir={folder}",
    ]
    command = [sys.executable, "-m", "jupyter_server", *options]
    with (folder / "log").open("wb") as log, subprocess.Popen(command, cwd=ROOT, stderr=log) as process:
        try:
            yield f"127.0.0.1:{port}"
        finally:
            process.terminate()
            process.wait(20)


async def ask(host: str, path: str, method: str = "GET") -> object:
    """Ask the server, as often as it takes until it is up."""
    request = HTTPRequest(f"http://{host}{path}?token=t", method=method, allow_nonstandard_methods=True)
    while True:
        try:
            return json.loads((await AsyncHTTPClient().fetch(request)).body)
        except (ConnectionRefusedError, HTTPError):
            await asyncio.sleep(0.05)


async def options_of_a_page(host: str) -> object:
    """Open a kernel's websocket as a page does, and return what the server's sockets say."""
    kernel = await ask(host, "/api/kernels", "POST")
    assert isinstance(kernel, dict)
    page = await websocket_connect(f"ws://{host}/api/kernels/{kernel['id']}/channels?token=t&session_id=s")
    try:
        return await ask(host, "/sockets")
    finally:
        page.close()


@pytest.mark.parametrize(("extensions", "seen"), [((), [False]), (("course_pkg.lab.nodelay",), [True])])
def test_the_socket_option_is_set_by_the_extension_alone(
    extensions: tuple[str, ...], seen: list[bool], tmp_path: Path
) -> None:
    """The stock server leaves a kernel's websocket to Nagle's algorithm; with the extension it does not."""
    with server(tmp_path, *extensions) as host:
        assert completed(asyncio.wait_for(options_of_a_page(host), 60)) == seen


def test_a_server_that_is_built_otherwise_is_left_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the handler is not what it is today, one line is logged and nothing changes."""
    lines: list[str] = []
    log = SimpleNamespace(warning=lambda text, *values: lines.append(text % values))
    monkeypatch.setitem(sys.modules, "jupyter_server.services.kernels.websocket", SimpleNamespace())
    nodelay._load_jupyter_server_extension(SimpleNamespace(log=log))
    assert len(lines) == 1


def test_a_socket_that_takes_no_option_is_served_all_the_same() -> None:
    """Where the option cannot be set, the page opens as it would without."""
    lines: list[str] = []

    async def stock(handler: object, kernel: str) -> None:
        lines.append(f"opened {kernel}")

    log = SimpleNamespace(warning=lambda *_: lines.append("warned"))
    completed(nodelay._undelayed(stock, log)(object(), "k"))  # type: ignore[arg-type]
    assert lines == ["warned", "opened k"]
