"""The server of a student: `python -m course_pkg.hub.single_user`. The spawner runs it as the student.

The program gets the released notebooks, starts the student's master, and then runs JupyterLab as a server of
the hub.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

from course_pkg.hub.delivery import BRANCH, GIT_SETTINGS
from course_pkg.hub.settings import FOLDER, SCRATCH
from course_pkg.lab.graph.graph import Which, graph_of_this_command
from course_pkg.lab.graph.notes import notes
from course_pkg.lab.graph.settings import settings_for
from course_pkg.lab.jupyterlab import server_settings
from course_pkg.workspace import make_own_workspace

PULL_TIMEOUT = 60.0  # The time is in s.
# jupyterhub imports these modules in a student's server, but uses them only in the hub.
ONLY_IN_HUB = ("jupyterhub.orm", "jupyterhub.roles", "sqlalchemy")
NAMES_ONLY_IN_HUB = {"jupyterhub.handlers.pages": "HealthCheckHandler", "sqlalchemy.exc": "SQLAlchemyError"}


def main() -> None:
    """Prepare the student's folder and graph, and run the server until the hub ends the server."""
    folder = Path.home() / FOLDER
    pull(os.environ["COURSE_RELEASED"], folder)
    os.environ["COURSE_WORKSPACE"] = str(folder / "workspace")
    os.environ["ROS_LOG_DIR"] = str(Path.home() / ".ros" / "log")
    make_own_workspace()
    os.chdir(folder)
    cache = Path.home() / ".cache" / "ros-services-course"
    with (
        tempfile.TemporaryDirectory(prefix="", dir=os.environ[SCRATCH]) as scratch,
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
    """Copy the released notebooks to the folder `folder`.

    If `folder` exists, merge the changes and keep the student's work.

    If git fails, the server starts with the notebooks that are already in the folder.
    """
    # The repository belongs to another user. git therefore reads the setting safe.directory only from a
    # configuration file outside the repository.
    environment = {**os.environ, "GIT_CONFIG_SYSTEM": str(Path(repository).parent / GIT_SETTINGS)}
    command = [sys.executable, "-m", "nbgitpuller.pull", f"file://{repository}", BRANCH, str(folder)]
    try:
        if folder.is_dir() and not (folder / ".git").exists():
            _make_repository(repository, folder, environment)
        done = subprocess.run(command, env=environment, timeout=PULL_TIMEOUT, check=False)
        failure = f"exit status {done.returncode}" if done.returncode else ""
    except subprocess.TimeoutExpired:
        failure = f"the command did not end within {PULL_TIMEOUT:g} s"
    except subprocess.CalledProcessError as error:
        failure = f"git: {error.stderr.strip() or error}"
    except OSError as error:
        failure = str(error)
    if failure:
        sys.stderr.write(f"The released notebooks were not copied to {folder}: {failure}.\n")


def _make_repository(repository: str, folder: Path, environment: Mapping[str, str]) -> None:
    """Turn a folder that an earlier `course lab` made into a clone of the repository.

    A file of an earlier release gets the newest version. All other files of the student do not change. The
    folder becomes a repository at the very end. After an interruption, the next start therefore repeats this
    call. Raises subprocess.CalledProcessError if git fails, and OSError if the folder cannot be written.
    """
    with tempfile.TemporaryDirectory(prefix=".course-", dir=folder) as clone:
        files = Path(clone, ".git")

        def git(*arguments: str) -> str:
            command = ["git", "-C", str(folder), *arguments]
            return subprocess.run(
                command, env=environment, timeout=PULL_TIMEOUT, check=True, capture_output=True, text=True
            ).stdout

        git("clone", "-q", "--no-checkout", "--branch", BRANCH, f"file://{repository}", clone)
        here = (f"--git-dir={files}", f"--work-tree={folder}")
        git(*here, "reset", "-q")
        known = git(*here, "rev-list", "--objects", BRANCH).splitlines()
        released = {line.partition(" ")[0] for line in known}
        for name in git(*here, "diff", "--name-only", "--diff-filter=M", "-z").split("\0"):
            if name and git(*here, "hash-object", name).strip() in released:
                git(*here, "checkout", "-q", "--", name)
        files.rename(folder / ".git")


def _serve() -> None:
    # Without programs on PATH, the import of jupyterlab cannot run `node`; see course_pkg/lab/__main__.py.
    path = os.environ["PATH"]
    os.environ["PATH"] = os.devnull
    import jupyterlab.labapp  # noqa: F401

    os.environ["PATH"] = path
    with _without_database():
        # Import this module here, because the empty modules exist now; otherwise, main() would import it
        # later.
        import jupyterhub.singleuser.extension  # noqa: F401
        from jupyterhub.singleuser import main as serve

    serve()


@contextmanager
def _without_database() -> Iterator[None]:
    """During the `with` block, replace the modules of SQLAlchemy and of the hub's pages by empty modules.

    jupyterhub also imports these modules in a student's server, although only the hub uses them. The imports
    would need 30 MiB of memory in each server.
    """
    placeholders = {name: ModuleType(name) for name in (*ONLY_IN_HUB, *NAMES_ONLY_IN_HUB)}
    for name, defined in NAMES_ONLY_IN_HUB.items():
        setattr(placeholders[name], defined, type(defined, (Exception,), {}))
    sys.modules.update(placeholders)
    try:
        yield
    finally:
        # The empty modules are removed, because an extension of the server may import the real modules later.
        for name in placeholders:
            sys.modules.pop(name, None)


if __name__ == "__main__":
    main()
