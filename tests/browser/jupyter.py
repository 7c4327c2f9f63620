"""Runs a real JupyterLab with a ROS master, and uses JupyterLab as a student does."""

from __future__ import annotations

import json
import os
import re
import sys
import tempfile
import urllib.request
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from urllib.error import URLError

import nbformat
from playwright.sync_api import Page, expect

import course_pkg.lab
from course_pkg.lab.shell import SHELL
from course_pkg.ports import free_port
from course_pkg.ros import PrivateMaster
from course_pkg.ros.process.supervised import SupervisedProcess
from tests.browser.pages import READY
from tests.support import eventually

# These functions run in the page. The first function closes all notebooks without a dialog, and then opens
# one notebook.
OPEN = """async (path) => {
  const { commands, serviceManager, shell } = window.jupyterapp;
  await serviceManager.ready;
  for (const open of [...shell.widgets("main")]) open.dispose();
  const how = { path, factory: "Notebook", kernel: { name: "python3" } };
  const shown = await commands.execute("docmanager:open", how);
  await shown.context.ready;
  await shown.sessionContext.ready;
}"""
CONNECTED = 90_000  # The kernel may need up to this time in ms to become idle.
IDLE = "() => window.jupyterapp.shell.currentWidget?.sessionContext?.session?.kernel?.status === 'idle'"
THEME = "(theme) => window.jupyterapp.commands.execute('apputils:change-theme', { theme })"
# This file contains the course's settings of JupyterLab.
OVERRIDES = Path(course_pkg.lab.__file__).with_name("settings") / "overrides.json"


@dataclass(frozen=True)
class Lab:
    """A running JupyterLab server with its address and its root folder."""

    url: str
    folder: Path


@contextmanager
def running_lab(folder: Path) -> Iterator[Lab]:
    """Run JupyterLab on a free port with a private master during the `with` block."""
    port = free_port()
    root = folder / "notebooks"
    root.mkdir(parents=True)
    # The path of a kernel's socket can have at most 107 bytes, so the folder of the sockets has a short name.
    with PrivateMaster() as master, tempfile.TemporaryDirectory(prefix="lab-") as runtime:
        environment = _environment(folder, runtime, master.uri)
        server = SupervisedProcess(_command(port, root), env=environment, cwd=root)
        try:
            url = f"http://127.0.0.1:{port}"
            eventually(lambda: _answers(f"{url}/api/status"), timeout=60)
            yield Lab(url, root)
        finally:
            server.end()


@contextmanager
def running_notebook(page: Page, lab: Lab, name: str, *cells: str, theme: str = "Light") -> Iterator[None]:
    """Open a notebook with these code cells, and run them. The kernel runs until the `with` block ends."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(notebook, lab.folder / f"{name}.ipynb")
    if not page.url.startswith(lab.url):
        page.goto(f"{lab.url}/lab/workspaces/{name}?reset")
        page.wait_for_function("window.jupyterapp", timeout=READY)
        page.evaluate("window.jupyterapp.restored")
    try:
        page.evaluate(THEME, f"JupyterLab {theme}")
        page.evaluate(OPEN, f"{name}.ipynb")
        # Without this wait, Run All opens a dialog that asks for a kernel.
        page.wait_for_function(IDLE, timeout=CONNECTED)
        run_all(page)
        yield
    finally:
        _end_kernel(lab, f"{name}.ipynb")


def run_all(page: Page) -> None:
    """Run all cells, and wait until the last cell has finished."""
    last = page.locator(".jp-CodeCell .jp-InputPrompt").last
    before = last.inner_text()
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    expect(last).not_to_have_text(before, timeout=READY)
    expect(last).to_have_text(re.compile(r"\[\d+\]:"), timeout=READY)


def _end_kernel(lab: Lab, path: str) -> None:
    with urllib.request.urlopen(f"{lab.url}/api/sessions", timeout=10) as answer:  # noqa: S310 - our own server
        sessions = [session["id"] for session in json.load(answer) if session["path"] == path]
    for session in sessions:
        request = urllib.request.Request(f"{lab.url}/api/sessions/{session}", method="DELETE")  # noqa: S310
        urllib.request.urlopen(request, timeout=30).close()  # noqa: S310


def _command(port: int, root: Path) -> list[str]:
    options = {
        "ServerApp.ip": "127.0.0.1",
        "ServerApp.port": port,
        "ServerApp.port_retries": 0,
        "ServerApp.root_dir": root,
        "ServerApp.open_browser": False,
        "ServerApp.allow_root": True,
        "ServerApp.disable_check_xsrf": True,
        "IdentityProvider.token": "",
        "ServerApp.terminado_settings": {"shell_command": list(SHELL)},
        "LabApp.news_url": "",
        "LabApp.expose_app_in_browser": True,
        # The kernels use Unix sockets, because another program could take a TCP port before the kernel
        # listens on it.
        "KernelManager.transport": "ipc",
    }
    return [sys.executable, "-m", "jupyterlab", *(f"--{name}={value}" for name, value in options.items())]


def _environment(folder: Path, runtime: str, master: str) -> Mapping[str, str]:
    """Return an environment with separate JupyterLab settings, so that several servers can run together."""
    for place, values in json.loads(OVERRIDES.read_text("utf-8")).items():
        extension, _, name = place.partition(":")
        settings = folder / "settings" / extension
        settings.mkdir(parents=True, exist_ok=True)
        (settings / f"{name}.jupyterlab-settings").write_text(json.dumps(values))
    places = {
        "JUPYTERLAB_SETTINGS_DIR": folder / "settings",
        "JUPYTERLAB_WORKSPACES_DIR": folder / "workspaces",
        "JUPYTER_CONFIG_DIR": folder / "config",
        "JUPYTER_RUNTIME_DIR": runtime,
        "IPYTHONDIR": folder / "ipython",
        "COURSE_STATE": folder / "state",
        "COURSE_WORKSPACE": folder / "workspace",
        "ROS_MASTER_URI": master,
    }
    return {**os.environ, **{name: str(value) for name, value in places.items()}}


def _answers(url: str) -> bool:
    try:
        with urllib.request.urlopen(url, timeout=2) as answer:  # noqa: S310 - our own server
            return bool(answer.status == 200)
    except (URLError, OSError):
        return False
