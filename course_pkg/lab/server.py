"""The Jupyter server of `course lab`: JupyterLab's pages, less what makes it slow to start.

Run as a module by `serve.py`, in a process of its own. What is left out, and why:

- jupyterlab's own server part: on import it asks node for the address of the npm registry (0.5 s), and it
  serves what nobody here needs: news, a build of the front end, an extension manager;
- parsers of rare string formats in JSON schemas: one of them compiles a grammar on import (1.3 s).
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any
from urllib.parse import quote

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

from jupyter_server._version import version_info  # noqa: E402
from jupyterlab_server import LabServerApp  # noqa: E402
from traitlets import Unicode, default  # noqa: E402

from course_pkg.lab.workspace import lay_out  # noqa: E402
from course_pkg.provision.stamps import replace_text  # noqa: E402

HERE = Path(__file__).parent
ASSETS = Path(sys.prefix) / "share" / "jupyter" / "lab"


class CourseLab(LabServerApp):  # type: ignore[misc]  # of an untyped package
    """JupyterLab, as `course lab` serves it."""

    name = "lab"
    app_name = "JupyterLab"
    load_other_extensions = True
    serverapp_config = {  # noqa: RUF012 -- as the base class declares it
        "jpserver_extensions": dict.fromkeys(EXTENSIONS, True),
        "terminado_settings": {"shell_command": ["bash", "--rcfile", str(HERE / "bashrc")]},
    }
    first_notebook = Unicode(help="the notebook whose kernel to start at once").tag(config=True)
    ready_file = Unicode(help="where to write the address once the server answers").tag(config=True)

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
        page = self.serverapp.web_app.settings.setdefault("page_config_data", {})
        page["token"] = self._token()
        page["quitButton"] = self.serverapp.quit_button
        page["allow_hidden_files"] = self.serverapp.contents_manager.allow_hidden
        page["delete_to_trash"] = getattr(self.serverapp.contents_manager, "delete_to_trash", False)
        page["notebookVersion"] = json.dumps(version_info)
        super().initialize_handlers()

    async def _start_jupyter_server_extension(self, serverapp: Any) -> None:  # noqa: ANN401 -- untyped package
        """Start the first kernel, so that the page finds it running; then say that the server answers.

        In this order: while a kernel is being started, the server's list of kernels is an error 500.
        """
        lay_out(self.workspaces_dir, self.first_notebook)
        if self.first_notebook:
            await serverapp.session_manager.create_session(
                path=self.first_notebook,
                name=Path(self.first_notebook).name,
                type="notebook",
                kernel_name="python3",
            )
        if self.ready_file:
            page = f"lab/tree/{quote(self.first_notebook)}" if self.first_notebook else "lab"
            address = f"{serverapp.connection_url}{page}?token={self._token()}"
            replace_text(Path(self.ready_file), json.dumps({"address": address}))

    def _token(self) -> str:
        return str(self.serverapp.identity_provider.token)


def _jupyter_server_extension_points() -> list[dict[str, object]]:
    return [{"module": "course_pkg.lab.server", "app": CourseLab}]


def main() -> None:
    """Serve until told to stop."""
    CourseLab.launch_instance()


if __name__ == "__main__":
    from course_pkg.lab import server  # the module by its name: the server looks this class up there

    server.main()
