"""A real JupyterLab with a ROS master of its own, and what a test does in it as a person would."""

from __future__ import annotations

import json
import os
import re
import socket
import sys
import urllib.request
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from urllib.error import URLError

import nbformat
from playwright.sync_api import Browser, Locator, Page, expect

import course_pkg.lab
from course_pkg.graph import PrivateMaster
from course_pkg.graph.leash import Leash
from tests.support import eventually

READY = 60_000  # ms: a browser, a server and a kernel start on a machine that may be busy
OVERRIDES = Path(course_pkg.lab.__file__).with_name("settings") / "overrides.json"  # the course's own


@dataclass(frozen=True)
class Lab:
    """A running server: its address, and the folder that it shows."""

    url: str
    folder: Path


@contextmanager
def running_lab(folder: Path, theme: str = "Light") -> Iterator[Lab]:
    """Start JupyterLab on a free port with a private master; both end with the block or with this process."""
    port = _free_port()
    root = folder / "notebooks"
    root.mkdir(parents=True)
    with PrivateMaster() as master:
        server = Leash(_command(port, root), env=_environment(folder, master.uri, theme))
        try:
            url = f"http://127.0.0.1:{port}"
            eventually(lambda: _answers(f"{url}/api/status"), timeout=60)
            yield Lab(url, root)
        finally:
            server.end()


@contextmanager
def new_page(browser: Browser) -> Iterator[Page]:
    """Open a page that may use the clipboard; an error of a script on it fails the test."""
    permissions = ["clipboard-read", "clipboard-write"]
    context = browser.new_context(viewport={"width": 1280, "height": 1000}, permissions=permissions)
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    yield page
    context.close()
    assert errors == []


@contextmanager
def running_notebook(page: Page, lab: Lab, name: str, *cells: str) -> Iterator[None]:
    """Open a notebook with these code cells and run them; its kernel and node end with the block."""
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.write(notebook, lab.folder / f"{name}.ipynb")
    page.goto(f"{lab.url}/lab/workspaces/{name}/tree/{name}.ipynb?reset")
    try:
        # Run All before that opens a dialog that asks for a kernel.
        expect(page.locator("#jp-main-statusbar")).to_contain_text("| Idle", timeout=READY)
        run_all(page)
        yield
    finally:
        _end_kernel(lab, f"{name}.ipynb")


def run_all(page: Page) -> None:
    """Run every cell and wait for the last to end."""
    last = page.locator(".jp-CodeCell .jp-InputPrompt").last
    before = last.inner_text()
    page.get_by_role("menuitem", name="Run", exact=True).click()
    page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
    expect(last).not_to_have_text(before, timeout=READY)
    expect(last).to_have_text(re.compile(r"\[\d+\]:"), timeout=READY)


def panel(page: Page, label: str = "Service panel") -> Locator:
    """Find a panel by its name."""
    found = page.get_by_role("region", name=label, exact=True)
    expect(found).to_be_visible(timeout=READY)
    return found


def picture(target: Page | Locator, name: str) -> None:
    """Keep a screenshot among the artefacts of the run."""
    folder = Path(os.environ.get("COURSE_ARTIFACTS") or Path(__file__).parents[1] / "artifacts")
    folder.mkdir(parents=True, exist_ok=True)
    target.screenshot(path=folder / f"{name}.png")


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
        "LabApp.news_url": "",
    }
    return [sys.executable, "-m", "jupyterlab", *(f"--{name}={value}" for name, value in options.items())]


def _environment(folder: Path, master: str, theme: str) -> Mapping[str, str]:
    """Give the server settings, state and kernels' files of its own, so that runs in parallel do not meet."""
    themes = {"@jupyterlab/apputils-extension:themes": {"theme": f"JupyterLab {theme}"}}
    for place, values in (json.loads(OVERRIDES.read_text("utf-8")) | themes).items():
        extension, _, name = place.partition(":")
        settings = folder / "settings" / extension
        settings.mkdir(parents=True, exist_ok=True)
        (settings / f"{name}.jupyterlab-settings").write_text(json.dumps(values))
    places = {
        "JUPYTERLAB_SETTINGS_DIR": folder / "settings",
        "JUPYTERLAB_WORKSPACES_DIR": folder / "workspaces",
        "JUPYTER_CONFIG_DIR": folder / "config",
        "JUPYTER_RUNTIME_DIR": folder / "runtime",
        "IPYTHONDIR": folder / "ipython",
        "COURSE_STATE": folder / "state",
        "ROS_MASTER_URI": master,
    }
    return {**os.environ, **{name: str(value) for name, value in places.items()}}


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def _answers(url: str) -> bool:
    try:
        with urllib.request.urlopen(url, timeout=2) as answer:  # noqa: S310 - our own server
            return bool(answer.status == 200)
    except (URLError, OSError):
        return False
