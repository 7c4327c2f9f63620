"""Where files are: the checkout, and the cache folder that holds everything that is made for it."""

from __future__ import annotations

import hashlib
import os
import sys
from pathlib import Path
from typing import NamedTuple

from course_pkg.errors import SetupError

CATKIN_FOLDERS = ("srv", "msg", "action", "launch")  # beside course_pkg: what the catkin package is made of
PACKAGE_PARTS = ("course_pkg", *CATKIN_FOLDERS, "package.xml", "CMakeLists.txt", "setup.py")  # all of that


class Places(NamedTuple):
    """The folders of one checkout. Files that are made for it are outside it, because rosrun searches it."""

    checkout: Path
    cache: Path

    @classmethod
    def of(cls, checkout: Path | None = None) -> Places:
        """Return the places of `checkout`; the default is the checkout that this module is in."""
        checkout = (checkout or Path(__file__).parents[2]).resolve()
        key = hashlib.sha256(os.fsencode(checkout)).hexdigest()[:8]
        name = "".join(letter if letter.isalnum() else "-" for letter in checkout.name)
        return cls(checkout, cache_root() / f"{name}-{key}")

    @property
    def conda(self) -> Path | None:
        """The active conda environment, where it is the one that runs this and holds ROS."""
        prefix = os.environ.get("CONDA_PREFIX")
        if not prefix or Path(prefix).resolve() != Path(sys.prefix).resolve():
            return None
        return Path(prefix) if any(Path(prefix).glob("lib/python3*/site-packages/rosmaster")) else None

    @property
    def venv(self) -> Path:
        """The virtual environment; conda's own environment where that is used."""
        return self.conda or self.cache / "venv"

    @property
    def python(self) -> Path:
        """The interpreter that everything of the course runs on."""
        return self.venv / "bin" / "python"

    @property
    def workspace(self) -> Path:
        """The catkin workspace, with links to the checkout in its `src`."""
        return self.cache / "ws"

    @property
    def stamps(self) -> Path:
        """Which steps of the set-up are done, and with what inputs."""
        return self.cache / "done"

    @property
    def environment(self) -> Path:
        """The variables that the workspace's setup.bash sets, so that it is sourced only once."""
        return self.workspace / "environment.json"

    @property
    def logs(self) -> Path:
        """What the tools of the set-up print, and the logs of ROS."""
        return self.cache / "log"

    @property
    def tools(self) -> Path:
        """What the set-up itself needs; every checkout shares it."""
        return self.cache.parent / "tools"

    def make_cache(self) -> None:
        """Create the cache folder. Raises SetupError, with what to do, where that fails."""
        if any(letter.isspace() for letter in str(self.cache)):
            raise SetupError(
                f"catkin cannot build in {self.cache}, because there is a blank in the name. "
                "Set XDG_CACHE_HOME to a folder without one, and start again."
            )
        try:
            self.logs.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise SetupError(
                f"{self.cache} cannot be created ({error.strerror}). "
                "Set XDG_CACHE_HOME to a folder that you can write to, and start again."
            ) from error


def cache_root() -> Path:
    """Return the user's folder that holds the caches of all checkouts."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    folder = Path(base) if os.path.isabs(base) else Path(os.path.expanduser("~")) / ".cache"
    return folder / "ros-services-course"
