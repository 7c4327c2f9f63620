"""Tests of the server extension: the option TCP_NODELAY of kernel websockets, and stored checkpoints."""

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
from ipykernel.ipkernel import IPythonKernel
from tornado.httpclient import AsyncHTTPClient, HTTPClientError, HTTPRequest
from tornado.web import HTTPError
from tornado.websocket import websocket_connect

from course_pkg.lab import extension
from course_pkg.lab.extension import HIDDEN, CachedCheckpoints, CourseContents, kernel_language
from course_pkg.ports import free_port
from tests.lab.commands import ROOT


class Log:
    """A logger that collects its warnings."""

    def __init__(self) -> None:
        self.warnings: list[str] = []

    def warning(self, text: str, *values: object) -> None:
        """Store a warning."""
        self.warnings.append(text % values)


def completed(work: Coroutine[None, None, object]) -> object:
    """Run a coroutine on another thread, because a browser test may use this thread's event loop."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, work).result()


@contextmanager
def server(folder: Path, *, ours: bool) -> Iterator[str]:
    """Run a Jupyter Server with or without the course's extension; yield its host and port."""
    names = {"tests.lab.sockets": True, "course_pkg.lab.extension": ours}
    port = free_port()
    options = ["--no-browser", "--allow-root", "--IdentityProvider.token=t", f"--ServerApp.port={port}"]
    options += [f"--ServerApp.jpserver_extensions={names}", f"--ServerApp.root_dir={folder}"]
    options += ["--ServerApp.port_retries=0"]
    command = [sys.executable, "-m", "jupyter_server", *options]
    with (folder / "log").open("wb") as log, subprocess.Popen(command, cwd=ROOT, stderr=log) as process:
        try:
            yield f"127.0.0.1:{port}"
        finally:
            process.terminate()
            process.wait(20)


async def ask(host: str, path: str, method: str = "GET") -> object:
    """Send a request until the server responds, and return the JSON of the response."""
    request = HTTPRequest(f"http://{host}{path}?token=t", method=method, allow_nonstandard_methods=True)
    while True:
        try:
            return json.loads((await AsyncHTTPClient().fetch(request)).body)
        except (ConnectionRefusedError, HTTPClientError):
            await asyncio.sleep(0.05)


async def options_of_a_page(host: str) -> object:
    """Open a kernel's websocket, and return whether TCP_NODELAY is set on the server's kernel websockets."""
    kernel = await ask(host, "/api/kernels", "POST")
    assert isinstance(kernel, dict)
    page = await websocket_connect(f"ws://{host}/api/kernels/{kernel['id']}/channels?token=t&session_id=s")
    try:
        return await ask(host, "/sockets")
    finally:
        page.close()


@pytest.mark.parametrize("ours", [False, True])
def test_only_the_extension_sets_the_socket_option(ours: bool, tmp_path: Path) -> None:
    """A kernel's websocket has TCP_NODELAY only if the extension is enabled."""
    with server(tmp_path, ours=ours) as host:
        assert completed(asyncio.wait_for(options_of_a_page(host), 60)) == [ours]


def test_a_server_without_the_setting_does_not_change() -> None:
    """If the server's settings do not have the expected entry, the extension only logs a warning."""
    log = Log()
    extension._send_at_once(SimpleNamespace(log=log, web_app=SimpleNamespace(settings={})))
    assert len(log.warnings) == 1


def test_a_connection_works_if_the_option_cannot_be_set() -> None:
    """If the option cannot be set, the connection works, and the extension logs a warning."""

    class Stock:
        log, websocket_handler, connected = Log(), object(), False

        async def connect(self) -> None:
            self.connected = True

    connection = extension.undelayed(Stock)()  # type: ignore[arg-type]  # a handler without set_nodelay()
    completed(connection.connect())
    assert connection.connected
    assert len(Stock.log.warnings) == 1


@pytest.fixture
def kept(tmp_path: Path) -> CachedCheckpoints:
    """Return a checkpoint store for a checkout with two notebooks of the same name."""
    for chapter in ("notebooks", "solutions"):
        folder = tmp_path / "checkout" / chapter
        folder.mkdir(parents=True)
        (folder / "05_x.ipynb").write_text(chapter)
    return CachedCheckpoints(root_dir=str(tmp_path / "checkout"), folder=str(tmp_path / "cache"))


def make(kept: CachedCheckpoints, path: str) -> None:
    """Create a checkpoint as the server does."""
    manager = SimpleNamespace(_get_os_path=lambda name: str(Path(kept.root_dir, name)))
    completed(kept.create_checkpoint(manager, path))


def test_two_notebooks_of_one_name_have_separate_checkpoints(kept: CachedCheckpoints, tmp_path: Path) -> None:
    """A chapter's notebook and its solution have separate checkpoint files outside the checkout."""
    before = sorted((tmp_path / "checkout").rglob("*"))
    for chapter in ("notebooks", "solutions"):
        make(kept, f"{chapter}/05_x.ipynb")
    for chapter in ("notebooks", "solutions"):
        assert Path(kept.checkpoint_path("checkpoint", f"/{chapter}/05_x.ipynb")).read_text() == chapter
    assert sorted((tmp_path / "checkout").rglob("*")) == before


def test_no_path_leads_out_of_the_checkout(kept: CachedCheckpoints) -> None:
    """If a path leads out of the checkout, checkpoint_path() raises an HTTPError with status 404."""
    with pytest.raises(HTTPError, match="404"):
        kept.checkpoint_path("checkpoint", "../elsewhere.ipynb")


def names(manager: CourseContents, path: str) -> set[str]:
    """Return the names that the file browser lists for a folder."""
    model = completed(manager.get(path))
    assert isinstance(model, dict)
    return {each["name"] for each in model["content"]}


def test_the_root_folder_lists_only_files_for_students(tmp_path: Path) -> None:
    """The root folder lists only the files for students."""
    for folder in (*HIDDEN, "notebooks", "figures", "workspace/src/my_arm/tests"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "my_notes.md").touch()
    manager = CourseContents(root_dir=str(tmp_path))
    assert names(manager, "") == names(manager, "/") == {"notebooks", "figures", "workspace", "my_notes.md"}
    assert names(manager, "workspace/src/my_arm") == {"tests"}
    # The file browser hides the folder, but a user can open the folder by its path.
    assert names(manager, "solutions") == set()
    manager.everything = True
    assert names(manager, "") >= set(HIDDEN)


def test_a_notebook_comes_with_the_language_of_its_kernel() -> None:
    """When the server loads a notebook, the notebook's metadata contain the kernel's language_info."""
    said = IPythonKernel.language_info
    assert kernel_language() == said
    manager = CourseContents(root_dir=str(ROOT))
    model = completed(manager.get("notebooks/00_start_the_graph.ipynb"))
    assert isinstance(model, dict)
    assert model["content"]["metadata"]["language_info"] == said


def test_every_file_of_the_repository_is_listed_or_hidden_on_purpose() -> None:
    """HIDDEN lists each file in the root folder except dot files, `notebooks` and `figures`."""
    tracked = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    top = {path.partition("/")[0] for path in tracked.splitlines()}
    assert {name for name in top if not name.startswith(".")} == {*HIDDEN, "notebooks", "figures"}
