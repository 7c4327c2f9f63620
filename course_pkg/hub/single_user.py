"""A student's server: `python -m course_pkg.hub.single_user`, which the spawner runs as the student.

It gets the released notebooks, starts the student's master, and becomes the JupyterLab of the hub.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from course_pkg.hub.delivery import BRANCH, GIT_SETTINGS
from course_pkg.hub.settings import FOLDER
from course_pkg.lab.graph.graph import Which, graph_of_this_command
from course_pkg.lab.graph.notes import notes
from course_pkg.lab.graph.settings import settings_for
from course_pkg.lab.jupyterlab import server_settings
from course_pkg.workspace import make_own_workspace

PULL_TIMEOUT = 60.0  # s


def main() -> None:
    """Prepare the student's folder and graph, and run the server until the hub ends it."""
    folder = Path.home() / FOLDER
    pull(os.environ["COURSE_RELEASED"], folder)
    os.environ["COURSE_WORKSPACE"] = str(folder / "workspace")
    os.environ["ROS_LOG_DIR"] = str(Path.home() / ".ros" / "log")
    make_own_workspace()
    os.chdir(folder)
    cache = Path.home() / ".cache" / "ros-services-course"
    with (
        tempfile.TemporaryDirectory(prefix="course-hub-") as scratch,
        graph_of_this_command(Which.NEW) as graph,
    ):
        os.environ["JUPYTER_RUNTIME_DIR"] = str(Path(scratch, "runtime"))
        settings = server_settings(folder, cache / "checkpoints", Path(scratch, "workspaces"))
        settings |= settings_for(graph)
        sys.argv[1:] = [f"--{name}={value}" for name, value in settings.items()]
        if graph:
            graph.wait_for_master()
            sys.stderr.write(notes(graph, Which.NEW))
        _serve()


def pull(repository: str, folder: Path) -> None:
    """Copy the released notebooks to `folder`; if it exists, merge the changes and keep the student's work.

    If that fails, the server starts with the notebooks that are already there.
    """
    # The repository belongs to another user. git then requires this setting outside of the repository.
    environment = {**os.environ, "GIT_CONFIG_SYSTEM": str(Path(repository).parent / GIT_SETTINGS)}
    command = [sys.executable, "-m", "nbgitpuller.pull", f"file://{repository}", BRANCH, str(folder)]
    try:
        done = subprocess.run(command, env=environment, timeout=PULL_TIMEOUT, check=False)
        failure = f"exit status {done.returncode}" if done.returncode else ""
    except subprocess.TimeoutExpired:
        failure = f"no end within {PULL_TIMEOUT:g} s"
    if failure:
        sys.stderr.write(f"The released notebooks were not copied to {folder}: {failure}.\n")


def _serve() -> None:
    # jupyterlab runs `node` when it is imported, see course_pkg/lab/__main__.py
    path = os.environ["PATH"]
    os.environ["PATH"] = os.devnull
    import jupyterlab.labapp  # noqa: F401

    os.environ["PATH"] = path
    from jupyterhub.singleuser import main as serve

    serve()


if __name__ == "__main__":
    main()
