"""The Jupyter server of `course lab`: JupyterLab's pages, less what makes it slow to start.

It runs in a process of its own: see `__main__.py`. What is left out, and why:

- jupyterlab's own server part: on import it asks node for the address of the npm registry (0.5 s), and it
  serves what nobody here needs: news, a build of the front end, an extension manager;
- parsers of rare string formats in JSON schemas: one of them compiles a grammar on import (1.3 s).
"""

from __future__ import annotations

import asyncio
import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

RARE_FORMATS = (
    "rfc3987_syntax",
    "rfc3987",
    "rfc3986_validator",
    "isoduration",
    "fqdn",
    "webcolors",
    "uri_template",
)
EXTENSIONS = ("jupyter_server_terminals", "course_pkg.lab.exporters", "course_pkg.lab.nodelay")
NOT_NEEDED = (*RARE_FORMATS, "gi")  # jsonschema and send2trash do without
sys.modules.update(dict.fromkeys(NOT_NEEDED))  # type: ignore[arg-type]  # None: an import raises ImportError

from jupyter_core.paths import jupyter_config_path  # noqa: E402
from jupyter_server._version import version_info  # noqa: E402
from jupyter_server.serverapp import ServerApp  # noqa: E402
from jupyterlab_server import LabServerApp, settings_utils  # noqa: E402
from tornado.httpclient import AsyncHTTPClient  # noqa: E402
from tornado.iostream import IOStream  # noqa: E402
from traitlets import Instance, default  # noqa: E402

from course_pkg.lab.page import NOTEBOOK, Page  # noqa: E402
from course_pkg.lab.porch import Porch  # noqa: E402
from course_pkg.lab.task import Task  # noqa: E402
from course_pkg.lab.workspace import lay_out  # noqa: E402
from course_pkg.provision.stamps import replace_text  # noqa: E402

HERE = Path(__file__).parent
ASSETS = Path(sys.prefix) / "share" / "jupyter" / "lab"
PATIENCE = 3.0  # s from the start until the page is looked at for the next one: by then this one is shown


class TrustingValidator:
    """Stands in for the one that checks every schema anew each time the page asks for the settings, 30 ms."""

    def __init__(self, stock: Any) -> None:  # noqa: ANN401 -- a class of an untyped package
        self._stock = stock

    def check_schema(self, schema: object) -> None:
        """Find no fault: the page checks the schemas as well."""

    def __call__(self, schema: object) -> Any:  # noqa: ANN401
        """Return what checks a user's settings."""
        return self._stock(schema)


class CourseServer(ServerApp):  # type: ignore[misc]  # of an untyped package
    """A Jupyter server on a socket that listens already."""

    task = Instance(Task)
    porch = Instance(Porch)

    def _find_http_port(self) -> None:
        """Look for none."""

    def _bind_http_server(self) -> None:
        """Wait for let_in()."""

    def let_in(self) -> None:
        """Answer whoever waits, and whoever comes."""
        for connection, address in self.porch.clear():
            stream = IOStream(connection, max_buffer_size=self.http_server.max_buffer_size)
            self.http_server.handle_stream(stream, address)
        self.http_server.add_socket(self.porch.listener)


class CourseLab(LabServerApp):  # type: ignore[misc]  # of an untyped package
    """JupyterLab, as `course lab` serves it."""

    name = "lab"
    app_name = "JupyterLab"
    load_other_extensions = True
    serverapp_config = {  # noqa: RUF012 -- as the base class declares it
        "jpserver_extensions": dict.fromkeys(EXTENSIONS, True),
        "terminado_settings": {"shell_command": ["bash", "--rcfile", str(HERE / "bashrc")]},
    }
    serverapp_class = CourseServer

    @classmethod
    def get_extension_package(cls) -> str:
        """Return the module that the server loads as this extension."""
        return "course_pkg.lab.server"

    @default("app_settings_dir")
    def _settings_of_the_course(self) -> str:
        return str(HERE / "settings")

    @default("schemas_dir")
    def _schemas(self) -> str:
        return str(ASSETS / "schemas")

    @default("static_dir")
    def _static(self) -> str:
        return str(ASSETS / "static")

    @default("templates_dir")
    def _templates(self) -> str:
        return str(ASSETS / "static")

    @default("themes_dir")
    def _themes(self) -> str:
        return str(ASSETS / "themes")

    @default("static_url_prefix")
    def _static_url(self) -> str:
        return f"{self.serverapp.base_url}static/{self.name}/"

    def initialize_handlers(self) -> None:
        """Tell the page what JupyterLab's own server part would tell it."""
        settings = self.serverapp.web_app.settings
        settings["page_config_hook"] = _lasting
        page = settings.setdefault("page_config_data", {})
        page["token"] = self._token()
        page["quitButton"] = self.serverapp.quit_button
        page["allow_hidden_files"] = self.serverapp.contents_manager.allow_hidden
        page["delete_to_trash"] = getattr(self.serverapp.contents_manager, "delete_to_trash", False)
        page["notebookVersion"] = json.dumps(version_info)
        super().initialize_handlers()

    async def _start_jupyter_server_extension(self, serverapp: CourseServer) -> None:
        """Start the first kernel, so that the page finds it running; then answer.

        In this order: while a kernel is being started, the server's list of kernels is an error 500.
        """
        task = serverapp.task
        try:
            lay_out(self.workspaces_dir, task.notebook)
            if task.notebook:
                await serverapp.session_manager.create_session(
                    path=task.notebook,
                    name=Path(task.notebook).name,
                    type="notebook",
                    kernel_name="python3",
                )
        finally:
            serverapp.let_in()
        replace_text(Path(task.ready), "")
        self._keeping = asyncio.create_task(self._keep_page(task))

    async def _keep_page(self, task: Task) -> None:
        """Keep the page for the next start, if it has changed."""
        await asyncio.sleep(PATIENCE)
        host, port = self.serverapp.porch.listener.getsockname()[:2]
        address = (
            f"http://{f'[{host}]' if ':' in host else host}:{port}/lab/tree/{NOTEBOOK}?token={task.token}"
        )
        answer = await AsyncHTTPClient().fetch(address)
        page = Page.of(dict(answer.headers), answer.body.decode(), task.token, self._sources())
        if page != Page.read(Path(task.page)):
            replace_text(Path(task.page), page.as_text())

    def _sources(self) -> Iterator[Path]:
        """Yield what the page is made from: a folder changes when an extension comes or goes."""
        yield from (Path(__file__), ASSETS / "static" / "index.html", HERE / "settings" / "page_config.json")
        yield from (Path(folder, "labconfig", "page_config.json") for folder in jupyter_config_path())
        for folder in map(Path, self.labextensions_path):
            yield from (folder, *folder.glob("@*"), *folder.glob("**/package.json"))

    def _token(self) -> str:
        return str(self.serverapp.identity_provider.token)


def _lasting(_handler: object, page: dict[str, object]) -> dict[str, object]:
    """Take out of a page's data what is another at each start or request, and what nobody reads."""
    return {**page, "store_id": 0, "workspacesDir": ""}


def _jupyter_server_extension_points() -> list[dict[str, object]]:
    return [{"module": "course_pkg.lab.server", "app": CourseLab}]


def serve(task: Task, porch: Porch, arguments: Sequence[str]) -> None:
    """Serve until told to stop."""
    settings_utils.Validator = TrustingValidator(settings_utils.Validator)
    argv = [*arguments, f"--IdentityProvider.token={task.token}"]
    CourseLab.initialize_server(argv, task=task, porch=porch).start()
