"""The notebook that `course lab` opens: its path, and a workspace of JupyterLab with this notebook."""

from __future__ import annotations

import json
from pathlib import Path

from course_pkg.errors import SetupError

# jupyterlab_server's file name for the workspace "default". The file name contains the word "default", and
# the first digits of the SHA-256 sum of this word.
WORKSPACE = "default-37a8.jupyterlab-workspace"


def notebook_to_open(root: Path, asked: str | None) -> str:
    """Return the path of the notebook to open, relative to `root`, the folder with `notebooks`.

    The notebook is `asked`, or the first chapter if `asked` is None. If there are no chapters, the result is
    "". Raises SetupError if `asked` is not a file in `root`.
    """
    if asked is None:
        chapters = sorted((root / "notebooks").glob("[0-9][0-9]_*.ipynb"))
        return str(chapters[0].relative_to(root)) if chapters else ""
    path = Path(asked).resolve()
    if not path.is_file():
        raise SetupError(f"There is no notebook {asked}. The chapters are in {root / 'notebooks'}.")
    if not path.is_relative_to(root):
        raise SetupError(
            f"{path} is not in {root}, and JupyterLab serves only this folder. Copy the "
            "notebook to this folder."
        )
    return str(path.relative_to(root))


def write_workspace(folder: Path, notebook: str) -> None:
    """Write the workspace that JupyterLab opens.

    The workspace has one tab for this notebook, and no tabs of an earlier start.

    If JupyterLab restored earlier tabs, it would first start a kernel for each of these tabs. A page address
    with the notebook and `?reset` would have the same effect, but 0.5 s later than the workspace.
    """
    tab = f"notebook:{notebook}"
    dock = {"type": "tab-area", "currentIndex": 0, "widgets": [tab]}
    left = {"collapsed": False, "visible": True, "current": "filebrowser", "widgets": ["filebrowser"]}
    opened = {
        "layout-restorer:data": {"main": {"dock": dock, "current": tab}, "left": left},
        tab: {"data": {"path": notebook, "factory": "Notebook"}},
        "file-browser-filebrowser:cwd": {"path": str(Path(notebook).parent)},
    }
    folder.mkdir()
    workspace = {"data": opened if notebook else {}, "metadata": {"id": "default"}}
    (folder / WORKSPACE).write_text(json.dumps(workspace))
