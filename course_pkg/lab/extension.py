"""The course's additions to the Jupyter server: an extension, and classes for checkpoints and files.

The set-up enables the extension in the course's environment. The server therefore has the same settings if a
user starts it with `jupyter lab` or `jupyter notebook` instead of `course lab`.
"""

from __future__ import annotations

import atexit
import os
import sys
from collections.abc import MutableMapping
from logging import Logger
from pathlib import Path
from typing import Any, Protocol

from jupyter_server.services.contents.filecheckpoints import AsyncFileCheckpoints
from jupyter_server.services.contents.largefilemanager import AsyncLargeFileManager
from tornado.websocket import WebSocketHandler
from traitlets import Bool, Unicode, default
from traitlets.config import Config

from course_pkg.errors import CourseError
from course_pkg.lab.shell import SHELL
from course_pkg.setup import Places, environment
from course_pkg.sharing.sender import start_sender
from course_pkg.workspace import make_own_workspace

HERE = Path(__file__).parent
# The file browser hides these files of the repository, because students do not need them. The file browser
# shows all other files, such as a student's own files and `workspace`.
HIDDEN = (
    *("CHANGELOG.md", "CMakeLists.txt", "CONTRIBUTING.md", "LICENSE", "README.md", "action", "course"),
    *("course_pkg", "deploy", "environment.yml", "launch", "package.xml", "pyproject.toml"),
    *("setup.py", "solutions", "srv", "tests"),
)
# The server's setting for the class that connects a page with a kernel.
CONNECTION_CLASS = "kernel_websocket_connection_class"


class Connection(Protocol):
    """A connection between a page's websocket and a kernel, with the methods that the extension uses."""

    websocket_handler: WebSocketHandler
    log: Logger

    async def connect(self) -> None:
        """Begin to forward messages between the page and the kernel."""


class WebApplication(Protocol):
    """The tornado application of the server."""

    settings: MutableMapping[str, type[Connection]]


class Server(Protocol):
    """The server, with the attributes that the extension uses."""

    web_app: WebApplication
    log: Logger
    config: Config
    root_dir: str

    def update_config(self, config: Config) -> None:
        """Merge `config` into the server's configuration."""


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "course_pkg.lab.extension"}]


def _link_jupyter_server_extension(server: Server) -> None:
    """Apply the course's settings; the command line and the user's files have priority."""
    settings = course_settings()
    settings.CourseContents.everything = Path(server.root_dir).resolve() != Places.of().checkout
    settings.merge(server.config)
    server.update_config(settings)


def course_settings() -> Config:
    """Return the settings that each Jupyter server in the course's environment needs."""
    return Config(
        ServerApp={
            "terminado_settings": {"shell_command": list(SHELL)},
            "contents_manager_class": "course_pkg.lab.extension.CourseContents",
        },
        ContentsManager={"checkpoints_class": "course_pkg.lab.extension.CachedCheckpoints"},
        LabApp={"app_settings_dir": str(HERE / "settings"), "extension_manager": "readonly"},
    )


def _load_jupyter_server_extension(server: Server) -> None:
    """Prepare the server and the environment of its kernels and terminals.

    If sharing is on, start to send the student's results to the class view.
    """
    _prepare_ros(server)
    _make_workspace(server)
    start_sender(lambda message: server.log.warning("class view: %s", message))
    _send_at_once(server)


def _prepare_ros(server: Server) -> None:
    """Set the environment of ROS, and start a master if ROS_MASTER_URI is not set.

    Kernels and terminals inherit this environment. If `course lab` has started the server, the environment
    and the master already exist.
    """
    if "ROS_PACKAGE_PATH" not in os.environ and not environment.apply():
        server.log.warning("The course's workspace is not built. Run `./course doctor` in a terminal.")
        return
    if os.environ.get("ROS_MASTER_URI"):
        return
    from course_pkg.ros.process.roscore import Roscore  # This import needs the modules of ROS.

    try:
        master = Roscore().start()
    except CourseError as error:
        server.log.warning("%s Therefore, each notebook starts its own master.", error)
        return
    atexit.register(master.stop)
    os.environ["ROS_MASTER_URI"] = master.uri


