"""`course lab` starts a master and JupyterLab with the course's settings, and ends both before it exits."""

from __future__ import annotations

import os
import signal
import sys
import tempfile
import webbrowser
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from types import FrameType
from typing import NoReturn
from urllib.parse import quote

from course_pkg.errors import PortBusy, SetupError
from course_pkg.lab.graph.graph import Which, graph_of_this_command
from course_pkg.lab.graph.notes import notes
from course_pkg.lab.graph.settings import settings_for
from course_pkg.lab.opened_notebook import notebook_to_open, write_workspace
from course_pkg.lab.own_files import make_own_files
from course_pkg.lab.server_start import Address, PortTaken, await_server, end_of, log_of, start_kernel
from course_pkg.ports import free_port
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.setup import Places
from course_pkg.workspace import make_own_workspace

PORTS = (*range(8888, 8938), 0)  # the ports to try; Jupyter tries the same ports, and 0 means any free port


def serve_lab(asked: str | None, *, port: int | None, ip: str, browser: bool, shared: bool = False) -> int:
    """Run JupyterLab until Ctrl-C or SIGTERM; open the notebook at the path `asked`, or the first chapter.

    The kernels and terminals are on a graph in a private network, or in the network of this computer if
    `shared` is true. The server is always in the network of this computer.

    Returns 0, or the server's exit status if the server ends without a signal to this command. Raises
    SetupError if JupyterLab cannot open the notebook, PortBusy if it cannot listen at the address, and
    CourseError if the server does not start.
    """
    places = Places.of()
    make_own_files(places)
    notebook = notebook_to_open(places.own, asked)
    _make_workspace()
    which = Which.SHARED if shared else Which.RUNNING if os.environ.get("ROS_MASTER_URI") else Which.NEW
    start = partial(_serve, places, notebook, ip=ip, browser=browser, which=which)
    if port is not None:
        return start(server_port(ip, [port]), retries=0)
    for candidates in (PORTS, [0]):
        with suppress(PortTaken):
            return start(server_port(ip, candidates))
    return start(server_port(ip, [0]))


def _serve(
    places: Places,
    notebook: str,
    port: int,
    *,
    ip: str,
    browser: bool,
    which: Which,
    retries: int | None = None,
) -> int:
    """Run JupyterLab until a signal arrives, on the port `port` or on one of the next ports.

    `retries` is the number of next ports to try.

    If `retries` is None, JupyterLab uses its default number of retries. Raises PortTaken if another program
    took the port during the start.
    """
    with (
        _stopping_on_signals(),
        tempfile.TemporaryDirectory(prefix="course-lab-", dir=_short_folder()) as folder,
        graph_of_this_command(which) as graph,
    ):
        scratch = Path(folder)
        write_workspace(scratch / "workspaces", notebook)
        settings = _settings(places, ip, port, scratch) | settings_for(graph)
        # An author opens a notebook in solutions/, and needs to see all files of the checkout.
        settings["CourseContents.everything"] = bool(notebook) and not notebook.startswith("notebooks/")
        if retries is not None:
            settings["ServerApp.port_retries"] = retries
        with _server(places, settings, scratch) as server:
            try:
                address = await_server(server, scratch)
                start_kernel(address, notebook)
                _announce(address, notebook, places.own, browser)
                if graph:
                    graph.wait_for_master()
                    sys.stdout.write(notes(graph, which))
                    sys.stdout.flush()
                while not server.wait(3600):
                    pass
            except _Stop:
                sys.stderr.write("\nEnding JupyterLab and the master.\n")
                return 0
            sys.stderr.write(end_of(log_of(scratch)))
            return server.returncode or 0


def server_port(ip: str, candidates: Sequence[int]) -> int:
    """Return the first port in `candidates` that is free at `ip`; raises PortBusy if no port is free."""
    try:
        return free_port(ip, candidates)
    except OSError as error:
        reason = error.strerror or str(error)
        raise PortBusy(
            f"JupyterLab cannot listen on {ip}:{candidates[-1]}: {reason}. Omit --port to get a free port."
        ) from error


class _Stop(BaseException):
    """A signal to end this command raises this exception.

    `except Exception` does not catch this exception.
    """


