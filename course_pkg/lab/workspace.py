"""The workspace that JupyterLab opens with: one notebook, and nothing from the last time.

Tabs restored from the last time would each start a kernel before the page is usable. An address can tell
JupyterLab to forget them (`?reset`) and what to open, but it is followed only once the state is saved, and
that waits for half a second without a change. What the workspace itself holds is opened at once.
"""

from __future__ import annotations

import json

from jupyterlab_server.workspaces_handler import WorkspacesManager

NAME = "default"


def lay_out(folder: str, notebook: str) -> None:
    """Write into `folder` the workspace that has `notebook` open, or nothing where that is empty."""
    workspace = {"data": _opened(notebook) if notebook else {}, "metadata": {"id": NAME}}
    WorkspacesManager(folder).save(NAME, json.dumps(workspace))


def _opened(notebook: str) -> dict[str, object]:
    """Return what JupyterLab itself keeps while it shows `notebook`, a path below the server's root."""
    tab = f"notebook:{notebook}"
    dock = {"type": "tab-area", "currentIndex": 0, "widgets": [tab]}
    return {
        "layout-restorer:data": {
            "main": {"dock": dock, "current": tab},
            "left": {
                "collapsed": False,
                "visible": True,
                "current": "filebrowser",
                "widgets": ["filebrowser"],
            },
        },
        tab: {"data": {"path": notebook, "factory": "Notebook"}},
    }
