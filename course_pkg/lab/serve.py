"""`course lab`: a master, JupyterLab, and the end of both."""

from __future__ import annotations

import os
import secrets
import signal
import socket
import sys
import tempfile
import time
import webbrowser
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import BinaryIO, NoReturn

from course_pkg.errors import CourseError, SetupError
from course_pkg.graph.leash import Leash
from course_pkg.lab.master import master_coming_up
from course_pkg.lab.ports import listening
from course_pkg.lab.task import VARIABLE, Task
from course_pkg.provision import Places

PORTS = (*range(8888, 8938), 0)  # as Jupyter does: its own port, one of the next, or any
READY = 60.0  # s; it takes one, and many times that where the disk is cold
LOOK = 0.01  # s between looks for the server's answer
KEPT_LINES = 12


def serve_lab(notebook: str | None, *, port: int | None, ip: str, browser: bool) -> int:
    """Serve JupyterLab until Ctrl-C or SIGTERM; return 0, or the server's status if it ends by itself."""
    places = Places.of()
    first = _page(places.checkout, notebook)
    with (
        _stopping_on_signals(),
        tempfile.TemporaryDirectory(prefix="course-lab-") as scratch,
        listening(ip, PORTS if port is None else [port]) as listener,
    ):
        task = Task(
            socket=listener.fileno(),
            token=os.environ.get("JUPYTER_TOKEN") or secrets.token_hex(24),
            notebook=first,
            page=str(places.cache / "jupyter" / "page.json"),
            ready=str(Path(scratch, "ready")),
        )
        log = Path(scratch, "server.log")
        with (
            log.open("wb") as output,
            master_coming_up() as master_is_up,
            _server(places, task, _options(places, listener, ip, scratch), output) as server,
        ):
            try:
                _announce(_address(listener, ip, task), places.checkout, browser)
                listener.close()  # the server has it
                _await(server, Path(task.ready), log)
                master_is_up()
                while not server.wait(3600):
                    pass
            except _Stop:
                sys.stderr.write("\nEnding JupyterLab and the master.\n")
                return 0
            sys.stderr.write(_tail(log))
            return server.returncode or 0


class _Stop(BaseException):
    """Somebody asked this command to end; like KeyboardInterrupt, nothing on the way may swallow it."""


@contextmanager
def _stopping_on_signals() -> Iterator[None]:
    def stop(number: int, _frame: FrameType | None) -> NoReturn:
        signal.signal(number, signal.SIG_IGN)  # the end is under way: a second Ctrl-C changes nothing
        raise _Stop

    kept = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    try:
        yield
    except _Stop:
        sys.exit(0)
    finally:
        for number, handler in kept.items():
            signal.signal(number, handler)


@contextmanager
def _server(places: Places, task: Task, options: Mapping[str, object], output: BinaryIO) -> Iterator[Leash]:
    """Run the server, and end it with all its kernels and terminals, also when this process is killed."""
    arguments = [f"--{name}={value}" for name, value in options.items()]
    leash = Leash(
        [str(places.python), "-m", "course_pkg.lab", *arguments],
        output=output,
        env={**os.environ, **_jupyter_folders(places), VARIABLE: task.as_text()},
        inherit=[task.socket],
        remove=Path(output.name).parent,
    )
    try:
        yield leash
    finally:
        leash.end()


def _options(places: Places, listener: socket.socket, ip: str, scratch: str) -> dict[str, object]:
    return {
        "ServerApp.root_dir": places.checkout,
        "ServerApp.ip": ip,
        "ServerApp.port": listener.getsockname()[1],
        "ServerApp.open_browser": False,
        "ServerApp.allow_root": True,
        "ContentsManager.checkpoints_class": "course_pkg.lab.checkpoints.CachedCheckpoints",
        "CachedCheckpoints.folder": places.cache / "jupyter" / "checkpoints",
        "CourseLab.user_settings_dir": _user_settings(),
        "CourseLab.workspaces_dir": Path(scratch, "workspaces"),
    }


def _address(listener: socket.socket, ip: str, task: Task) -> str:
    """Return the address of the page; one that stands for all of this host's is no address to go to."""
    host = socket.gethostname() if ip in ("", "0.0.0.0", "::") else f"[{ip}]" if ":" in ip else ip  # noqa: S104
    return f"http://{host}:{listener.getsockname()[1]}{task.path}?token={task.token}"


def _jupyter_folders(places: Places) -> dict[str, str]:
    """Return variables that keep the server apart from the user's other Jupyter, its settings and kernels."""
    folder = places.cache / "jupyter"
    return {
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTER_DATA_DIR": str(folder / "data"),
        "JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
        "JUPYTER_NO_CONFIG": "1",
    }


def _user_settings() -> Path:
    """Return where the user's own choices for JupyterLab lie, a theme for example: these do hold here."""
    given = os.environ.get("JUPYTERLAB_SETTINGS_DIR")
    config = os.environ.get("JUPYTER_CONFIG_DIR") or os.path.expanduser("~/.jupyter")
    return Path(given) if given else Path(config) / "lab" / "user-settings"


def _page(checkout: Path, notebook: str | None) -> str:
    """Return the notebook to open, relative to the checkout: the one asked for, else the first chapter."""
    if notebook is None:
        chapters = sorted((checkout / "notebooks").glob("[0-9][0-9]_*.ipynb"))
        return str(chapters[0].relative_to(checkout)) if chapters else ""
    path = Path(notebook).resolve()
    if not path.is_file():
        raise SetupError(f"There is no notebook {notebook}. The chapters are in {checkout / 'notebooks'}.")
    if not path.is_relative_to(checkout):
        raise SetupError(
            f"{path} is not in {checkout}, and JupyterLab serves that folder only. Copy it there."
        )
    return str(path.relative_to(checkout))


def _await(server: Leash, ready: Path, log: Path) -> None:
    """Wait until the server answers."""
    deadline = time.monotonic() + READY
    while not ready.exists():
        if server.wait(LOOK):
            raise CourseError(
                f"JupyterLab ended with status {server.returncode} as it started:\n{_tail(log)}"
            )
        if time.monotonic() > deadline:
            raise CourseError(f"JupyterLab did not answer within {READY:g} s:\n{_tail(log)}")


def _announce(address: str, checkout: Path, browser: bool) -> None:
    opened = browser and webbrowser.open(address)
    sys.stdout.write(
        f"JupyterLab serves {checkout} at\n\n    {address}\n\n"
        f"{'It opens in your browser.' if opened else 'Open this address in your browser.'} "
        "Ctrl-C here ends JupyterLab, its kernels, and the ROS master.\n"
    )
    sys.stdout.flush()


def _tail(log: Path) -> str:
    return "\n".join(log.read_text(errors="replace").splitlines()[-KEPT_LINES:]) + "\n"