def _make_workspace(server: Server) -> None:
    """Create the folder of the student's own packages if the server's root folder is the checkout."""
    if Path(server.root_dir).resolve() == Places.of().checkout:
        try:
            make_own_workspace()
        except CourseError as error:
            server.log.warning("%s", error)


def _send_at_once(server: Server) -> None:
    """Set TCP_NODELAY on every kernel websocket: a click takes 10 ms with this option, and 46 ms without it.

    The server writes a message to the websocket in small pieces. Nagle's algorithm (RFC 896) delays a piece
    until the browser has acknowledged the previous piece. A browser may wait 40 ms before it sends this
    acknowledgement. If the server has no setting for the connection's class, this function changes nothing.
    """
    stock = server.web_app.settings.get(CONNECTION_CLASS)
    if stock is None:
        server.log.warning("course_pkg.lab.extension: this server has no setting %s", CONNECTION_CLASS)
        return
    server.web_app.settings[CONNECTION_CLASS] = undelayed(stock)


def undelayed(stock: type[Connection]) -> type[Connection]:
    """Return a subclass of `stock` with connections that set TCP_NODELAY before they connect."""

    async def connect(self: Connection) -> None:
        try:
            self.websocket_handler.set_nodelay(True)
        except Exception as error:  # noqa: BLE001 -- the page also works without the option, but more slowly
            self.log.warning("course_pkg.lab.extension could not set TCP_NODELAY: %s", error)
        await stock.connect(self)

    return type("UndelayedConnection", (stock,), {"connect": connect})


class CachedCheckpoints(AsyncFileCheckpoints):  # type: ignore[misc]  # The base class has no types.
    """Stores the checkpoints of notebooks in a folder outside the checkout.

    A checkpoint's path in this folder is the path of its notebook in the checkout.

    Jupyter's own class would store the checkpoints of a chapter and of its solution in the same file, because
    both notebooks have the same name.
    """

    folder = Unicode(help="the folder of the checkpoints").tag(config=True)

    @default("folder")
    def _folder(self) -> str:
        return str(Places.of().cache / "jupyter" / "checkpoints")

    def checkpoint_path(self, checkpoint_id: str, path: str) -> str:
        """Return the file for a checkpoint of the notebook at the path `path`; create the file's folder.

        Raises tornado.web.HTTPError if `path` is outside the server's folder.
        """
        self._get_os_path(path.strip("/"))
        notebook = Path(self.folder, path.strip("/"))
        with self.perm_to_403():
            notebook.parent.mkdir(parents=True, exist_ok=True)
        return str(notebook.with_name(f"{notebook.stem}-{checkpoint_id}{notebook.suffix}"))


def kernel_language() -> dict[str, Any]:
    """Return the same data about the language as ipykernel's message kernel_info_reply.

    The class ipykernel.ipkernel.IPythonKernel has these data, but its import would delay the server's start.
    """
    return {
        "name": "python",
        "version": sys.version.split()[0],
        "mimetype": "text/x-python",
        "codemirror_mode": {"name": "ipython", "version": sys.version_info[0]},
        "pygments_lexer": f"ipython{sys.version_info[0]}",
        "nbconvert_exporter": "python",
        "file_extension": ".py",
    }


class CourseContents(AsyncLargeFileManager):  # type: ignore[misc]  # The base class has no types.
    """Jupyter's access to files, with two changes for students.

    - The list of the root folder leaves out the files of the repository. A hidden file can still be opened by
      its path.
    - A notebook gets the language_info of the kernel. The stored notebooks contain only the name of the
      language. JupyterLab would add the missing data when the kernel has started, and then mark the notebook
      as changed.
    """

    everything = Bool(False, help="whether all files of the root folder are listed").tag(config=True)

    async def get(self, path: str, content: bool = True, **options: Any) -> dict[str, Any]:  # noqa: ANN401 -- passed on
        """Return the model of a file or folder, with the changes for students."""
        model: dict[str, Any] = await super().get(path, content=content, **options)
        if content and not path.strip("/") and not self.everything:
            model["content"] = [each for each in model["content"] if each["name"] not in HIDDEN]
        if content and model["type"] == "notebook":
            metadata = model["content"]["metadata"]
            if metadata.get("language_info") == {"name": "python"}:
                metadata["language_info"] = kernel_language()
        return model
