"""The folders of the course: the checkout, the folder that the set-up creates, and the user's own files."""

from __future__ import annotations

import hashlib
import os
import sys
from pathlib import Path
from typing import NamedTuple

from course_pkg.errors import SetupError
from course_pkg.installed import DATA, own_folder, version_folder

# The first tuple contains the package's folders except course_pkg; the second tuple contains all files of the
# package.
CATKIN_FOLDERS = ("srv", "msg", "action", "launch")
BUILT = "env"  # This folder of an installed version contains all files that the set-up creates.
PACKAGE_PARTS = ("course_pkg", *CATKIN_FOLDERS, "package.xml", "CMakeLists.txt", "setup.py")


class Places(NamedTuple):
    """The folders of one checkout, or of one version of a shared installation.

    The set-up creates files only outside the checkout, because rosrun searches the checkout.
    """

    checkout: Path
    cache: Path

    @classmethod
    def of(cls, checkout: Path | None = None) -> Places:
        """Return the folders of a checkout; the default is the checkout that contains this module."""
        checkout = (checkout or Path(__file__).parents[2]).resolve()
        if version := version_folder(checkout):
            return cls(checkout, version / BUILT)
        key = hashlib.sha256(os.fsencode(checkout)).hexdigest()[:8]
        name = "".join(letter if letter.isalnum() else "-" for letter in checkout.name)
        return cls(checkout, cache_root() / f"{name}-{key}")

    @property
    def installed(self) -> bool:
        """Whether this is a shared installation, in which a user cannot write."""
        return version_folder(self.checkout) is not None

    @property
    def own(self) -> Path:
        """The folder with the user's notebooks and workspace: the checkout, or a folder of the user's own."""
        return own_folder(self.checkout)

    @property
    def own_data(self) -> Path:
        """The folder for files that the course writes while it runs, such as logs."""
        return self.own / DATA if self.installed else self.cache

    @property
    def conda(self) -> Path | None:
        """The active conda environment, or None if it does not contain this interpreter and ROS."""
        prefix = os.environ.get("CONDA_PREFIX")
        if not prefix or Path(prefix).resolve() != Path(sys.prefix).resolve():
            return None
        return Path(prefix) if any(Path(prefix).glob("lib/python3*/site-packages/rosmaster")) else None

    @property
    def venv(self) -> Path:
        """The virtual environment, or the conda environment if conda is used."""
        return self.conda or self.cache / "venv"

    @property
    def python(self) -> Path:
        """The interpreter for all programs of the course."""
        return self.venv / "bin" / "python"

    @property
    def workspace(self) -> Path:
        """The catkin workspace, with links to the checkout in its `src`."""
        return self.cache / "ws"

    @property
    def stamps(self) -> Path:
        """The folder that records the finished steps of the set-up, and the inputs of each step."""
        return self.cache / "done"

    @property
    def environment(self) -> Path:
        """The file with the variables of the workspace's setup.bash; setup.bash is sourced only once."""
        return self.workspace / "environment.json"

    @property
    def logs(self) -> Path:
        """The folder for the output of the set-up's tools."""
        return self.cache / "log"

    @property
    def tools(self) -> Path:
        """The folder for the set-up's own tools; all checkouts share it."""
        return self.cache.parent / "tools"

    def make_cache(self) -> None:
        """Create the cache folder.

        Raises SetupError if the folder cannot be created; the error message contains the next step for the
        user.
        """
        if any(letter.isspace() for letter in str(self.cache)):
            raise SetupError(
                f"catkin cannot build in {self.cache}, because the name of this folder "
                "contains a space. Set XDG_CACHE_HOME to a folder without spaces, and start "
                "again."
            )
        try:
            self.logs.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise SetupError(
                f"{self.cache} cannot be created ({error.strerror}). "
                "Set XDG_CACHE_HOME to a folder that you can write to, and start again."
            ) from error


def cache_root() -> Path:
    """Return the user's folder with the caches of all checkouts."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    folder = Path(base) if os.path.isabs(base) else Path(os.path.expanduser("~")) / ".cache"
    return folder / "ros-services-course"
