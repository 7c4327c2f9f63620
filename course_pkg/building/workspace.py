"""A catkin workspace of the student's own: where it lies, how it begins, and what sourcing it does.

`src` holds what the student writes, a folder for each package, and nothing of it is ever deleted. `build` is
what catkin_make works with and `devel` what it makes: both can be made again at any time. `earlier` holds
packages that start_over() put aside.
"""

from __future__ import annotations

import filecmp
import importlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

import course_pkg
from course_pkg.errors import SetupError
from course_pkg.provision import environment

NAME = "course_ws"
MADE = ("build", "devel")
SEARCHED = ("CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PKG_CONFIG_PATH", "PYTHONPATH", "ROS_PACKAGE_PATH")
SOURCING = 20.0  # s; it takes 0.1


def my_workspace() -> Workspace:
    """Return the student's workspace; made if it is not there, and otherwise left as it is.

    It is the folder COURSE_WORKSPACE, or else course_ws in the home folder (in COURSE_STATE where that is
    set, as for a notebook that is validated). Raises SetupError where catkin could not work there.
    """
    root = workspace_root()
    _require_fit(root)
    try:
        (root / "src").mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SetupError(
            f"{root} cannot be made ({error.strerror}). Set COURSE_WORKSPACE to a folder that you can write "
            "to, restart the kernel, and run this cell again."
        ) from error
    return Workspace(root)


def workspace_root() -> Path:
    """Return where the student's workspace lies, whether it is there or not."""
    if given := os.environ.get("COURSE_WORKSPACE"):
        return Path(given).expanduser().resolve()
    home = os.environ.get("COURSE_STATE") or os.path.expanduser("~")
    return Path(home).resolve() / NAME


def _require_fit(root: Path) -> None:
    """Raise SetupError for a folder in which the tools of ROS do not work."""
    checkout = Path(course_pkg.__file__).resolve().parent.parent
    problem = ""
    if any(letter.isspace() for letter in str(root)):
        problem = "there is a blank in its name, and catkin cannot build there"
    elif root.is_relative_to(checkout):
        problem = "it lies in the course's own folder, where rosrun would find each program twice"
    elif root.exists() and not (root / "src").is_dir() and any(root.iterdir()):
        problem = "something else is in it: a workspace has a folder src"
    if problem:
        raise SetupError(
            f"{root} cannot be your workspace: {problem}. Set COURSE_WORKSPACE to another folder, restart "
            "the kernel, and run this cell again."
        )


class Workspace(os.PathLike[str]):
    """A catkin workspace, in whatever state it is; `str` gives its path."""

    def __init__(self, root: Path) -> None:
        self.root = root

    def __fspath__(self) -> str:
        return str(self.root)

    def __str__(self) -> str:
        return str(self.root)

    def __repr__(self) -> str:  # the same on every machine: notebooks store it
        return "Workspace()"

    def source(self) -> list[str]:
        """Do in this process what `source devel/setup.bash` does in a shell; return what it changed.

        That is the names of the variables in which the workspace stands from now on. Python's own list,
        sys.path, is read from PYTHONPATH only when Python starts, so it is extended, too.
        """
        fresh = self._sourced()
        for name in fresh.keys() - {*environment.BY_SHELL, *environment.NETWORK}:
            os.environ[name] = fresh[name]
        for folder in reversed(self._inside(fresh.get("PYTHONPATH", ""))):
            if folder not in sys.path:
                sys.path.insert(1, folder)
        importlib.invalidate_caches()
        return [name for name in SEARCHED if self._inside(fresh.get(name, ""))]

    def start_over(self, *packages: str) -> None:
        """Begin with empty folders for `packages`, as if nothing had been built or sourced.

        A package that is there already goes to the folder `earlier`; build and devel are removed.
        """
        self._forget()
        try:
            for name in MADE:
                if (self.root / name).exists():
                    shutil.rmtree(self.root / name)
            for name in packages:
                self._put_aside(name)
                (self.root / "src" / name).mkdir()
        except OSError as error:
            raise SetupError(f"{error.filename} is in the way ({error.strerror}): move it.") from error

    def _sourced(self) -> dict[str, str]:
        """Return all variables of a shell that has sourced this workspace."""
        setup = self.root / "devel" / "setup.bash"
        if not setup.exists():
            raise SetupError(
                f"There is no {setup}: the workspace has not been built, or not to its end. Run catkin_make "
                "in it, and look at the first error that it prints."
            )
        shell = ["bash", "-c", 'source "$0" && exec env -0', str(setup)]
        try:
            done = subprocess.run(shell, capture_output=True, text=True, timeout=SOURCING, check=True)
        except (OSError, subprocess.SubprocessError) as error:
            raise SetupError(
                f"{setup} could not be sourced ({error}). Remove build and devel, and build again."
            ) from error
        return dict(item.split("=", 1) for item in done.stdout.split("\0") if "=" in item)

    def _inside(self, path: str) -> list[str]:
        """Return those folders of a search path that lie in this workspace."""
        return [folder for folder in path.split(os.pathsep) if self._is_mine(folder)]

    def _is_mine(self, folder: str) -> bool:
        return folder == str(self.root) or folder.startswith(f"{self.root}{os.sep}")

    def _forget(self) -> None:
        """Undo source(): its folders leave the search paths, its modules leave Python."""
        for name in SEARCHED:
            if self._inside(os.environ.get(name, "")):
                folders = os.environ[name].split(os.pathsep)
                os.environ[name] = os.pathsep.join(each for each in folders if not self._is_mine(each))
        sys.path[:] = [folder for folder in sys.path if not self._is_mine(folder)]
        for name, module in list(sys.modules.items()):
            if self._is_mine(getattr(module, "__file__", None) or ""):
                del sys.modules[name]
        importlib.invalidate_caches()

    def _put_aside(self, name: str) -> None:
        folder, earlier = self.root / "src" / name, self.root / "earlier"
        if not folder.exists():
            return
        kept = sorted(earlier.glob(f"{name}-*"))
        if not any(folder.iterdir()) or any(_alike(folder, other) for other in kept):
            shutil.rmtree(folder)  # nothing in it that is not kept already
            return
        earlier.mkdir(exist_ok=True)
        numbers = [path.name.removeprefix(f"{name}-") for path in kept]
        highest = max((int(number) for number in numbers if number.isdigit()), default=0)
        folder.rename(earlier / f"{name}-{highest + 1}")


def _alike(one: Path, other: Path) -> bool:
    """Return whether two folders hold the same files with the same contents."""
    files = sorted(path.relative_to(one) for path in one.rglob("*"))
    if files != sorted(path.relative_to(other) for path in other.rglob("*")):
        return False
    return all(
        (one / name).is_dir() or filecmp.cmp(one / name, other / name, shallow=False) for name in files
    )