@contextmanager
def _stopping_on_signals() -> Iterator[None]:
    def stop(number: int, _frame: FrameType | None) -> NoReturn:
        # This command is already ending, so a second Ctrl-C changes nothing.
        signal.signal(number, signal.SIG_IGN)
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
def _server(places: Places, settings: Mapping[str, object], scratch: Path) -> Iterator[SupervisedProcess]:
    """Run the server during the `with` block.

    After the block, end the server, its kernels and its terminals, even if a signal kills this process.
    """
    folders = {
        # The server uses only these folders. It does not read the settings and files of other Jupyter
        # installations.
        "JUPYTER_CONFIG_DIR": str(places.own_data / "jupyter" / "config"),
        "JUPYTER_DATA_DIR": str(places.own_data / "jupyter" / "data"),
        "JUPYTER_RUNTIME_DIR": str(scratch / "runtime"),
    }
    options = [f"--{name}={value}" for name, value in settings.items()]
    with log_of(scratch).open("wb") as output:
        server = SupervisedProcess(
            [str(places.python), "-m", "course_pkg.lab", *options],
            output=output,
            env={**os.environ, **folders},
            cwd=places.own,  # the folder in which terminals start
            remove=scratch,
        )
        try:
            yield server
        finally:
            server.end()


def _settings(places: Places, ip: str, port: int, scratch: Path) -> dict[str, object]:
    return {
        **server_settings(places.own, places.own_data / "jupyter" / "checkpoints", scratch / "workspaces"),
        "ServerApp.ip": ip,
        "ServerApp.port": port,
    }


def server_settings(root: Path, checkpoints: Path, workspaces: Path) -> dict[str, object]:
    """Return settings for JupyterLab; the keys are the names of its traits.

    All installed extensions stay enabled. course_pkg/lab/extension.py contains the settings that are the same
    for every start. The file browser shows the folder `root`; `checkpoints` and `workspaces` are folders for
    JupyterLab's checkpoints and workspaces.
    """
    return {
        "ServerApp.root_dir": root,
        "ServerApp.open_browser": False,
        "ServerApp.allow_root": True,
        "ServerApp.jpserver_extensions": {"course_pkg.lab.extension": True},
        "CachedCheckpoints.folder": checkpoints,
        "CourseContents.everything": False,
        "LabApp.user_settings_dir": _user_settings(),
        "LabApp.workspaces_dir": workspaces,
        # A browser can cache the front end's files, because their names change when their content changes.
        "LabApp.cache_files": True,
    }


def _short_folder() -> str | None:
    """Return a folder for temporary files with a path that is short enough for a kernel's sockets.

    The path of a socket is 80 bytes longer than the path of this folder, and Linux allows at most 107 bytes.
    The result is None if the usual folder has a short enough path.
    """
    return None if len(os.fsencode(tempfile.gettempdir())) <= 27 else "/tmp"  # noqa: S108 -- a folder of mode 700 in it


def _user_settings() -> Path:
    """Return the folder of the user's own settings for JupyterLab, such as a theme.

    The JupyterLab of the course uses the user's own settings, too.
    """
    given = os.environ.get("JUPYTERLAB_SETTINGS_DIR")
    config = os.environ.get("JUPYTER_CONFIG_DIR") or os.path.expanduser("~/.jupyter")
    return Path(given) if given else Path(config) / "lab" / "user-settings"


def _make_workspace() -> None:
    """Create the folder of the student's own packages.

    Print a message on stderr if the folder cannot be used.
    """
    try:
        make_own_workspace()
    except SetupError as error:
        sys.stderr.write(
            f"{error} The chapters about building packages do not work until you have solved this problem.\n"
        )


def _announce(address: Address, notebook: str, root: Path, browser: bool) -> None:
    page = f"lab/tree/{quote(notebook)}" if notebook else "lab"
    url = f"{address.url}{page}?token={address.token}"
    opened = browser and webbrowser.open(url)
    sys.stdout.write(
        f"JupyterLab serves {root} at\n\n    "
        f"{url}\n\n{'The page opens in your browser.' if opened else 'Open this address in your browser.'} "
        "Press Ctrl-C in this terminal to end JupyterLab, its kernels, and the ROS master.\n"
    )
    sys.stdout.flush()
